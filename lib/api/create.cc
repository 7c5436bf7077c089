// SPDX-License-Identifier: Apache-2.0
// C API: creates and destroys engines in memory from an allocator. Only this file calls malloc and
// free. Therefore, statically linked programs that provide the memory themselves do not contain the
// heap functions.
#include <cstdlib>

#include "lib/api/validate.h"
#include "lib/engine/engine.h"

using namespace starfocus;

namespace starfocus {
namespace {

// Not every C library can allocate aligned memory, so AllocateFromHeap aligns the block. The
// pointer from malloc is stored directly before the returned block.
void* AllocateFromHeap(void*, size_t bytes, size_t alignment) {
  if (bytes > SIZE_MAX - alignment) return nullptr;
  void* const memory = std::malloc(bytes + alignment);
  if (memory == nullptr) return nullptr;
  const uintptr_t begin = reinterpret_cast<uintptr_t>(memory) / alignment * alignment + alignment;
  reinterpret_cast<void**>(begin)[-1] = memory;
  return reinterpret_cast<void*>(begin);
}

void ReleaseToHeap(void*, void* memory, size_t) { std::free(static_cast<void**>(memory)[-1]); }

}  // namespace
}  // namespace starfocus

starfocus_status starfocus_create(const starfocus_config* config,
                                  const starfocus_allocator* allocator, starfocus_engine** engine,
                                  starfocus_problem* problem) {
  if (engine != nullptr) *engine = nullptr;
  const starfocus_allocator heap = {nullptr, AllocateFromHeap, ReleaseToHeap};
  const starfocus_allocator& from = allocator != nullptr ? *allocator : heap;
  Checker check = Enter(problem);
  check.NotNull(engine, "engine");
  check.Need(from.allocate != nullptr, STARFOCUS_ERROR_NULL, {"allocator.allocate"}, {"not null"});
  check.Need(from.release != nullptr, STARFOCUS_ERROR_NULL, {"allocator.release"}, {"not null"});
  size_t bytes = 0;
  if (check.passed()) check.Add(starfocus_workspace_size(config, &bytes, problem));
  if (!check.passed()) return check.status();
  void* const memory = from.allocate(from.data, bytes, STARFOCUS_ALIGNMENT);
  if (memory == nullptr) return check.Add(STARFOCUS_ERROR_MEMORY);
  const starfocus_status status = starfocus_init(config, memory, bytes, engine, problem);
  if (status != STARFOCUS_OK) {
    Release(from, memory, bytes);
    return status;
  }
  reinterpret_cast<EngineState*>(*engine)->allocator = from;
  return STARFOCUS_OK;
}

void starfocus_destroy(starfocus_engine* engine) {
  if (engine == nullptr) return;
  const EngineState& state = *reinterpret_cast<EngineState*>(engine);
  Release(state.allocator, engine, state.bytes);
}
