// SPDX-License-Identifier: Apache-2.0
// SIMD kernels for disparities: conversion to fixed point, and their ranges.
#ifndef STARFOCUS_SIMD_DISPARITIES_H_
#define STARFOCUS_SIMD_DISPARITIES_H_

#include <cstddef>
#include <cstdint>

#include "simd/padding.h"

namespace starfocus::simd {

// Disparity of a missing surface.
inline constexpr int16_t kNoSurface = INT16_MIN;

// Lowest and highest of a set of disparities. The set is empty if low > high.
struct DisparityRange {
  int16_t low, high;
};

namespace reference {

// Converts disparities in pixels to 6 fractional bits: out[n] = disparity[n] * 64, rounded halves
// up. Returns true if all of them lie in [low, high]. Otherwise (also for NaN) `out` is
// unspecified. |low| and |high| are at most 511. Nothing past out[count - 1] is written.
bool ConvertDisparity(const float* disparity, size_t count, float low, float high, int16_t* out);

// Sets ranges[c] to the range of columns c kSliceLanes .. (c + 1) kSliceLanes - 1 (if < count) of
// all rows, ignoring pixels that are kNoSurface. Rows are `stride` samples apart, and are read in
// whole groups of kSliceLanes.
void FindRanges(const int16_t* disparity, size_t stride, size_t rows, size_t count,
                DisparityRange* ranges);

// Sets bit k of within[row] if disparity[row * stride + k] lies in the range, for k < kSliceLanes.
void FindWithin(const int16_t* disparity, size_t stride, size_t rows, const DisparityRange& range,
                uint16_t* within);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_DISPARITIES_H_
