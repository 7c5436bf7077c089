// SPDX-License-Identifier: Apache-2.0
// Kernels over disparities: conversion to fixed point, and the ranges that they lie in.
#ifndef STARFOCUS_SIMD_DISPARITIES_H_
#define STARFOCUS_SIMD_DISPARITIES_H_

#include <cstddef>
#include <cstdint>

#include "simd/padding.h"

namespace starfocus::simd {

// The disparity of a pixel that has no surface there.
inline constexpr int16_t kNoSurface = INT16_MIN;

// The lowest and the highest of several disparities. There was none where low > high.
struct DisparityRange {
  int16_t low, high;
};

namespace reference {

// Converts disparities in pixels to 6 fractional bits: out[n] = disparity[n] * 64, rounded halves
// up. Returns whether each of them lies in [low, high]; when one does not (NaN included), what is
// in `out` is unspecified. |low| and |high| are 511 at most. Nothing past out[count - 1] is
// written.
bool ConvertDisparity(const float* disparity, size_t count, float low, float high, int16_t* out);

// ranges[c] becomes the range of the columns c kSliceLanes .. (c + 1) kSliceLanes - 1 (as far as
// they are < count) of all rows, without the pixels that are kNoSurface. Rows lie `stride` samples
// apart, and are read in whole groups of kSliceLanes.
void FindRanges(const int16_t* disparity, size_t stride, size_t rows, size_t count,
                DisparityRange* ranges);

// Bit k of within[row] tells whether disparity[row * stride + k] lies in the range, for
// k < kSliceLanes.
void FindWithin(const int16_t* disparity, size_t stride, size_t rows, const DisparityRange& range,
                uint16_t* within);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_DISPARITIES_H_
