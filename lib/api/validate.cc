// SPDX-License-Identifier: Apache-2.0
#include "lib/api/validate.h"

#include <initializer_list>

#include "lib/base/view_set.h"
#include "lib/engine/engine.h"

namespace starfocus {
namespace {

template <size_t kCount>
bool AllZero(const uint32_t (&reserved)[kCount]) {
  for (const uint32_t value : reserved) {
    if (value != 0) return false;
  }
  return true;
}

// All fields are checked, those of other shapes than the one asked for, too. The comparisons are
// written so that NaN fails.
sf_status CheckShape(const sf_config& config) {
  if (config.aperture_shape < SF_SHAPE_FALL_OFF || config.aperture_shape > SF_SHAPE_RING) {
    return SF_ERROR_SHAPE;
  }
  if (config.blades < SF_MIN_BLADES || config.blades > SF_MAX_BLADES) return SF_ERROR_BLADES;
  if (!(config.rotation >= -360 && config.rotation <= 360)) return SF_ERROR_ROTATION;
  if (!(config.curvature >= 0 && config.curvature <= 1)) return SF_ERROR_CURVATURE;
  if (!(config.ring_inner >= 0 && config.ring_inner <= static_cast<float>(SF_MAX_RING_INNER))) {
    return SF_ERROR_RING;
  }
  if (!(config.cats_eye >= 0 && config.cats_eye <= 1)) return SF_ERROR_CATS_EYE;
  return SF_OK;
}

bool ValidSize(int32_t size) { return size >= 1 && size <= SF_MAX_SIZE; }

}  // namespace

sf_status CheckConfig(const sf_config& config) {
  if (config.version != SF_ABI_VERSION) return SF_ERROR_VERSION;
  if (!AllZero(config.reserved) ||
      (config.features & ~(SF_FEATURE_LINE_SCAN | SF_FEATURE_COVERAGE)) != 0) {
    return SF_ERROR_RESERVED;
  }
  if (!ValidSize(config.width) || !ValidSize(config.height)) return SF_ERROR_SIZE;
  ViewSet views;
  const sf_status status = FindViews(config, &views);
  if (status != SF_OK) return status;
  // The comparison is written so that NaN fails.
  if (!(config.disparity_min >= -SF_MAX_DISPARITY && config.disparity_max <= SF_MAX_DISPARITY &&
        config.disparity_min <= config.disparity_max)) {
    return SF_ERROR_DISPARITY_RANGE;
  }
  if (!(config.max_blur > 0.0 && config.max_blur <= SF_MAX_BLUR)) return SF_ERROR_MAX_BLUR;
  const int32_t block = config.largest_block;
  if (block != 0 && block != 32 && block != 64 && block != 128 && block != 256) {
    return SF_ERROR_BLOCK;
  }
  if (config.max_workers < 1 || config.max_workers > SF_MAX_WORKERS) return SF_ERROR_WORKERS;
  if (config.streaming != 0 && config.streaming != 1) return SF_ERROR_STATE;
  if (!(config.theta >= SF_MIN_THETA && config.theta <= SF_MAX_THETA)) return SF_ERROR_THETA;
  if (config.max_layer < 0 || config.max_layer >= SF_LAYERS) return SF_ERROR_LAYER;
  if (config.deblocking < 0 || config.deblocking > 255) return SF_ERROR_DEBLOCKING;
  const sf_timing& timing = config.timing;
  for (const uint32_t coefficient : {timing.block, timing.field, timing.a, timing.b, timing.c,
                                     timing.upsample, timing.span, timing.hole}) {
    if (coefficient > SF_MAX_TIMING) return SF_ERROR_TIMING;
  }
  if (!(config.n_scale >= SF_MIN_N_SCALE && config.n_scale <= SF_MAX_N_SCALE)) {
    return SF_ERROR_N_SCALE;
  }
  if (config.skips != 0 && config.skips != 1) return SF_ERROR_SKIPS;
  if (config.fill_unknown != 0 && config.fill_unknown != 1) return SF_ERROR_FILL;
  if (config.images != 0 && config.images != 1) return SF_ERROR_IMAGES;
  if (config.previews < 0 || config.previews > SF_MAX_PREVIEW) return SF_ERROR_PREVIEW;
  if (config.gather != 0 && config.gather != 1) return SF_ERROR_GATHER;
  if (config.transfer != SF_TRANSFER_SRGB && config.transfer != SF_TRANSFER_NONE) {
    return SF_ERROR_TRANSFER;
  }
  if (!(config.highlights >= 1 && config.highlights <= SF_MAX_HIGHLIGHTS)) {
    return SF_ERROR_HIGHLIGHTS;
  }
  return CheckShape(config);
}

sf_status CheckParams(const sf_config& config, const sf_params& params) {
  if (params.version != SF_ABI_VERSION) return SF_ERROR_VERSION;
  if (!AllZero(params.reserved)) return SF_ERROR_RESERVED;
  if (params.mode < SF_MODE_FRAME || params.mode > SF_MODE_BLUR) return SF_ERROR_MODE;
  if (params.rule < SF_RULE_DEFAULT || params.rule > SF_RULE_SUBAPERTURE) return SF_ERROR_RULE;
  if (!(params.focus >= -SF_MAX_FOCUS && params.focus <= SF_MAX_FOCUS)) return SF_ERROR_FOCUS;
  if (!(params.aperture >= 0.0 && params.aperture <= 1.0)) return SF_ERROR_APERTURE;
  const bool paper = params.rule == SF_RULE_PAPER && params.mode != SF_MODE_BLUR;
  if (paper && !HasLineScan(config)) return SF_ERROR_RULE;
  return paper && !HasStar(config) ? SF_ERROR_STAR : SF_OK;
}

sf_status CheckMemory(const void* memory) {
  if (memory == nullptr) return SF_ERROR_NULL;
  return reinterpret_cast<uintptr_t>(memory) % SF_ALIGNMENT == 0 ? SF_OK
                                                                 : SF_ERROR_WORKSPACE_ALIGNMENT;
}

sf_status CheckMap(const float* disparity, size_t stride, int32_t width, int32_t height) {
  if (disparity == nullptr) return SF_ERROR_NULL;
  if (!ValidSize(width) || !ValidSize(height)) return SF_ERROR_SIZE;
  if (!ValidStride(stride, static_cast<size_t>(width) * sizeof(float), height) ||
      stride % sizeof(float) != 0 || reinterpret_cast<uintptr_t>(disparity) % alignof(float) != 0) {
    return SF_ERROR_STRIDE;
  }
  return SF_OK;
}

bool ValidStride(size_t stride, size_t row_bytes, int32_t rows) {
  return stride >= row_bytes &&
         (rows <= 1 || stride <= (PTRDIFF_MAX - row_bytes) / static_cast<size_t>(rows - 1));
}

bool ValidCoverage(const sf_config& config, const uint8_t* coverage, size_t stride) {
  return coverage == nullptr ||
         ValidStride(stride, static_cast<size_t>(config.width), config.height);
}

sf_status CheckViews(int32_t views, int32_t width, int32_t height,
                     const sf_light_field& light_field) {
  for (int view = 0; view < views; ++view) {
    if (light_field.views[view].data == nullptr) return SF_ERROR_NULL;
    if (!ValidStride(light_field.views[view].stride, 3 * static_cast<size_t>(width), height)) {
      return SF_ERROR_STRIDE;
    }
  }
  return SF_OK;
}

sf_status CheckLightField(const sf_config& config, const sf_light_field& light_field) {
  const sf_status status = CheckViews(config.views, config.width, config.height, light_field);
  if (status != SF_OK) return status;
  if (!ValidCoverage(config, light_field.coverage, light_field.coverage_stride)) {
    return SF_ERROR_STRIDE;
  }
  return CheckMap(light_field.disparity, light_field.disparity_stride, config.width, config.height);
}

sf_status CheckRegion(const sf_config& config, const sf_region& region) {
  if (IsWhole(region)) return SF_OK;
  const bool inside = region.x >= 0 && region.y >= 0 && region.width >= 1 && region.height >= 1 &&
                      region.width <= config.width - int64_t{region.x} &&
                      region.height <= config.height - int64_t{region.y};
  return inside ? SF_OK : SF_ERROR_REGION;
}

sf_status CheckOutput(int32_t width, int32_t rows, const uint8_t* out, size_t stride) {
  if (out == nullptr) return SF_ERROR_NULL;
  return ValidStride(stride, 3 * static_cast<size_t>(width), rows) ? SF_OK : SF_ERROR_STRIDE;
}

}  // namespace starfocus
