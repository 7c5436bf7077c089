// SPDX-License-Identifier: Apache-2.0
#include "lib/api/validate.h"

#include "lib/engine/engine.h"
#include "lib/optics/view_set.h"

namespace starfocus {
namespace {

// Checks all fields, including fields that the shape does not use.
void CheckLens(const starfocus_config& config, const starfocus_lens& lens, Checker* check) {
  CheckFocus(lens, check);
  check->In({"lens.aperture", lens.aperture}, STARFOCUS_FROM_TO(0, 1));
  check->In({"lens.shape", double(lens.shape)}, {"a starfocus_shape", 0, STARFOCUS_SHAPE_RING});
  check->In({"lens.blades", double(lens.blades)},
            STARFOCUS_FROM_TO(STARFOCUS_MIN_BLADES, STARFOCUS_MAX_BLADES));
  check->In({"lens.theta", lens.theta},
            {"0.05 pi to 0.45 pi", STARFOCUS_MIN_THETA, STARFOCUS_MAX_THETA});
  check->In({"lens.rotation", lens.rotation}, STARFOCUS_FROM_TO(-360, 360));
  check->In({"lens.curvature", lens.curvature}, STARFOCUS_FROM_TO(0, 1));
  check->In({"lens.ring_inner", lens.ring_inner}, STARFOCUS_FROM_TO(0, STARFOCUS_MAX_RING_INNER));
  check->In({"lens.cats_eye", lens.cats_eye}, STARFOCUS_FROM_TO(0, 1));
  if (HasShapes(config)) return;
  check->Need(lens.shape != STARFOCUS_SHAPE_POLYGON, STARFOCUS_ERROR_FEATURE,
              {"lens.shape", double(lens.shape)},
              {"not STARFOCUS_SHAPE_POLYGON without STARFOCUS_FEATURE_SHAPES"});
  check->Need(lens.cats_eye == 0, STARFOCUS_ERROR_FEATURE, {"lens.cats_eye", lens.cats_eye},
              {"0 without STARFOCUS_FEATURE_SHAPES"});
}

void CheckTiming(const starfocus_timing& timing, Checker* check) {
  const Allowed allowed = {"at most STARFOCUS_MAX_TIMING", 0, STARFOCUS_MAX_TIMING};
  check->In({"tuning.timing.block", double(timing.block)}, allowed);
  check->In({"tuning.timing.field", double(timing.field)}, allowed);
  check->In({"tuning.timing.a", double(timing.a)}, allowed);
  check->In({"tuning.timing.b", double(timing.b)}, allowed);
  check->In({"tuning.timing.c", double(timing.c)}, allowed);
  check->In({"tuning.timing.upsample", double(timing.upsample)}, allowed);
  check->In({"tuning.timing.span", double(timing.span)}, allowed);
  check->In({"tuning.timing.hole", double(timing.hole)}, allowed);
}

void CheckTuning(const starfocus_tuning& tuning, Checker* check) {
  check->In({"tuning.max_layer", double(tuning.max_layer)}, STARFOCUS_FROM_TO(0, 2));
  check->In({"tuning.deblocking", double(tuning.deblocking)}, STARFOCUS_FROM_TO(0, 255));
  check->In({"tuning.gather", double(tuning.gather)}, STARFOCUS_FROM_TO(0, 1));
  check->In({"tuning.n_scale", tuning.n_scale},
            STARFOCUS_FROM_TO(STARFOCUS_MIN_N_SCALE, STARFOCUS_MAX_N_SCALE));
  CheckTiming(tuning.timing, check);
}

bool IsBlock(int32_t side) {
  return side == 0 || side == 32 || side == 64 || side == 128 || side == 256;
}

}  // namespace

starfocus_status EnterEngine(starfocus_engine* engine, std::initializer_list<Pointer> pointers) {
  if (engine == nullptr) return STARFOCUS_ERROR_NULL;
  return CheckPointers(pointers, &reinterpret_cast<EngineState*>(engine)->problem);
}

starfocus_status EnterCall(starfocus_engine* engine, std::initializer_list<Pointer> pointers,
                           const starfocus_params* params, starfocus_params* full) {
  const starfocus_status status = EnterEngine(engine, pointers);
  if (status != STARFOCUS_OK) return status;
  *full = DefaultParams();
  Checker check(&reinterpret_cast<EngineState*>(engine)->problem);
  check.Need(ReadSized(*params, full), STARFOCUS_ERROR_STRUCTURE,
             {"params.size", double(params->size)}, {"the value set by starfocus_params_init"});
  return check.status();
}

void CheckPictureRange(const PictureRange& picture, Checker* check) {
  const Allowed size = STARFOCUS_FROM_TO(1, STARFOCUS_MAX_SIZE);
  check->In({"width", double(picture.width)}, size);
  check->In({"height", double(picture.height)}, size);
  const Allowed disparity = STARFOCUS_FROM_TO(-STARFOCUS_MAX_DISPARITY, STARFOCUS_MAX_DISPARITY);
  check->In({"disparity_min", picture.disparity_min}, disparity);
  check->In({"disparity_max", picture.disparity_max}, disparity);
  check->In({"disparity_max", picture.disparity_max},
            {"at least disparity_min", picture.disparity_min, STARFOCUS_MAX_DISPARITY});
  check->In({"max_workers", double(picture.max_workers)},
            STARFOCUS_FROM_TO(1, STARFOCUS_MAX_WORKERS));
}

void CheckFocus(const starfocus_lens& lens, Checker* check) {
  check->In({"lens.focus", lens.focus},
            STARFOCUS_FROM_TO(-STARFOCUS_MAX_FOCUS, STARFOCUS_MAX_FOCUS));
  check->In({"lens.focus_nearer", lens.focus_nearer},
            {"at least 0 and at most 1000000 - lens.focus", 0, STARFOCUS_MAX_FOCUS - lens.focus});
  check->In({"lens.focus_farther", lens.focus_farther},
            {"at least 0 and at most 1000000 + lens.focus", 0, STARFOCUS_MAX_FOCUS + lens.focus});
}

starfocus_status CheckConfig(const starfocus_config& config) {
  Checker check(config.problem);
  CheckPictureRange(
      {config.width, config.height, config.disparity_min, config.disparity_max, config.max_workers},
      &check);
  if (check.status() != STARFOCUS_OK) return check.status();
  ViewSet views;
  const starfocus_status status = FindViews(config.views, config.positions, config.problem, &views);
  if (status != STARFOCUS_OK) return status;
  check.Need(config.max_blur > 0.0 && config.max_blur <= STARFOCUS_MAX_BLUR, STARFOCUS_ERROR_RANGE,
             {"max_blur", config.max_blur},
             {"above 0 and at most STARFOCUS_MAX_BLUR", kNoNumber, STARFOCUS_MAX_BLUR});
  check.Need(IsBlock(config.superblock), STARFOCUS_ERROR_RANGE,
             {"superblock", double(config.superblock)}, {"0, 32, 64, 128 or 256"});
  CheckTuning(config.tuning, &check);
  constexpr uint32_t kFeatures = STARFOCUS_FEATURE_LINE_SCAN | STARFOCUS_FEATURE_COVERAGE |
                                 STARFOCUS_FEATURE_STREAMING | STARFOCUS_FEATURE_IMAGES |
                                 STARFOCUS_FEATURE_FILL_UNKNOWN | STARFOCUS_FEATURE_SHAPES;
  check.Need((config.features & ~kFeatures) == 0, STARFOCUS_ERROR_RANGE,
             {"features", double(config.features)}, {"bits of STARFOCUS_FEATURE_"});
  check.In({"previews", double(config.previews)}, STARFOCUS_FROM_TO(0, STARFOCUS_MAX_PREVIEW));
  check.In({"transfer", double(config.transfer)},
           {"a starfocus_transfer", 0, STARFOCUS_TRANSFER_NONE});
  check.In({"highlights", config.highlights}, STARFOCUS_FROM_TO(1, STARFOCUS_MAX_HIGHLIGHTS));
  return check.status();
}

starfocus_status CheckParams(const starfocus_config& config, const starfocus_params& params) {
  Checker check(config.problem);
  check.In({"mode", double(params.mode)}, {"a starfocus_mode", 0, STARFOCUS_MODE_BLUR});
  check.In({"renderer", double(params.renderer)},
           {"a starfocus_renderer", 0, STARFOCUS_RENDERER_SLICES});
  CheckLens(config, params.lens, &check);
  if (params.renderer == STARFOCUS_RENDERER_LINE_SCAN && params.mode != STARFOCUS_MODE_BLUR) {
    check.Need(HasLineScan(config), STARFOCUS_ERROR_FEATURE, {"renderer", double(params.renderer)},
               {"not STARFOCUS_RENDERER_LINE_SCAN without STARFOCUS_FEATURE_LINE_SCAN"});
    check.Need(HasStar(config), STARFOCUS_ERROR_FEATURE, {"renderer", double(params.renderer)},
               {"not STARFOCUS_RENDERER_LINE_SCAN without the views of starfocus_view_position"});
  }
  return check.status();
}

starfocus_status CheckMemory(const Memory& memory, size_t needed, starfocus_problem* problem) {
  Checker check(problem);
  const auto address = reinterpret_cast<uintptr_t>(memory.data);
  check.NotNull(memory.data, memory.name);
  check.Need(address % STARFOCUS_ALIGNMENT == 0, STARFOCUS_ERROR_WORKSPACE,
             {memory.name, double(address % STARFOCUS_ALIGNMENT)},
             {"a multiple of STARFOCUS_ALIGNMENT"});
  check.Need(memory.bytes >= needed, STARFOCUS_ERROR_WORKSPACE, {"bytes", double(memory.bytes)},
             {"at least the number of bytes that the size function returns", double(needed)});
  return check.status();
}

starfocus_status CheckMap(const MapPlane& map, int32_t width, int32_t height,
                          starfocus_problem* problem) {
  Checker check(problem);
  check.NotNull(map.disparity, "disparity");
  const Allowed size = STARFOCUS_FROM_TO(1, STARFOCUS_MAX_SIZE);
  check.In({"width", double(width)}, size);
  check.In({"height", double(height)}, size);
  if (check.status() != STARFOCUS_OK) return check.status();
  const bool aligned = map.stride % sizeof(float) == 0 &&
                       reinterpret_cast<uintptr_t>(map.disparity) % alignof(float) == 0;
  check.Stride(
      aligned && ValidStride(map.stride, sizeof(float) * static_cast<size_t>(width), height),
      "disparity_stride", map.stride);
  return check.status();
}

bool ValidStride(size_t stride, size_t row_bytes, int32_t rows) {
  return stride >= row_bytes &&
         (rows <= 1 || stride <= (PTRDIFF_MAX - row_bytes) / static_cast<size_t>(rows - 1));
}

starfocus_status CheckCoverage(const starfocus_config& config, const uint8_t* coverage,
                               size_t stride) {
  Checker check(config.problem);
  check.Stride(
      coverage == nullptr || ValidStride(stride, static_cast<size_t>(config.width), config.height),
      "coverage_stride", stride);
  return check.status();
}

starfocus_status CheckRegion(const starfocus_region& region, int32_t width, int32_t height,
                             starfocus_problem* problem) {
  if (IsWhole(region)) return STARFOCUS_OK;
  Checker check(problem);
  check.In({"region.x", double(region.x)}, {"inside the picture", 0, width - 1.0});
  check.In({"region.y", double(region.y)}, {"inside the picture", 0, height - 1.0});
  check.In({"region.width", double(region.width)},
           {"inside the picture", 1, width - double(region.x)});
  check.In({"region.height", double(region.height)},
           {"inside the picture", 1, height - double(region.y)});
  return check.status();
}

}  // namespace starfocus
