// SPDX-License-Identifier: Apache-2.0
// Pictures and disparity maps at 1 / 2^shift of their size: each pixel stands for a block of
// 2^shift by 2^shift pixels, or of what the picture has of one at its right and bottom edges.
#ifndef STARFOCUS_LIB_FILTER_REDUCE_H_
#define STARFOCUS_LIB_FILTER_REDUCE_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/geometry.h"

namespace starfocus {

inline constexpr int kMaxReduction = 3;  // largest shift

// Width or height of a reduced picture.
constexpr int32_t ReducedSize(int32_t size, int shift) {
  return (size + (1 << shift) - 1) >> shift;
}

// The reduced pixels that have a part of `rect`.
Rect ReducedRect(const Rect& rect, int shift);

// The mean light of blocks, halves rounded up, from the sums of each column over `rows` rows of
// `columns` pixels of R, G, B.
void MeanOfBlocks(const uint32_t* sums, int32_t columns, int32_t rows, int shift, int16_t* light);

// The median of the `count` values, at most 4^kMaxReduction; of an even number the larger one of
// the two in the middle: of two surfaces it is one of both and never a mean, which none is at.
int16_t MedianOf(const int16_t* values, int32_t count);

// A disparity in pixels of the reduced picture, halves rounded up.
constexpr int16_t ReducedDisparity(int16_t disparity, int shift) {
  return static_cast<int16_t>((disparity + (1 << shift >> 1)) >> shift);
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_FILTER_REDUCE_H_
