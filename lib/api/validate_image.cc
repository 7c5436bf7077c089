// SPDX-License-Identifier: Apache-2.0
#include "lib/api/validate_image.h"

#include "lib/api/validate.h"
#include "lib/base/features.h"
#include "lib/io/depth_values.h"
#include "lib/io/gaps.h"
#include "lib/io/image_planes.h"
#include "lib/io/rows.h"

namespace starfocus {
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
