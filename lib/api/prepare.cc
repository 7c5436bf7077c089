// SPDX-License-Identifier: Apache-2.0
// C API: prepared light fields.
#include "lib/api/validate.h"
#include "lib/engine/layout.h"
#include "lib/engine/light_field.h"
#include "lib/engine/prepared.h"
#include "starfocus/starfocus.h"

namespace starfocus {
namespace {

// Computes the size of a prepared light field for a valid configuration.
starfocus_status SizeOf(const starfocus_config& config, size_t* bytes) {
  Prepared* counted = nullptr;
  const size_t needed = LayOutPrepared(config, nullptr, &counted);
  if (needed == kTooLarge) return TellStatus(STARFOCUS_ERROR_TOO_LARGE, config.problem);
  *bytes = needed;
  return STARFOCUS_OK;
}

// Checks the memory for a prepared light field, which must not overlap the light field or the
// workspace.
starfocus_status CheckPreparedMemory(const EngineState& engine, const PrepareCall& call,
                                     const starfocus_light_field& light_field) {
  starfocus_problem* const problem = engine.config.problem;
  size_t needed = 0;
  starfocus_status status = SizeOf(engine.config, &needed);
  if (status == STARFOCUS_OK) {
    status = CheckMemory({"memory", call.memory, call.bytes}, needed, problem);
  }
  if (status != STARFOCUS_OK) return status;
  Extents read;
  AddLightField(engine.config, light_field, &read);
  read.Add(Workspace(engine));
  return CheckApart(ExtentOf(call.memory, 0, 1, needed), read, "memory", problem);
}

// Prepares a light field, which CheckLightField has accepted, in the memory of `call`.
starfocus_status PrepareIn(const PrepareCall& call, const starfocus_light_field& light_field,
                           EngineState* engine, Prepared** prepared) {
  const starfocus_status fits = CheckPreparedMemory(*engine, call, light_field);
  if (fits != STARFOCUS_OK) return fits;
  LightField field;
  MakeLightField(light_field, 0, engine, &field);
  UseLightField(field, engine);
  const starfocus_status status = Prepare(call, SourceOf(field), engine, prepared);
  if (status != STARFOCUS_OK) {
    return TellPlace(TellStatus(status, &engine->problem), light_field.depth, 0, &engine->problem);
  }
  (*prepared)->light_field = light_field;
  return STARFOCUS_OK;
}

// Prepares a light field in memory from the allocator of the engine.
starfocus_status PrepareAllocated(const starfocus_light_field& light_field, EngineState* engine,
                                  Prepared** prepared) {
  const starfocus_allocator& allocator = engine->allocator;
  size_t bytes = 0;
  starfocus_status status = SizeOf(engine->config, &bytes);
  if (status != STARFOCUS_OK) return status;
  void* const memory = allocator.allocate(allocator.data, bytes, STARFOCUS_ALIGNMENT);
  if (memory == nullptr) return TellStatus(STARFOCUS_ERROR_MEMORY, &engine->problem);
  status = PrepareIn({memory, bytes}, light_field, engine, prepared);
  if (status == STARFOCUS_OK) {
    (*prepared)->allocator = allocator;
    (*prepared)->bytes = bytes;
  } else {
    allocator.release(allocator.data, memory, bytes);
  }
  return status;
}

}  // namespace
}  // namespace starfocus

using namespace starfocus;

starfocus_status starfocus_prepared_size(const starfocus_config* config, size_t* bytes) {
  starfocus_config full = DefaultConfig();
  starfocus_status status = EnterConfig(config, {{"bytes", bytes}}, &full);
  if (status == STARFOCUS_OK) status = CheckConfig(full);
  return status == STARFOCUS_OK ? SizeOf(full, bytes) : status;
}

starfocus_status starfocus_prepare(starfocus_engine* engine,
                                   const starfocus_light_field* light_field, void* memory,
                                   size_t bytes, starfocus_prepared** prepared) {
  if (prepared != nullptr) *prepared = nullptr;
  starfocus_status status =
      EnterEngine(engine, {{"light_field", light_field}, {"prepared", prepared}});
  if (status != STARFOCUS_OK) return status;
  EngineState& e = *reinterpret_cast<EngineState*>(engine);
  status = CheckLightField(e.config, *light_field);
  if (status != STARFOCUS_OK) return status;
  const bool allocates = memory == nullptr && e.allocator.allocate != nullptr;
  Prepared* made = nullptr;
  status = allocates ? PrepareAllocated(*light_field, &e, &made)
                     : PrepareIn({memory, bytes}, *light_field, &e, &made);
  if (status == STARFOCUS_OK) *prepared = reinterpret_cast<starfocus_prepared*>(made);
  return status;
}

void starfocus_destroy_prepared(starfocus_prepared* prepared) {
  if (prepared == nullptr) return;
  const Prepared& made = *reinterpret_cast<const Prepared*>(prepared);
  // The allocator is copied to the stack first, because releasing the memory frees this copy.
  const starfocus_allocator allocator = made.allocator;
  if (allocator.release != nullptr) allocator.release(allocator.data, prepared, made.bytes);
}
