// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "simd/disparities.h"

namespace starfocus::simd::reference {

bool ConvertDisparity(const float* disparity, size_t count, float low, float high, int16_t* out) {
  for (size_t n = 0; n < count; ++n) {
    const bool inside = disparity[n] >= low && disparity[n] <= high;  // false for NaN
    if (!inside) return false;
    out[n] = static_cast<int16_t>(std::floor(disparity[n] * 64.0f + 0.5f));
  }
  return true;
}

void FindRanges(const int16_t* disparity, size_t stride, size_t rows, size_t count,
                DisparityRange* ranges) {
  for (size_t strip = 0; strip < count; strip += kSliceLanes) {
    DisparityRange range = {INT16_MAX, INT16_MIN};
    for (size_t row = 0; row < rows; ++row) {
      for (size_t n = strip; n < count && n < strip + kSliceLanes; ++n) {
        const int16_t value = disparity[row * stride + n];
        if (value == kNoSurface) continue;
        range.low = value < range.low ? value : range.low;
        range.high = value > range.high ? value : range.high;
      }
    }
    ranges[strip / kSliceLanes] = range;
  }
}

void FindWithin(const int16_t* disparity, size_t stride, size_t rows, const DisparityRange& range,
                uint16_t* within) {
  for (size_t row = 0; row < rows; ++row, disparity += stride) {
    int bits = 0;
    for (size_t k = 0; k < kSliceLanes; ++k) {
      if (disparity[k] >= range.low && disparity[k] <= range.high) bits |= 1 << k;
    }
    within[row] = static_cast<uint16_t>(bits);
  }
}

}  // namespace starfocus::simd::reference
