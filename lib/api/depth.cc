// SPDX-License-Identifier: Apache-2.0
// C API: estimates and repairs disparity maps. This file checks arguments and lays out memory.
#include "starfocus/depth.h"

#include "lib/api/validate.h"
#include "lib/depth/colour_repair.h"
#include "lib/depth/maps.h"
#include "lib/optics/view_set.h"

namespace starfocus {
namespace {

void CheckDepthConfig(const FullConfig& config, bool repairs, Checker* check) {
  CheckPicture(config, check);
  if (!check->passed()) return;
  ViewSet views;
  check->Add(FindViews(config.views, config.positions, config.problem, &views));
  check->Need(views.count > 1 || repairs, STARFOCUS_ERROR_RANGE, {"views", double(config.views)},
              {"at least 2 views, or 1 view for a repair"});
  check->Need(views.star || !repairs, STARFOCUS_ERROR_RANGE, {"positions[]"},
              {"the positions of starfocus_view_position for a repair"});
  check->Need(repairs || config.disparity_min < config.disparity_max, STARFOCUS_ERROR_RANGE,
              {"disparity_max", config.disparity_max},
              {"above disparity_min", config.disparity_min, STARFOCUS_MAX_DISPARITY});
}

// Checks that the outputs do not overlap the inputs, the workspace or each other.
void CheckOverlap(const FullConfig& config, const starfocus_light_field& light_field, bool repairs,
                  const starfocus_disparity_output& map, const Extent& workspace, Checker* check) {
  const auto width = static_cast<size_t>(config.width), floats = width * sizeof(float);
  const int32_t height = config.height;
  Extents taken;
  for (int view = 0; view < config.views; ++view) {
    AddImage(light_field.views[view], config.width, height, &taken);
  }
  if (repairs) AddDepthMap(light_field.depth, &taken);
  const Extent written[] = {workspace,
                            ExtentOf(map.disparity, map.disparity_stride, height, floats),
                            ExtentOf(map.confidence, map.confidence_stride, height, width),
                            ExtentOf(map.coverage, map.coverage_stride, height, width)};
  const bool wanted[] = {true, true, map.confidence != nullptr, map.coverage != nullptr};
  for (int k = 0; k < 4; ++k) {
    if (!wanted[k]) continue;
    check->Apart(written[k], taken, "map");
    taken.Add(written[k]);
  }
}

// Checks the map to repair: at least one disparity is known, and all known disparities lie in the
// configured range.
void CheckGiven(const FullConfig& config, const starfocus_depth_map& map, Checker* check) {
  if (!check->passed()) return;
  starfocus_disparity_stats stats;
  check->Add(starfocus_measure_disparity(&map, &stats, config.problem));
  if (!check->passed()) return;
  check->Need(stats.invalid < int64_t{map.width} * map.height, STARFOCUS_ERROR_ALL_INVALID,
              {"disparity"}, {"a finite value"});
  const auto low = MinDisparity(config);
  const auto high = MaxDisparity(config);
  const double outside = stats.min < low ? stats.min : stats.max;
  check->Need(stats.min >= low && stats.max <= high, STARFOCUS_ERROR_DISPARITY,
              {"disparity", outside},
              {"disparity_min to disparity_max", config.disparity_min, config.disparity_max});
  TellPlace(check->status(), map, 0, config.problem);
}

bool Converts(const FullConfig& config) { return Has(config, STARFOCUS_FEATURE_IMAGES); }

// Computes the size of a workspace, which contains the memory of an estimate or repair, followed by
// the memory of the converted light field.
size_t SizeOf(const FullConfig& config, bool repairs, Checker* check) {
  CheckDepthConfig(config, repairs, check);
  if (!check->passed()) return 0;
  const SweepSetup setup = MakeSetup(config, repairs);
  Arena arena(nullptr);
  if (config.views == 1) {
    TakeColourRepair(setup, config.max_workers, &arena);
  } else {
    TakeEstimate(setup, config.max_workers, &arena);
  }
  if (Converts(config)) ConvertField(config, setup, &arena, nullptr, nullptr);
  if (arena.Bytes() == kTooLarge) check->Add(STARFOCUS_ERROR_TOO_LARGE);
  return arena.Bytes();
}

// Arguments of an API call that estimates or repairs a map.
struct DepthCall {
  const FullConfig* config;
  const starfocus_callbacks* callbacks;
  starfocus_light_field* light_field;  // Copy with all fields.
  void* workspace;
  size_t bytes;
};

// Checks all arguments of an API call that estimates or repairs a map.
void CheckCall(const DepthCall& call, bool repairs, const starfocus_disparity_output& map,
               Checker* check) {
  const FullConfig& config = *call.config;
  const starfocus_light_field& light_field = *call.light_field;
  const int32_t width = config.width, height = config.height;
  const size_t needed = SizeOf(config, repairs, check);
  CheckMemory("workspace", call.workspace, call.bytes, needed, check);
  if (!check->passed()) return;
  CheckViews(light_field, config.views, width, height, false, check);
  CheckMap(map.disparity, map.disparity_stride, width, height, "map.disparity",
           "map.disparity_stride", check);
  if (repairs) CheckDepthMap(light_field.depth, width, height, check);
  if (!Converts(config)) CheckInPlace(config, light_field, repairs, check);
  CheckBytes(map.confidence, map.confidence_stride, width, height, "map.confidence_stride", check);
  CheckBytes(map.coverage, map.coverage_stride, width, height, "map.coverage_stride", check);
  if (!check->passed()) return;
  const auto begin = reinterpret_cast<uintptr_t>(call.workspace);
  CheckOverlap(config, light_field, repairs, map, {begin, begin + needed}, check);
  if (repairs) CheckGiven(config, light_field.depth, check);
}

// Converts the light field if necessary, and calls make(light_field) with the caller's runner and
// progress function. Takes the memory of the converted light field.
template <class Make>
starfocus_status Watched(const DepthCall& call, const SweepSetup& setup, Arena* arena, Jobs* jobs,
                         const Make& make) {
  const FullConfig& config = *call.config;
  CallProgress* const call_progress = &jobs->call_progress;
  if (call.callbacks != nullptr) {
    jobs->runner = call.callbacks->runner;
    jobs->runner_data = call.callbacks->runner_data;
    call_progress->SetProgress(call.callbacks->progress, call.callbacks->progress_data);
  }
  call_progress->Begin(0, config.height);
  starfocus_status status = STARFOCUS_OK;
  if (Converts(config)) status = ConvertField(config, setup, arena, jobs, call.light_field);
  if (status == STARFOCUS_OK) status = make(*call.light_field);
  if (status != STARFOCUS_OK) return status;
  call_progress->SetRows(config.height);
  return call_progress->Ask() ? STARFOCUS_OK : STARFOCUS_ERROR_CANCELLED;
}

// Repairs the map of a single view by the colours of the view. Sets *has_coverage to 1 if coverage
// of hair was found, otherwise to 0.
starfocus_status RepairOneView(const DepthCall& call, const MapOutput& output,
                               int32_t* has_coverage) {
  const SweepSetup setup = MakeSetup(*call.config, true);
  Arena arena(call.workspace);
  const ColourMemory memory = TakeColourRepair(setup, call.config->max_workers, &arena);
  bool found = false;
  const starfocus_status status =
      Watched(call, setup, &arena, memory.jobs, [&](const starfocus_light_field& field) {
        return RepairByColour(setup, field, simd::BestDepthKernels(), output, memory, &found);
      });
  *has_coverage = status == STARFOCUS_OK && found ? 1 : 0;
  return status;
}

// Estimates a map from all views, or repairs a given map with all views.
starfocus_status SweepViews(const DepthCall& call, bool repairs, const MapOutput& output) {
  const SweepSetup setup = MakeSetup(*call.config, repairs);
  const simd::DepthKernels& kernels = simd::BestDepthKernels();
  Arena arena(call.workspace);
  const EstimateMemory memory = TakeEstimate(setup, call.config->max_workers, &arena);
  // Calls visit(workspace, begin, end) for each piece of the memory.
  const auto visit_pieces = [&](void (*visit)(void*, size_t, size_t)) {
    const PieceVisitor visitor = {visit, call.workspace};
    Arena counted(nullptr, PTRDIFF_MAX, &visitor);
    if (kRedZone > 0) TakeEstimate(setup, call.config->max_workers, &counted);
  };
  visit_pieces(PoisonZone);
  const starfocus_status status =
      Watched(call, setup, &arena, memory.jobs, [&](const starfocus_light_field& field) {
        return (repairs ? Repair : Estimate)(setup, field, kernels, output, memory);
      });
  visit_pieces(UnpoisonZone);
  return status;
}

// Checks the arguments, then estimates or repairs the map.
starfocus_status RunCall(const starfocus_config* config, const starfocus_callbacks* callbacks,
                         const starfocus_light_field* light_field, starfocus_disparity_output* map,
                         void* workspace, size_t bytes, bool repairs, starfocus_problem* problem) {
  FullConfig full;
  starfocus_light_field field = {};
  Checker check = Enter(config, problem, &full);
  check.NotNull(light_field, "light_field");
  check.NotNull(map, "map");
  check.NotNull(workspace, "workspace");
  if (check.passed()) check.Read(*light_field, "light_field.size", &field);
  if (!check.passed()) return check.status();
  const DepthCall call = {&full, callbacks, &field, workspace, bytes};
  CheckCall(call, repairs, *map, &check);
  if (!check.passed()) return check.status();
  map->has_coverage = 0;
  const MapOutput output = {{map->disparity, map->disparity_stride / sizeof(float)},
                            MinDisparity(full),
                            MaxDisparity(full),
                            {map->confidence, map->confidence_stride},
                            {map->coverage, map->coverage_stride}};
  check.Add(full.views == 1 ? RepairOneView(call, output, &map->has_coverage)
                            : SweepViews(call, repairs, output));
  return check.status();
}

}  // namespace
}  // namespace starfocus

using namespace starfocus;

starfocus_status starfocus_map_workspace_size(const starfocus_config* config, int32_t repairs,
                                              size_t* bytes, starfocus_problem* problem) {
  FullConfig full;
  Checker check = Enter(config, problem, &full);
  check.NotNull(bytes, "bytes");
  check.In({"repairs", double(repairs)}, STARFOCUS_FROM_TO(0, 1));
  const size_t needed = SizeOf(full, repairs != 0, &check);
  if (check.passed()) *bytes = needed;
  return check.status();
}

starfocus_status starfocus_estimate_disparity(const starfocus_config* config,
                                              const starfocus_callbacks* callbacks,
                                              const starfocus_light_field* light_field,
                                              starfocus_disparity_output* map, void* workspace,
                                              size_t bytes, starfocus_problem* problem) {
  return RunCall(config, callbacks, light_field, map, workspace, bytes, false, problem);
}

starfocus_status starfocus_repair_disparity(const starfocus_config* config,
                                            const starfocus_callbacks* callbacks,
                                            const starfocus_light_field* light_field,
                                            starfocus_disparity_output* map, void* workspace,
                                            size_t bytes, starfocus_problem* problem) {
  return RunCall(config, callbacks, light_field, map, workspace, bytes, true, problem);
}
