// SPDX-License-Identifier: Apache-2.0
// The C ABI of engines in memory of an allocator's. The library's only calls of the heap are here,
// in a unit of its own, so that a static program that gives its memory links none.
#include <cstdint>
#include <cstdlib>

#include "lib/api/validate.h"
#include "lib/engine/engine.h"
#include "starfocus/starfocus.h"

using namespace starfocus;

namespace starfocus {
namespace {

// The heap's memory is aligned by hand, since not every C library has a function for that: before
// what is given out lies what malloc gave.
void* AllocateFromHeap(void*, size_t bytes, size_t alignment) {
  if (bytes > SIZE_MAX - alignment) return nullptr;
  void* const memory = std::malloc(bytes + alignment);
  if (memory == nullptr) return nullptr;
  const uintptr_t begin = reinterpret_cast<uintptr_t>(memory) / alignment * alignment + alignment;
  reinterpret_cast<void**>(begin)[-1] = memory;
  return reinterpret_cast<void*>(begin);
}

void ReleaseToHeap(void*, void* memory, size_t) { std::free(static_cast<void**>(memory)[-1]); }

// Whether a function is there, as a pointer that is null or not.
template <class Function>
const void* Address(Function* function) {
  return reinterpret_cast<const void*>(function);
}

}  // namespace
}  // namespace starfocus

starfocus_status starfocus_create(const starfocus_config* config,
                                  const starfocus_allocator* allocator, starfocus_engine** engine) {
  if (engine != nullptr) *engine = nullptr;
  const starfocus_allocator heap = {nullptr, AllocateFromHeap, ReleaseToHeap};
  const starfocus_allocator& from = allocator != nullptr ? *allocator : heap;
  starfocus_config full = DefaultConfig();
  starfocus_status status = EnterConfig(config,
                                        {{"engine", engine},
                                         {"allocator.allocate", Address(from.allocate)},
                                         {"allocator.release", Address(from.release)}},
                                        &full);
  size_t bytes = 0;
  if (status == STARFOCUS_OK) status = starfocus_workspace_size(config, &bytes);
  if (status != STARFOCUS_OK) return status;
  void* const memory = from.allocate(from.data, bytes, STARFOCUS_ALIGNMENT);
  if (memory == nullptr) return TellStatus(STARFOCUS_ERROR_MEMORY, full.problem);
  status = starfocus_init(config, memory, bytes, engine);
  if (status != STARFOCUS_OK) {
    from.release(from.data, memory, bytes);
    return status;
  }
  EngineState& made = *reinterpret_cast<EngineState*>(*engine);
  made.allocator = from;
  made.bytes = bytes;
  return STARFOCUS_OK;
}

void starfocus_destroy(starfocus_engine* engine) {
  if (engine == nullptr) return;
  const EngineState& state = *reinterpret_cast<EngineState*>(engine);
  if (state.allocator.release == nullptr) return;
  // The engine ends with its memory, where the allocator is kept as well.
  const starfocus_allocator allocator = state.allocator;
  allocator.release(allocator.data, engine, state.bytes);
}
