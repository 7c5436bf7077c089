// SPDX-License-Identifier: Apache-2.0
// C API: prepared light fields.
#include "lib/api/validate.h"
#include "lib/api/validate_image.h"
#include "lib/engine/layout.h"
#include "lib/source/light_field.h"
#include "lib/source/prepared.h"
#include "starfocus/starfocus.h"

namespace starfocus {
namespace {

// Checks the memory for a prepared light field, which must not overlap the inputs in `read`.
starfocus_status CheckPreparedMemory(const EngineState& engine, const PrepareCall& call,
                                     Extents* read) {
  Prepared* counted = nullptr;
  const size_t needed = LayOutPrepared(engine.config, nullptr, &counted);
  if (needed == kTooLarge) return STARFOCUS_ERROR_TOO_LARGE;
  starfocus_problem* const problem = engine.config.problem;
  const starfocus_status status = CheckMemory({"memory", call.memory, call.bytes}, needed, problem);
  if (status != STARFOCUS_OK) return status;
  read->Add(Workspace(engine));
  return CheckApart(ExtentOf(call.memory, 0, 1, needed), *read, "memory", problem);
}

}  // namespace
}  // namespace starfocus

using namespace starfocus;

starfocus_status starfocus_prepared_size(const starfocus_config* config, size_t* bytes) {
  starfocus_config full = DefaultConfig();
  starfocus_status status = EnterConfig(config, {{"bytes", bytes}}, &full);
  if (status == STARFOCUS_OK) status = CheckConfig(full);
  if (status != STARFOCUS_OK) return status;
  Prepared* counted = nullptr;
  const size_t needed = LayOutPrepared(full, nullptr, &counted);
  if (needed == kTooLarge) return TellStatus(STARFOCUS_ERROR_TOO_LARGE, full.problem);
  *bytes = needed;
  return STARFOCUS_OK;
}

starfocus_status starfocus_prepare(starfocus_engine* engine,
                                   const starfocus_light_field* light_field, void* memory,
                                   size_t bytes, starfocus_prepared** prepared) {
  if (prepared != nullptr) *prepared = nullptr;
  starfocus_status status =
      EnterEngine(engine, {{"light_field", light_field}, {"prepared", prepared}});
  if (status != STARFOCUS_OK) return status;
  EngineState& e = *reinterpret_cast<EngineState*>(engine);
  const PrepareCall call = {memory, bytes};
  status = CheckLightField(e.config, *light_field);
  if (status != STARFOCUS_OK) return status;
  Extents read;
  AddLightField(e.config, *light_field, &read);
  status = CheckPreparedMemory(e, call, &read);
  if (status != STARFOCUS_OK) return status;
  LightField field;
  MakeLightField(*light_field, 0, &e, &field);
  UseLightField(field, &e);
  Prepared* made = nullptr;
  status = Prepare(call, SourceOf(field), &e, &made);
  if (status != STARFOCUS_OK) return TellStatus(status, &e.problem);
  made->light_field = *light_field;
  *prepared = reinterpret_cast<starfocus_prepared*>(made);
  return STARFOCUS_OK;
}
