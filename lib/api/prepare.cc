// SPDX-License-Identifier: Apache-2.0
// The C ABI for light fields that are prepared once.
#include "lib/api/validate.h"
#include "lib/api/validate_image.h"
#include "lib/engine/layout.h"
#include "lib/source/light_field.h"
#include "lib/source/prepared.h"
#include "starfocus/starfocus.h"

namespace starfocus {
namespace {

// Checks the memory that a prepared light field is to be made in, which must not overlap what is
// `read`.
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

using starfocus::EngineState;
using starfocus::Prepared;

starfocus_status starfocus_prepared_size(const starfocus_config* config, size_t* bytes) {
  starfocus_config full = starfocus::DefaultConfig();
  starfocus_status status = starfocus::EnterConfig(config, {{"bytes", bytes}}, &full);
  if (status == STARFOCUS_OK) status = starfocus::CheckConfig(full);
  if (status != STARFOCUS_OK) return status;
  Prepared* counted = nullptr;
  const size_t needed = starfocus::LayOutPrepared(full, nullptr, &counted);
  if (needed == starfocus::kTooLarge)
    return starfocus::TellStatus(STARFOCUS_ERROR_TOO_LARGE, full.problem);
  *bytes = needed;
  return STARFOCUS_OK;
}

starfocus_status starfocus_prepare(starfocus_engine* engine,
                                   const starfocus_light_field* light_field, void* memory,
                                   size_t bytes, starfocus_prepared** prepared) {
  if (prepared != nullptr) *prepared = nullptr;
  starfocus_status status =
      starfocus::EnterEngine(engine, {{"light_field", light_field}, {"prepared", prepared}});
  if (status != STARFOCUS_OK) return status;
  EngineState& e = *reinterpret_cast<EngineState*>(engine);
  const starfocus::PrepareCall call = {memory, bytes};
  status = starfocus::CheckLightField(e.config, *light_field);
  if (status != STARFOCUS_OK) return status;
  starfocus::Extents read;
  starfocus::AddLightField(e.config, *light_field, &read);
  status = starfocus::CheckPreparedMemory(e, call, &read);
  if (status != STARFOCUS_OK) return status;
  starfocus::LightField field;
  starfocus::MakeLightField(*light_field, 0, &e, &field);
  starfocus::UseLightField(field, &e);
  Prepared* made = nullptr;
  status = starfocus::Prepare(call, starfocus::SourceOf(field), &e, &made);
  if (status != STARFOCUS_OK) return starfocus::TellStatus(status, &e.problem);
  made->light_field = *light_field;
  *prepared = reinterpret_cast<starfocus_prepared*>(made);
  return STARFOCUS_OK;
}
