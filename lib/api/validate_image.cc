// SPDX-License-Identifier: Apache-2.0
#include "lib/api/validate_image.h"

#include "lib/api/validate.h"
#include "lib/base/features.h"
#include "lib/base/gaps.h"
#include "lib/convert/depth_rows.h"
#include "lib/convert/image_planes.h"

namespace starfocus {
namespace {

int PlanesOfFormat(int32_t format) { return !IsYuv(format) ? 1 : IsPaired(format) ? 2 : 3; }

// The rows of a plane and the bytes of each.
struct PlaneSize {
  int32_t rows;
  size_t row_bytes;
};

PlaneSize SizeOfPlane(const sf_image& image, int plane, int32_t width, int32_t height) {
  const auto pixels = static_cast<size_t>(width), samples = (pixels + 1) / 2;
  const int32_t given = image.pixel_stride, format = image.format;
  const auto step = static_cast<size_t>(given != 0 ? given : LeastStep(format));
  if (!IsYuv(format)) return {height, (pixels - 1) * step + (HasAlpha(format) ? 4 : 3)};
  if (plane == 0) return {height, pixels};
  return {(height + 1) / 2, IsPaired(format) ? 2 * samples : (samples - 1) * step + 1};
}

Extent ExtentOfPlane(const sf_image& image, int plane, int32_t width, int32_t height) {
  const PlaneSize size = SizeOfPlane(image, plane, width, height);
  return ExtentOf(image.planes[plane], image.strides[plane], size.rows, size.row_bytes);
}

bool ValidPixelStride(int32_t format, int32_t stride) {
  if (stride == 0 || stride == LeastStep(format)) return true;
  if (IsYuv(format)) return format == SF_FORMAT_YUV_420_888 && stride == 2;
  return stride > LeastStep(format) && stride <= SF_MAX_PIXEL_STRIDE;
}

sf_status CheckDepthMap(const sf_config& config, const sf_depth_map& map) {
  Checker check(config.problem);
  check.NotNull(map.data, "depth.data");
  check.In({"depth.type", double(map.type)}, {"an sf_depth_type", 0, SF_DEPTH_HALF});
  check.In({"depth.meaning", double(map.meaning)}, {"an sf_depth_meaning", 0, SF_DEPTH_RECIPROCAL});
  check.In({"depth.has_invalid", double(map.has_invalid)}, STARFOCUS_FROM_TO(0, 1));
  check.Need(IsFinite(map.scale) && map.scale != 0, SF_ERROR_RANGE, {"depth.scale", map.scale},
             {"finite, not 0"});
  check.Need(IsFinite(map.offset), SF_ERROR_RANGE, {"depth.offset", map.offset}, {"finite"});
  check.In({"depth.width", double(map.width)}, {"1 to width", 1, double(config.width)});
  check.In({"depth.height", double(map.height)}, {"1 to height", 1, double(config.height)});
  if (check.status() != SF_OK) return check.status();
  const size_t bytes = DepthBytes(map.type);
  check.Stride(ValidStride(map.stride, bytes * static_cast<size_t>(map.width), map.height) &&
                   map.stride % bytes == 0 && reinterpret_cast<uintptr_t>(map.data) % bytes == 0,
               "depth.stride", map.stride);
  return check.status();
}

}  // namespace

sf_status NeedImages(const sf_config& config) {
  Checker check(config.problem);
  check.Need(Has(config.features, SF_FEATURE_IMAGES), SF_ERROR_FEATURE,
             {"features", double(config.features)}, {"SF_FEATURE_IMAGES"});
  return check.status();
}

sf_status CheckImage(const sf_image& image, const Rect& size, sf_problem* problem, int32_t index) {
  Checker check(problem);
  const int32_t format = image.format;
  check.In({"image.format", double(format), index}, {"an sf_format", 0, SF_FORMAT_YUV_420_888});
  if (check.status() != SF_OK) return check.status();
  if (IsYuv(format)) {
    check.In({"image.matrix", double(image.matrix), index},
             {"an sf_matrix", SF_MATRIX_BT601, SF_MATRIX_BT709});
    check.In({"image.range", double(image.range), index},
             {"an sf_range", SF_RANGE_LIMITED, SF_RANGE_FULL});
  }
  check.Need(ValidPixelStride(format, image.pixel_stride), SF_ERROR_RANGE,
             {"image.pixel_stride", double(image.pixel_stride), index},
             {"0, or bytes that the format allows"});
  if (check.status() != SF_OK) return check.status();
  for (int plane = 0; plane < PlanesOfFormat(format); ++plane) {
    check.NotNull(image.planes[plane], "image.planes", index);
    const PlaneSize bytes = SizeOfPlane(image, plane, size.width, size.height);
    check.Stride(ValidStride(image.strides[plane], bytes.row_bytes, bytes.rows), "image.strides",
                 image.strides[plane], index);
  }
  return check.status();
}

sf_status CheckImageField(const sf_config& config, const sf_image_field& field) {
  for (int32_t view = 0; view < config.views; ++view) {
    const sf_status status =
        CheckImage(field.views[view], {0, 0, config.width, config.height}, config.problem, view);
    if (status != SF_OK) return status;
  }
  const sf_status status = CheckCoverage(config, field.coverage, field.coverage_stride);
  return status == SF_OK ? CheckDepthMap(config, field.depth) : status;
}

void AddImageField(const sf_config& config, const sf_image_field& field, Extents* extents) {
  const sf_depth_map& map = field.depth;
  extents->AddRows(map.data, map.stride, map.height,
                   DepthBytes(map.type) * static_cast<size_t>(map.width));
  extents->AddCoverage(config, field.coverage, field.coverage_stride);
  for (int view = 0; view < config.views; ++view) {
    const sf_image& image = field.views[view];
    for (int plane = 0; plane < PlanesOfFormat(image.format); ++plane) {
      extents->Add(ExtentOfPlane(image, plane, config.width, config.height));
    }
  }
}

sf_status CheckImageOutput(const sf_image& image, const Rect& size, const Extents& read,
                           sf_problem* problem) {
  sf_status status = CheckImage(image, size, problem);
  for (int plane = 0; status == SF_OK && plane < PlanesOfFormat(image.format); ++plane) {
    status = CheckApart(ExtentOfPlane(image, plane, size.width, size.height), read, "out", problem);
  }
  return status;
}

}  // namespace starfocus
