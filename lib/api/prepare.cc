// SPDX-License-Identifier: Apache-2.0
// C API: prepared light fields.
#include "lib/api/validate.h"
#include "lib/engine/engine.h"
#include "lib/engine/prepared.h"

namespace starfocus {
namespace {

// Returns the size of a prepared light field for a valid configuration.
size_t SizeOf(const FullConfig& config, Checker* check) {
  if (!check->passed()) return 0;
  Prepared* counted = nullptr;
  const size_t needed = LayOutPrepared(config, nullptr, &counted);
  if (needed == kTooLarge) check->Add(STARFOCUS_ERROR_TOO_LARGE);
  return needed;
}

// Prepares a light field, which CheckLightField has accepted, in `memory`, which must not overlap
// the light field or the workspace.
starfocus_status PrepareIn(void* memory, size_t bytes, const starfocus_light_field& light_field,
                           EngineState* engine, Prepared** prepared) {
  Checker check(&engine->problem);
  const size_t needed = SizeOf(engine->config, &check);
  CheckMemory("memory", memory, bytes, needed, &check);
  Extents read;
  AddLightField(engine->config, light_field, &read);
  read.Add(Workspace(*engine));
  check.Apart(ExtentOf(memory, 0, 1, needed), read, "memory");
  if (!check.passed()) return check.status();
  engine->input = InputOf(engine->config, *engine->kernels, light_field, 0, &engine->rings);
  check.Add(Prepare(memory, engine, prepared));
  if (check.passed()) (*prepared)->light_field = light_field;
  return TellPlace(check.status(), light_field.depth, 0, &engine->problem);
}

}  // namespace
}  // namespace starfocus

using namespace starfocus;

starfocus_status starfocus_prepared_size(const starfocus_config* config, size_t* bytes,
                                         starfocus_problem* problem) {
  FullConfig full;
  Checker check = Enter(config, problem, &full);
  check.NotNull(bytes, "bytes");
  CheckConfig(full, &check);
  const size_t needed = SizeOf(full, &check);
  if (check.passed()) *bytes = needed;
  return check.status();
}

starfocus_status starfocus_prepare(starfocus_engine* engine,
                                   const starfocus_light_field* light_field, void* memory,
                                   size_t bytes, starfocus_prepared** prepared) {
  if (prepared != nullptr) *prepared = nullptr;
  Checker check = Enter(engine);
  check.NotNull(light_field, "light_field");
  check.NotNull(prepared, "prepared");
  if (!check.passed()) return check.status();
  EngineState& e = *reinterpret_cast<EngineState*>(engine);
  starfocus_light_field field = {};
  check.Read(*light_field, "light_field.size", &field);
  CheckLightField(e.config, field, &check);
  if (!check.passed()) return check.status();
  const starfocus_allocator& allocator = e.allocator;
  const bool allocates = memory == nullptr && allocator.allocate != nullptr;
  if (allocates) {
    bytes = SizeOf(e.config, &check);
    if (check.passed()) memory = allocator.allocate(allocator.data, bytes, STARFOCUS_ALIGNMENT);
    if (memory == nullptr) return check.Add(STARFOCUS_ERROR_MEMORY);
  }
  Prepared* made = nullptr;
  const starfocus_status status = PrepareIn(memory, bytes, field, &e, &made);
  if (status != STARFOCUS_OK) {
    if (allocates) Release(allocator, memory, bytes);
    return status;
  }
  if (allocates) made->allocator = allocator;
  *prepared = reinterpret_cast<starfocus_prepared*>(made);
  return STARFOCUS_OK;
}

void starfocus_destroy_prepared(starfocus_prepared* prepared) {
  if (prepared == nullptr) return;
  const Prepared& made = *reinterpret_cast<const Prepared*>(prepared);
  Release(made.allocator, prepared, made.bytes);
}
