// SPDX-License-Identifier: Apache-2.0
#include "lib/api/validate_image.h"

#include "lib/api/validate.h"
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
  if (map.data == nullptr) return SF_ERROR_NULL;
  if (map.type < SF_DEPTH_FLOAT || map.type > SF_DEPTH_HALF || map.meaning < SF_DEPTH_LINEAR ||
      map.meaning > SF_DEPTH_RECIPROCAL || (map.has_invalid != 0 && map.has_invalid != 1)) {
    return SF_ERROR_DEPTH_TYPE;
  }
  if (!IsFinite(map.scale) || map.scale == 0 || !IsFinite(map.offset)) return SF_ERROR_DEPTH_SCALE;
  if (map.width < 1 || map.height < 1 || map.width > config.width || map.height > config.height) {
    return SF_ERROR_DEPTH_SIZE;
  }
  const size_t bytes = DepthBytes(map.type);
  if (!ValidStride(map.stride, bytes * static_cast<size_t>(map.width), map.height) ||
      map.stride % bytes != 0 || reinterpret_cast<uintptr_t>(map.data) % bytes != 0) {
    return SF_ERROR_STRIDE;
  }
  return SF_OK;
}

}  // namespace

sf_status CheckImage(const sf_image& image, int32_t width, int32_t height) {
  const int32_t format = image.format;
  if (format < SF_FORMAT_RGB || format > SF_FORMAT_YUV_420_888) return SF_ERROR_FORMAT;
  if (IsYuv(format) && (image.matrix < SF_MATRIX_BT601 || image.matrix > SF_MATRIX_BT709 ||
                        image.range < SF_RANGE_LIMITED || image.range > SF_RANGE_FULL)) {
    return SF_ERROR_FORMAT;
  }
  if (!ValidPixelStride(format, image.pixel_stride)) return SF_ERROR_PIXEL_STRIDE;
  for (int plane = 0; plane < PlanesOfFormat(format); ++plane) {
    if (image.planes[plane] == nullptr) return SF_ERROR_NULL;
    const PlaneSize size = SizeOfPlane(image, plane, width, height);
    if (!ValidStride(image.strides[plane], size.row_bytes, size.rows)) return SF_ERROR_STRIDE;
  }
  return SF_OK;
}

sf_status CheckImageField(const sf_config& config, const sf_image_field& field) {
  for (int view = 0; view < config.views; ++view) {
    const sf_status status = CheckImage(field.views[view], config.width, config.height);
    if (status != SF_OK) return status;
  }
  if (!ValidCoverage(config, field.coverage, field.coverage_stride)) return SF_ERROR_STRIDE;
  return CheckDepthMap(config, field.depth);
}

sf_image AsImage(const sf_image_out& out) {
  return {out.format,
          out.matrix,
          out.range,
          out.pixel_stride,
          {out.planes[0], out.planes[1], out.planes[2]},
          {out.strides[0], out.strides[1], out.strides[2]}};
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

sf_status CheckImageOutput(const sf_image& image, int32_t width, int32_t height,
                           const Extents& read) {
  const sf_status status = CheckImage(image, width, height);
  if (status != SF_OK) return status;
  for (int plane = 0; plane < PlanesOfFormat(image.format); ++plane) {
    if (Overlaps(ExtentOfPlane(image, plane, width, height), read)) return SF_ERROR_OVERLAP;
  }
  return SF_OK;
}

}  // namespace starfocus
