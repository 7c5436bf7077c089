// SPDX-License-Identifier: Apache-2.0
// SIMD kernels that convert disparities to fixed point, and that find ranges of disparities.
#ifndef STARFOCUS_SIMD_DISPARITIES_H_
#define STARFOCUS_SIMD_DISPARITIES_H_

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "simd/samples.h"

namespace starfocus::simd {

// Disparity of a missing surface.
inline constexpr int16_t kNoSurface = INT16_MIN;

// Lowest and highest disparity of a set. The set is empty if low > high.
struct DisparityRange {
  int16_t low, high;
};

namespace reference {

// Converts disparities in pixels to 6 fractional bits: out[n] = disparity[n] * 64, rounded half up.
// Returns true if all disparities lie in [low, high]. If any disparity is NaN or outside this
// range, the function returns false and `out` is unspecified. The limits `low` and `high` must lie
// in [-511, 511]. Nothing past out[count - 1] is written.
STARFOCUS_REFERENCE bool ConvertDisparity(const float* disparity, size_t count, float low,
                                          float high, int16_t* out) {
  for (size_t n = 0; n < count; ++n) {
    const bool inside = disparity[n] >= low && disparity[n] <= high;  // false for NaN
    if (!inside) return false;
    out[n] = static_cast<int16_t>(std::floor(disparity[n] * 64.0f + 0.5f));
  }
  return true;
}

// Sets ranges[c] to the range of the disparities of group c, over all rows. Group c consists of the
// kSliceLanes columns from column c kSliceLanes on, without columns at or beyond `count`. Pixels
// that are kNoSurface are ignored. Rows are `stride` samples apart, and are read in whole groups of
// kSliceLanes.
STARFOCUS_REFERENCE void FindRanges(const int16_t* disparity, size_t stride, size_t rows,
                                    size_t count, DisparityRange* ranges) {
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

// Sets bit k of within[row], for k < kSliceLanes, if disparity[row * stride + k] lies in `range`.
// Clears all other bits.
STARFOCUS_REFERENCE void FindWithin(const int16_t* disparity, size_t stride, size_t rows,
                                    const DisparityRange& range, uint16_t* within) {
  for (size_t row = 0; row < rows; ++row, disparity += stride) {
    int bits = 0;
    for (size_t k = 0; k < kSliceLanes; ++k) {
      if (disparity[k] >= range.low && disparity[k] <= range.high) bits |= 1 << k;
    }
    within[row] = static_cast<uint16_t>(bits);
  }
}

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_DISPARITIES_H_
