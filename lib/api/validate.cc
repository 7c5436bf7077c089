// SPDX-License-Identifier: Apache-2.0
#include "lib/api/validate.h"

#include "lib/base/features.h"
#include "lib/engine/engine.h"
#include "lib/io/depth_values.h"
#include "lib/io/gaps.h"
#include "lib/io/image_planes.h"
#include "lib/io/rows.h"
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
namespace {

int PlanesOfFormat(int32_t format) { return !IsYuv(format) ? 1 : IsPaired(format) ? 2 : 3; }

// Number of rows of a plane, and bytes per row.
struct PlaneSize {
  int32_t rows;
  size_t row_bytes;
};

PlaneSize SizeOfPlane(const starfocus_image& image, int plane, const PictureSize& picture) {
  const auto pixels = static_cast<size_t>(picture.width), samples = (pixels + 1) / 2;
  const int32_t given = image.pixel_stride, format = image.format;
  const auto step = static_cast<size_t>(given != 0 ? given : LeastStep(format));
  if (!IsYuv(format)) return {picture.height, (pixels - 1) * step + (HasAlpha(format) ? 4 : 3)};
  if (plane == 0) return {picture.height, pixels};
  return {(picture.height + 1) / 2, IsPaired(format) ? 2 * samples : (samples - 1) * step + 1};
}

Extent ExtentOfPlane(const starfocus_image& image, int plane, const PictureSize& picture) {
  const PlaneSize size = SizeOfPlane(image, plane, picture);
  return ExtentOf(image.planes[plane], image.strides[plane], size.rows, size.row_bytes);
}

bool ValidPixelStride(int32_t format, int32_t stride) {
  if (stride == 0 || stride == LeastStep(format)) return true;
  if (IsYuv(format)) return format == STARFOCUS_FORMAT_YUV_420_888 && stride == 2;
  return stride > LeastStep(format) && stride <= STARFOCUS_MAX_PIXEL_STRIDE;
}

// Names of the fields of an image, for error messages.
struct ImageNames {
  const char *format, *matrix, *range, *pixel_stride, *planes, *strides;
};

constexpr ImageNames kViewNames = {"views[].format",       "views[].matrix", "views[].range",
                                   "views[].pixel_stride", "views[].planes", "views[].strides"};
constexpr ImageNames kOutNames = {"out.format",       "out.matrix", "out.range",
                                  "out.pixel_stride", "out.planes", "out.strides"};

// Checks an image, which is view `index` of a light field or an output picture.
void CheckImage(const starfocus_image& image, const PictureSize& size, const ImageNames& names,
                int32_t index, Checker* check) {
  const int32_t format = image.format;
  check->In({names.format, double(format), index},
            {"a starfocus_format", 0, STARFOCUS_FORMAT_YUV_420_888});
  if (check->status() != STARFOCUS_OK) return;
  if (IsYuv(format)) {
    check->In({names.matrix, double(image.matrix), index},
              {"a starfocus_matrix", STARFOCUS_MATRIX_BT601, STARFOCUS_MATRIX_BT709});
    check->In({names.range, double(image.range), index},
              {"a starfocus_range", STARFOCUS_RANGE_LIMITED, STARFOCUS_RANGE_FULL});
  }
  check->Need(ValidPixelStride(format, image.pixel_stride), STARFOCUS_ERROR_RANGE,
              {names.pixel_stride, double(image.pixel_stride), index},
              {"0, or a number of bytes that the format allows"});
  if (check->status() != STARFOCUS_OK) return;
  for (int plane = 0; plane < PlanesOfFormat(format); ++plane) {
    check->NotNull(image.planes[plane], names.planes, index);
    const PlaneSize bytes = SizeOfPlane(image, plane, size);
    check->Stride(ValidStride(image.strides[plane], bytes.row_bytes, bytes.rows), names.strides,
                  image.strides[plane], index);
  }
}

void NeedInPlace(const starfocus_image& image, const ImageNames& names, int32_t index,
                 Checker* check) {
  check->Need(
      IsInPlace(image), STARFOCUS_ERROR_FEATURE, {names.format, double(image.format), index},
      {"STARFOCUS_FORMAT_RGB without gaps, or STARFOCUS_FEATURE_IMAGES in config.features"});
}

}  // namespace

starfocus_status CheckViews(const starfocus_light_field& light_field, int32_t count,
                            const PictureSize& size, starfocus_problem* problem) {
  Checker check(problem);
  for (int32_t view = 0; view < count; ++view) {
    CheckImage(light_field.views[view], size, kViewNames, view, &check);
  }
  return check.status();
}

starfocus_status CheckDepthMap(const starfocus_depth_map& map, const PictureSize& size,
                               starfocus_problem* problem) {
  Checker check(problem);
  check.NotNull(map.data, "depth.data");
  check.In({"depth.type", double(map.type)},
           {"a starfocus_depth_type", 0, STARFOCUS_DEPTH_DEPTH16});
  check.In({"depth.meaning", double(map.meaning)},
           {"a starfocus_depth_meaning", 0, STARFOCUS_DEPTH_RECIPROCAL});
  check.In({"depth.has_invalid", double(map.has_invalid)}, STARFOCUS_FROM_TO(0, 1));
  const auto scale = static_cast<float>(map.scale), offset = static_cast<float>(map.offset);
  check.Need(IsFinite(scale) && scale != 0, STARFOCUS_ERROR_RANGE, {"depth.scale", map.scale},
             {"a finite float other than 0"});
  check.Need(IsFinite(offset), STARFOCUS_ERROR_RANGE, {"depth.offset", map.offset},
             {"a finite float"});
  check.In({"depth.width", double(map.width)}, {"1 to width", 1, double(size.width)});
  check.In({"depth.height", double(map.height)}, {"1 to height", 1, double(size.height)});
  if (check.status() != STARFOCUS_OK) return check.status();
  const size_t bytes = DepthBytes(map.type);
  check.Stride(ValidStride(map.stride, bytes * static_cast<size_t>(map.width), map.height) &&
                   map.stride % bytes == 0 && reinterpret_cast<uintptr_t>(map.data) % bytes == 0,
               "depth.stride", map.stride);
  return check.status();
}

starfocus_status CheckLoneMap(const starfocus_depth_map& map, const PictureSize& size) {
  Checker check(nullptr);
  const Allowed allowed = STARFOCUS_FROM_TO(1, STARFOCUS_MAX_SIZE);
  check.In({"width", double(size.width)}, allowed);
  check.In({"height", double(size.height)}, allowed);
  return check.status() == STARFOCUS_OK ? CheckDepthMap(map, size, nullptr) : check.status();
}

starfocus_status CheckInPlace(const starfocus_light_field& light_field, int32_t count,
                              starfocus_problem* problem) {
  Checker check(problem);
  for (int32_t view = 0; view < count; ++view) {
    NeedInPlace(light_field.views[view], kViewNames, view, &check);
  }
  return check.status();
}

starfocus_status CheckInPlace(const starfocus_depth_map& map, const PictureSize& size,
                              starfocus_problem* problem) {
  Checker check(problem);
  check.Need(
      IsInPlace(map, size.width, size.height), STARFOCUS_ERROR_FEATURE, {"depth"},
      {"a map of starfocus_depth_float in the size of the picture, or STARFOCUS_FEATURE_IMAGES "
       "in config.features"});
  return check.status();
}

starfocus_status CheckLightField(const starfocus_config& config,
                                 const starfocus_light_field& light_field) {
  const PictureSize size = {config.width, config.height};
  starfocus_problem* const problem = config.problem;
  starfocus_status status = CheckViews(light_field, config.views, size, problem);
  if (status == STARFOCUS_OK) {
    status = CheckCoverage(config, light_field.coverage, light_field.coverage_stride);
  }
  if (status == STARFOCUS_OK) status = CheckDepthMap(light_field.depth, size, problem);
  if (status != STARFOCUS_OK || Has(config.features, STARFOCUS_FEATURE_IMAGES)) return status;
  status = CheckInPlace(light_field, config.views, problem);
  return status == STARFOCUS_OK ? CheckInPlace(light_field.depth, size, problem) : status;
}

void AddDepthMap(const starfocus_depth_map& map, Extents* extents) {
  extents->AddRows(map.data, map.stride, map.height,
                   DepthBytes(map.type) * static_cast<size_t>(map.width));
}

void AddLightField(const starfocus_config& config, const starfocus_light_field& light_field,
                   Extents* extents) {
  AddDepthMap(light_field.depth, extents);
  extents->AddCoverage(config, light_field.coverage, light_field.coverage_stride);
  for (int view = 0; view < config.views; ++view) {
    AddImage(light_field.views[view], {config.width, config.height}, extents);
  }
}

void AddImage(const starfocus_image& image, const PictureSize& size, Extents* extents) {
  for (int plane = 0; plane < PlanesOfFormat(image.format); ++plane) {
    extents->Add(ExtentOfPlane(image, plane, size));
  }
}

starfocus_status CheckOutput(const starfocus_config& config, const starfocus_image& image,
                             const PictureSize& size) {
  Checker check(config.problem);
  CheckImage(image, size, kOutNames, 0, &check);
  if (!Has(config.features, STARFOCUS_FEATURE_IMAGES)) NeedInPlace(image, kOutNames, 0, &check);
  return check.status();
}

starfocus_status CheckOutputApart(const starfocus_image& image, const PictureSize& size,
                                  const Extents& read, starfocus_problem* problem) {
  starfocus_status status = STARFOCUS_OK;
  for (int plane = 0; status == STARFOCUS_OK && plane < PlanesOfFormat(image.format); ++plane) {
    status = CheckApart(ExtentOfPlane(image, plane, size), read, "out", problem);
  }
  return status;
}

starfocus_status TellPlace(starfocus_status status, const starfocus_depth_map& map, int32_t first,
                           starfocus_problem* problem) {
  const bool range = status == STARFOCUS_ERROR_DISPARITY;
  if (problem == nullptr || (!range && status != STARFOCUS_ERROR_NOT_FINITE)) return status;
  const auto low = static_cast<float>(problem->low), high = static_cast<float>(problem->high);
  for (int32_t y = 0; y < map.height; ++y) {
    for (int32_t x = 0; x < map.width; ++x) {
      float disparity;
      ReadDisparities(map, x, y, 1, &disparity);
      const bool inside = disparity >= low && disparity <= high;
      if (range ? inside || !IsFinite(disparity) : IsFinite(disparity)) continue;
      if (range) problem->value = double{disparity};
      problem->x = x;
      problem->y = first + y;
      return status;
    }
  }
  return status;
}

}  // namespace starfocus
