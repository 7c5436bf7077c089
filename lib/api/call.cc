// SPDX-License-Identifier: Apache-2.0
#include "lib/api/call.h"

#include "lib/api/validate.h"
#include "lib/base/features.h"
#include "lib/engine/engine.h"

namespace starfocus {
namespace {

// Prepares the engine for comparing the current light field with the previous light field.
void CompareWith(const starfocus_previous& previous, const starfocus_light_field* now, int32_t mode,
                 EngineState* engine) {
  const starfocus_config& config = engine->config;
  FrameDiff& changes = engine->stripe.changes;
  changes.active = true;
  changes.before = &previous.light_field;
  changes.picture = &previous.out;
  changes.now = now;
  // STARFOCUS_MODE_BLUR reads only the centre view.
  changes.views = mode == STARFOCUS_MODE_BLUR ? 1 : config.views;
  changes.fills = Has(config, STARFOCUS_FEATURE_FILL_UNKNOWN);
  changes.width = config.width;
  changes.height = config.height;
  changes.side = config.superblock;
  const Borders& borders = engine->lens.borders;
  changes.side_reach = borders.views;
  changes.centre_reach = borders.highlights > 0 ? borders.views : borders.centre;
  StartFrameDiff(StripeRows(*engine).first, &changes);
}

}  // namespace

void CheckCall(const starfocus_config& config, const starfocus_params& params,
               const Prepared* prepared, Checker* check) {
  CheckParams(config, params, check);
  CheckRegion(params.region, config.width, config.height, check);
  if (prepared == nullptr) return;
  check->Need(Fits(*prepared, config), STARFOCUS_ERROR_PREPARED, {"prepared"},
              {"prepared with the engine's size, views, disparity range, max_layer and transfer"});
  check->Need(params.previous == nullptr, STARFOCUS_ERROR_RANGE, {"previous"},
              {"null if the light field is prepared"});
}

Extents MemoryOf(const EngineState& engine, const Prepared* prepared) {
  Extents memory;
  memory.Add(Workspace(engine));
  if (prepared != nullptr) memory.Add(PreparedMemory(*prepared));
  return memory;
}

starfocus_status RunCall(const starfocus_params& params, const Output& out,
                         const starfocus_previous* previous, const starfocus_light_field* now,
                         EngineState* engine, starfocus_report* report) {
  engine->stream.active = false;
  engine->jobs->call_progress.Begin(0, RegionOf(engine->config, params).height);
  Checker check(engine->config.problem);
  if (check.Add(SetLens(params, engine)) != STARFOCUS_OK) return check.status();
  if (previous != nullptr) CompareWith(*previous, now, params.mode, engine);
  check.Add(RefocusRows(out, engine));
  if (check.passed() && report != nullptr) *report = engine->report;
  return check.status();
}

}  // namespace starfocus
