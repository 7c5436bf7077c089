// SPDX-License-Identifier: Apache-2.0
#include "lib/api/validate.h"

#include "lib/engine/engine.h"
#include "lib/engine/lens.h"
#include "lib/io/depth_map.h"
#include "lib/io/image.h"
#include "lib/optics/view_set.h"

namespace starfocus {
namespace {

// Checks all fields, including fields that the shape does not use.
void CheckLens(const FullConfig& config, const starfocus_params& lens, Checker* check) {
  CheckFocus(lens, check);
  check->In({"aperture", lens.aperture}, STARFOCUS_FROM_TO(0, 1));
  check->In({"shape", double(lens.shape)}, {"a starfocus_shape", 0, STARFOCUS_SHAPE_RING});
  check->In({"blades", double(lens.blades)},
            STARFOCUS_FROM_TO(STARFOCUS_MIN_BLADES, STARFOCUS_MAX_BLADES));
  check->In({"theta", lens.theta},
            {"0.05 pi to 0.45 pi", STARFOCUS_MIN_THETA, STARFOCUS_MAX_THETA});
  check->In({"rotation", lens.rotation}, STARFOCUS_FROM_TO(-360, 360));
  check->In({"curvature", lens.curvature}, STARFOCUS_FROM_TO(0, 1));
  check->In({"ring_inner", lens.ring_inner}, STARFOCUS_FROM_TO(0, STARFOCUS_MAX_RING_INNER));
  check->In({"cats_eye", lens.cats_eye}, STARFOCUS_FROM_TO(0, 1));
  if (Has(config, STARFOCUS_FEATURE_SHAPES)) return;
  check->Need(lens.shape != STARFOCUS_SHAPE_POLYGON, STARFOCUS_ERROR_FEATURE,
              {"shape", double(lens.shape)},
              {"not STARFOCUS_SHAPE_POLYGON without STARFOCUS_FEATURE_SHAPES"});
  check->Need(lens.cats_eye == 0, STARFOCUS_ERROR_FEATURE, {"cats_eye", lens.cats_eye},
              {"0 without STARFOCUS_FEATURE_SHAPES"});
}

void CheckTiming(const starfocus_timing& timing, Checker* check) {
  const FieldValue fields[] = {{"tuning.timing.block", double(timing.block)},
                               {"tuning.timing.field", double(timing.field)},
                               {"tuning.timing.a", double(timing.a)},
                               {"tuning.timing.b", double(timing.b)},
                               {"tuning.timing.c", double(timing.c)},
                               {"tuning.timing.upsample", double(timing.upsample)},
                               {"tuning.timing.span", double(timing.span)},
                               {"tuning.timing.hole", double(timing.hole)}};
  for (const FieldValue& field : fields) {
    check->In(field, {"at most STARFOCUS_MAX_TIMING", 0, STARFOCUS_MAX_TIMING});
  }
}

void CheckTuning(const starfocus_tuning& tuning, Checker* check) {
  check->In({"tuning.max_layer", double(tuning.max_layer)}, STARFOCUS_FROM_TO(0, 2));
  check->In({"tuning.deblocking", double(tuning.deblocking)}, STARFOCUS_FROM_TO(0, 255));
  check->In({"tuning.gather", double(tuning.gather)}, STARFOCUS_FROM_TO(0, 1));
  check->In({"tuning.n_scale", tuning.n_scale},
            STARFOCUS_FROM_TO(STARFOCUS_MIN_N_SCALE, STARFOCUS_MAX_N_SCALE));
  CheckTiming(tuning.timing, check);
}

// Checks that a disparity map, whose argument is `name`, is aligned to its values of `bytes` bytes.
void CheckAligned(const void* map, size_t bytes, const char* name, Checker* check) {
  check->Need(reinterpret_cast<uintptr_t>(map) % bytes == 0, STARFOCUS_ERROR_STRIDE, {name},
              {"aligned to the type of its values"});
}

bool IsBlock(int32_t side) {
  return side == 0 || side == 32 || side == 64 || side == 128 || side == 256;
}

}  // namespace

bool AreEqual(const char* a, const char* b) {
  for (; *a != 0 && *a == *b; ++a) ++b;
  return *a == *b;
}

Checker Enter(starfocus_engine* engine) {
  if (engine == nullptr) return Checker(nullptr, STARFOCUS_ERROR_NULL);
  return Enter(&reinterpret_cast<EngineState*>(engine)->problem);
}

Checker Enter(const starfocus_config* config, starfocus_problem* problem, FullConfig* full) {
  *full = DefaultConfig();
  full->problem = problem;
  Checker check = Enter(problem);
  check.NotNull(config, "config");
  if (!check.passed()) return check;
  check.Read<starfocus_config>(*config, "config.size", full);
  const starfocus_tuning* const tuning = full->starfocus_config::tuning;
  if (check.passed() && tuning != nullptr) check.Read(*tuning, "tuning.size", &full->tuning);
  return check;
}

void ReadParams(const starfocus_params* params, FullParams* full, Checker* check) {
  if (!check->passed()) return;
  *full = DefaultParams();
  check->Read<starfocus_params>(*params, "params.size", full);
  if (!check->passed() || full->study == nullptr) return;
  starfocus_study study = {0, full->mode, full->renderer};
  check->Read(*full->study, "study.size", &study);
  full->mode = study.mode;
  full->renderer = study.renderer;
}

void CheckReport(const starfocus_report* report, Checker* check) {
  starfocus_report ignored;
  if (report != nullptr) check->Read(*report, "report.size", &ignored);
}

void CheckSize(int32_t width, int32_t height, Checker* check) {
  const Allowed size = STARFOCUS_FROM_TO(1, STARFOCUS_MAX_SIZE);
  check->In({"width", double(width)}, size);
  check->In({"height", double(height)}, size);
}

void CheckPicture(const FullConfig& config, Checker* check) {
  CheckSize(config.width, config.height, check);
  const Allowed disparity = STARFOCUS_FROM_TO(-STARFOCUS_MAX_DISPARITY, STARFOCUS_MAX_DISPARITY);
  check->In({"disparity_min", config.disparity_min}, disparity);
  check->In({"disparity_max", config.disparity_max}, disparity);
  check->In({"disparity_max", config.disparity_max},
            {"at least disparity_min", config.disparity_min, STARFOCUS_MAX_DISPARITY});
  check->In({"max_workers", double(config.max_workers)},
            STARFOCUS_FROM_TO(1, STARFOCUS_MAX_WORKERS));
}

void CheckFocus(const starfocus_params& lens, Checker* check) {
  check->In({"focus", lens.focus}, STARFOCUS_FROM_TO(-STARFOCUS_MAX_FOCUS, STARFOCUS_MAX_FOCUS));
  check->In({"focus_nearer", lens.focus_nearer},
            {"at least 0 and at most 1000000 - focus", 0, STARFOCUS_MAX_FOCUS - lens.focus});
  check->In({"focus_farther", lens.focus_farther},
            {"at least 0 and at most 1000000 + focus", 0, STARFOCUS_MAX_FOCUS + lens.focus});
}

void CheckConfig(const FullConfig& config, Checker* check) {
  CheckPicture(config, check);
  if (!check->passed()) return;
  ViewSet views;
  check->Add(FindViews(config.views, config.positions, config.problem, &views));
  check->Need(config.max_blur > 0.0 && config.max_blur <= STARFOCUS_MAX_BLUR, STARFOCUS_ERROR_RANGE,
              {"max_blur", config.max_blur},
              {"above 0 and at most STARFOCUS_MAX_BLUR", kNoNumber, STARFOCUS_MAX_BLUR});
  check->Need(IsBlock(config.superblock), STARFOCUS_ERROR_RANGE,
              {"superblock", double(config.superblock)}, {"0, 32, 64, 128 or 256"});
  CheckTuning(config.tuning, check);
  constexpr uint32_t kFeatures = STARFOCUS_FEATURE_COVERAGE | STARFOCUS_FEATURE_STREAMING |
                                 STARFOCUS_FEATURE_IMAGES | STARFOCUS_FEATURE_SHAPES |
                                 (kDeep ? STARFOCUS_FEATURE_DEEP : 0);
  check->Need((config.features & ~kFeatures) == 0, STARFOCUS_ERROR_RANGE,
              {"features", double(config.features)}, {"bits of STARFOCUS_FEATURE_"});
  check->In({"unknown", double(config.unknown)},
            {"a starfocus_unknown", 0, STARFOCUS_UNKNOWN_FILL});
  check->In({"previews", double(config.previews)}, STARFOCUS_FROM_TO(0, STARFOCUS_MAX_PREVIEW));
  const bool deep = HasDeep(config);
  check->In({"transfer", double(config.transfer)},
            {deep ? "a starfocus_transfer" : "SRGB or NONE without STARFOCUS_FEATURE_DEEP", 0,
             double(deep ? STARFOCUS_TRANSFER_HLG : STARFOCUS_TRANSFER_NONE)});
  check->In({"highlights", config.highlights}, STARFOCUS_FROM_TO(1, STARFOCUS_MAX_HIGHLIGHTS));
  check->Need(!deep || config.highlights == 1, STARFOCUS_ERROR_FEATURE,
              {"highlights", config.highlights}, {"1 with STARFOCUS_FEATURE_DEEP"});
}

void CheckParams(const FullConfig& config, const FullParams& params, Checker* check) {
  check->In({"study.mode", double(params.mode)}, {"a starfocus_mode", 0, STARFOCUS_MODE_BLUR});
  check->In({"study.renderer", double(params.renderer)},
            {"a starfocus_renderer", 0, STARFOCUS_RENDERER_SLICES});
  CheckLens(config, params, check);
  if (params.renderer == STARFOCUS_RENDERER_LINE_SCAN && params.mode != STARFOCUS_MODE_BLUR) {
    check->Need(config.tuning.line_scan != nullptr, STARFOCUS_ERROR_FEATURE,
                {"study.renderer", double(params.renderer)},
                {"not STARFOCUS_RENDERER_LINE_SCAN without starfocus_tuning.line_scan"});
    check->Need(HasStar(config), STARFOCUS_ERROR_FEATURE,
                {"study.renderer", double(params.renderer)},
                {"not STARFOCUS_RENDERER_LINE_SCAN without the views of starfocus_view_position"});
  }
  if (check->passed()) check->Add(CheckBlur(config, params));
}

void CheckMemory(const char* name, const void* memory, size_t bytes, size_t needed,
                 Checker* check) {
  const auto address = reinterpret_cast<uintptr_t>(memory);
  check->NotNull(memory, name);
  check->Need(address % STARFOCUS_ALIGNMENT == 0, STARFOCUS_ERROR_WORKSPACE, {name},
              {"aligned to STARFOCUS_ALIGNMENT bytes"});
  check->Need(bytes >= needed, STARFOCUS_ERROR_WORKSPACE, {"bytes", double(bytes)},
              {"at least the number of bytes that the size function returns", double(needed)});
}

void CheckMap(const float* disparity, size_t stride, int32_t width, int32_t height,
              const char* name, const char* stride_name, Checker* check) {
  check->NotNull(disparity, name);
  CheckSize(width, height, check);
  if (!check->passed()) return;
  CheckAligned(disparity, sizeof(float), name, check);
  check->Stride(stride % sizeof(float) == 0 &&
                    ValidStride(stride, sizeof(float) * static_cast<size_t>(width), height),
                stride_name, stride);
}

bool ValidStride(size_t stride, size_t row_bytes, int32_t rows) {
  return stride >= row_bytes &&
         (rows <= 1 || stride <= (PTRDIFF_MAX - row_bytes) / static_cast<size_t>(rows - 1));
}

void CheckBytes(const uint8_t* plane, size_t stride, int32_t width, int32_t height,
                const char* name, Checker* check) {
  check->Stride(plane == nullptr || ValidStride(stride, static_cast<size_t>(width), height), name,
                stride);
}

void CheckRegion(const starfocus_region& region, int32_t width, int32_t height, Checker* check) {
  if (IsWhole(region)) return;
  check->In({"region.x", double(region.x)}, {"inside the picture", 0, width - 1.0});
  check->In({"region.y", double(region.y)}, {"inside the picture", 0, height - 1.0});
  check->In({"region.width", double(region.width)},
            {"inside the picture", 1, width - double(region.x)});
  check->In({"region.height", double(region.height)},
            {"inside the picture", 1, height - double(region.y)});
}
namespace {

int PlanesOfFormat(int32_t format) { return !IsYuv(format) ? 1 : IsPaired(format) ? 2 : 3; }

// Returns the number of rows of a plane of an image whose height is `height`.
int32_t PlaneRows(int32_t format, int plane, int32_t height) {
  return HasRowPairs(format) && plane != 0 ? (height + 1) / 2 : height;
}

// Returns the number of bytes of a row of a plane.
size_t PlaneRowBytes(const starfocus_image& image, int plane, int32_t width) {
  const auto pixels = static_cast<size_t>(width), samples = (pixels + 1) / 2;
  const int32_t given = image.pixel_stride, format = image.format;
  const auto step = static_cast<size_t>(given != 0 ? given : LeastStep(format));
  const auto bytes = static_cast<size_t>(SampleBytes(format));
  if (!IsYuv(format)) return (pixels - 1) * step + static_cast<size_t>(LeastStep(format));
  if (plane == 0) return bytes * pixels;
  return IsPaired(format) ? 2 * bytes * samples : (samples - 1) * step + 1;
}

Extent ExtentOfPlane(const starfocus_image& image, int plane, int32_t width, int32_t height) {
  return ExtentOf(image.planes[plane], image.strides[plane], PlaneRows(image.format, plane, height),
                  PlaneRowBytes(image, plane, width));
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

constexpr ImageNames kViewNames = {STARFOCUS_IMAGE_FIELDS("views[].")};
constexpr ImageNames kOutNames = {STARFOCUS_IMAGE_FIELDS("out.")};
constexpr ImageNames kImageNames = {STARFOCUS_IMAGE_FIELDS("")};

// Checks the format and the pixel_stride of an image.
void CheckLayout(const starfocus_image& image, bool deep, const ImageNames& names, int32_t index,
                 Checker* check) {
  check->In({names.format, double(image.format), index},
            {deep ? "a starfocus_format" : "a format of 8 bits without STARFOCUS_FEATURE_DEEP", 0,
             double(deep ? STARFOCUS_FORMAT_P210 : STARFOCUS_FORMAT_YUV_420_888)});
  if (!check->passed()) return;
  check->Need(ValidPixelStride(image.format, image.pixel_stride), STARFOCUS_ERROR_RANGE,
              {names.pixel_stride, double(image.pixel_stride), index},
              {"0, or a number of bytes that the format allows"});
  check->Need(image.pixel_stride % SampleBytes(image.format) == 0, STARFOCUS_ERROR_RANGE,
              {names.pixel_stride, double(image.pixel_stride), index},
              {"a multiple of the size of a sample"});
}

// Checks that the samples of a plane of an image are aligned.
void CheckSamples(const starfocus_image& image, int plane, const ImageNames& names, int32_t index,
                  Checker* check) {
  const auto bytes = static_cast<size_t>(SampleBytes(image.format));
  check->Need(reinterpret_cast<uintptr_t>(image.planes[plane]) % bytes == 0, STARFOCUS_ERROR_STRIDE,
              {names.planes, kNoNumber, index}, {"aligned to the type of the samples"});
  check->Stride(image.strides[plane] % bytes == 0, names.strides, image.strides[plane], index);
}

// Checks an image, which is view `index` of a light field or an output picture.
void CheckImage(const starfocus_image& image, bool deep, int32_t width, int32_t height,
                const ImageNames& names, int32_t index, Checker* check) {
  const int32_t format = image.format;
  CheckLayout(image, deep, names, index, check);
  if (!check->passed()) return;
  if (IsYuv(format)) {
    check->In({names.matrix, double(image.matrix), index},
              {"a starfocus_matrix", STARFOCUS_MATRIX_BT601, STARFOCUS_MATRIX_BT709});
    check->In({names.range, double(image.range), index},
              {"a starfocus_range", STARFOCUS_RANGE_LIMITED, STARFOCUS_RANGE_FULL});
  }
  if (!check->passed()) return;
  for (int plane = 0; plane < PlanesOfFormat(format); ++plane) {
    check->NotNull(image.planes[plane], names.planes, index);
    const size_t stride = image.strides[plane];
    CheckSamples(image, plane, names, index, check);
    check->Stride(
        ValidStride(stride, PlaneRowBytes(image, plane, width), PlaneRows(format, plane, height)),
        names.strides, stride, index);
  }
}

void NeedInPlace(const starfocus_image& image, const ImageNames& names, int32_t index,
                 Checker* check) {
  check->Need(
      IsInPlace(image), STARFOCUS_ERROR_FEATURE, {names.format, double(image.format), index},
      {"STARFOCUS_FORMAT_RGB without gaps, or STARFOCUS_FEATURE_IMAGES in config.features"});
}

}  // namespace

void CheckViews(const starfocus_light_field& light_field, int32_t count, int32_t width,
                int32_t height, bool deep, Checker* check) {
  if (!check->passed()) return;
  for (int32_t view = 0; view < count; ++view) {
    CheckImage(light_field.views[view], deep, width, height, kViewNames, view, check);
  }
}

void CheckDepthMap(const starfocus_depth_map& map, int32_t width, int32_t height, Checker* check) {
  check->NotNull(map.data, "depth.data");
  check->In({"depth.type", double(map.type)},
            {"a starfocus_depth_type", 0, STARFOCUS_DEPTH_DEPTH16});
  check->In({"depth.meaning", double(map.meaning)},
            {"a starfocus_depth_meaning", 0, STARFOCUS_DEPTH_RECIPROCAL});
  check->In({"depth.has_invalid", double(map.has_invalid)}, STARFOCUS_FROM_TO(0, 1));
  const auto scale = static_cast<float>(map.scale), offset = static_cast<float>(map.offset);
  check->Need(IsFinite(scale) && scale != 0, STARFOCUS_ERROR_RANGE, {"depth.scale", map.scale},
              {"a finite float other than 0"});
  check->Need(IsFinite(offset), STARFOCUS_ERROR_RANGE, {"depth.offset", map.offset},
              {"a finite float"});
  check->In({"depth.width", double(map.width)}, {"1 to width", 1, double(width)});
  check->In({"depth.height", double(map.height)}, {"1 to height", 1, double(height)});
  if (!check->passed()) return;
  const size_t bytes = DepthBytes(map.type);
  CheckAligned(map.data, bytes, "depth.data", check);
  check->Stride(ValidStride(map.stride, bytes * static_cast<size_t>(map.width), map.height) &&
                    map.stride % bytes == 0,
                "depth.stride", map.stride);
}

void CheckLoneMap(const starfocus_depth_map& map, int32_t width, int32_t height, Checker* check) {
  CheckSize(width, height, check);
  CheckDepthMap(map, width, height, check);
}

void CheckInPlace(const FullConfig& config, const starfocus_light_field& light_field, bool has_map,
                  Checker* check) {
  for (int32_t view = 0; view < config.views; ++view) {
    NeedInPlace(light_field.views[view], kViewNames, view, check);
  }
  check->Need(
      !has_map || IsInPlace(light_field.depth, config.width, config.height),
      STARFOCUS_ERROR_FEATURE, {"depth"},
      {"a map of starfocus_depth_float in the size of the picture, or STARFOCUS_FEATURE_IMAGES "
       "in config.features"});
}

void CheckLightField(const FullConfig& config, const starfocus_light_field& light_field,
                     Checker* check) {
  const int32_t width = config.width, height = config.height;
  CheckViews(light_field, config.views, width, height, HasDeep(config), check);
  CheckBytes(light_field.coverage, light_field.coverage_stride, width, height, "coverage_stride",
             check);
  CheckDepthMap(light_field.depth, width, height, check);
  if (!ReadsImages(config)) CheckInPlace(config, light_field, true, check);
}

void AddDepthMap(const starfocus_depth_map& map, Extents* extents) {
  extents->AddRows(map.data, map.stride, map.height,
                   DepthBytes(map.type) * static_cast<size_t>(map.width));
}

void AddLightField(const FullConfig& config, const starfocus_light_field& light_field,
                   Extents* extents) {
  AddDepthMap(light_field.depth, extents);
  if (light_field.coverage != nullptr) {
    extents->AddRows(light_field.coverage, light_field.coverage_stride, config.height,
                     static_cast<size_t>(config.width));
  }
  for (int view = 0; view < config.views; ++view) {
    AddImage(light_field.views[view], config.width, config.height, extents);
  }
}

void AddImage(const starfocus_image& image, int32_t width, int32_t height, Extents* extents) {
  for (int plane = 0; plane < PlanesOfFormat(image.format); ++plane) {
    extents->Add(ExtentOfPlane(image, plane, width, height));
  }
}

void CheckOutput(const FullConfig& config, const starfocus_image& image, int32_t width,
                 int32_t height, Checker* check) {
  CheckImage(image, HasDeep(config), width, height, kOutNames, 0, check);
  if (!ReadsImages(config)) NeedInPlace(image, kOutNames, 0, check);
}

void CheckOutputApart(const starfocus_image& image, int32_t width, int32_t height,
                      const Extents& read, Checker* check) {
  for (int plane = 0; plane < PlanesOfFormat(image.format); ++plane) {
    check->Apart(ExtentOfPlane(image, plane, width, height), read, "out");
  }
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

using namespace starfocus;

starfocus_status starfocus_plane_size(const starfocus_image* image, int32_t plane, int32_t width,
                                      int32_t height, int32_t* rows, size_t* row_bytes,
                                      starfocus_problem* problem) {
  Checker check = Enter(problem);
  check.NotNull(image, "image");
  check.NotNull(rows, "rows");
  check.NotNull(row_bytes, "row_bytes");
  CheckSize(width, height, &check);
  if (!check.passed()) return check.status();
  CheckLayout(*image, true, kImageNames, 0, &check);
  if (!check.passed()) return check.status();
  check.In({"plane", double(plane)}, STARFOCUS_FROM_TO(0, 2));
  if (!check.passed()) return check.status();
  const bool is_used = plane < PlanesOfFormat(image->format);
  *rows = is_used ? PlaneRows(image->format, plane, height) : 0;
  *row_bytes = is_used ? PlaneRowBytes(*image, plane, width) : 0;
  return STARFOCUS_OK;
}
