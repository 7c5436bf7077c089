// SPDX-License-Identifier: Apache-2.0
// SIMD kernels that convert disparities to fixed point, and that find ranges of disparities.
#ifndef STARFOCUS_SIMD_DISPARITIES_H_
#define STARFOCUS_SIMD_DISPARITIES_H_

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
bool ConvertDisparity(const float* disparity, size_t count, float low, float high, int16_t* out);

// Sets ranges[c] to the range of the disparities of group c, over all rows. Group c consists of the
// kSliceLanes columns from column c kSliceLanes on, without columns at or beyond `count`. Pixels
// that are kNoSurface are ignored. Rows are `stride` samples apart, and are read in whole groups of
// kSliceLanes.
void FindRanges(const int16_t* disparity, size_t stride, size_t rows, size_t count,
                DisparityRange* ranges);

// Sets bit k of within[row], for k < kSliceLanes, if disparity[row * stride + k] lies in `range`.
// Clears all other bits.
void FindWithin(const int16_t* disparity, size_t stride, size_t rows, const DisparityRange& range,
                uint16_t* within);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_DISPARITIES_H_
