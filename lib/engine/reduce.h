// SPDX-License-Identifier: Apache-2.0
// Reduces pictures and disparity maps to 1 / 2^shift of their size. Each pixel represents a block
// of 2^shift by 2^shift pixels, or the part of the block inside the picture.
#ifndef STARFOCUS_LIB_ENGINE_REDUCE_H_
#define STARFOCUS_LIB_ENGINE_REDUCE_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/geometry.h"

namespace starfocus {

inline constexpr int kMaxReduction = 3;  // largest shift

// Returns the width or height of a reduced picture.
constexpr int32_t ReducedSize(int32_t size, int shift) {
  return (size + (1 << shift) - 1) >> shift;
}

// Returns the rectangle of reduced pixels that overlap `rect`.
Rect ReducedRect(const Rect& rect, int shift);

// Computes the mean light of blocks of pixels, rounded half up. `sums` contains the sums of `rows`
// rows of light: one RGB sum for each of `columns` columns.
void MeanOfBlocks(const uint32_t* sums, int32_t columns, int32_t rows, int shift, int16_t* light);

// Returns the median of `count` values; `count` is at most 4^kMaxReduction. For an even count, the
// median is the larger of the two middle values. The median of disparities therefore always lies on
// a surface, not between two surfaces.
int16_t MedianOf(const int16_t* values, int32_t count);

// Converts a disparity to pixels of the reduced picture, rounded half up.
constexpr int16_t ReducedDisparity(int16_t disparity, int shift) {
  return static_cast<int16_t>((disparity + (1 << shift >> 1)) >> shift);
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_REDUCE_H_
