// SPDX-License-Identifier: Apache-2.0
#include "lib/engine/reduce.h"

#include "lib/base/fixed.h"

namespace starfocus {
namespace {

template <int kShift>
void MeanOfWhole(const uint32_t* sums, int32_t blocks, int16_t* light) {
  constexpr int kSide = 1 << kShift;
  for (int32_t n = 0; n < blocks; ++n, sums += 3 * kSide, light += 3) {
    uint32_t total[3] = {};
    for (int k = 0; k < kSide; ++k) {
      for (int c = 0; c < 3; ++c) total[c] += sums[3 * k + c];
    }
    for (int c = 0; c < 3; ++c) {
      light[c] = static_cast<int16_t>((total[c] + (1U << (2 * kShift - 1))) >> (2 * kShift));
    }
  }
}

// Computes the mean light of a block of pixels that is partly outside the picture.
void MeanOfPart(const uint32_t* sums, int32_t columns, int32_t rows, int16_t* light) {
  const uint32_t count = static_cast<uint32_t>(columns) * static_cast<uint32_t>(rows);
  for (int c = 0; c < 3; ++c) {
    uint32_t total = 0;
    for (int32_t k = 0; k < columns; ++k) total += sums[3 * k + c];
    light[c] = static_cast<int16_t>((2 * total + count) / (2 * count));
  }
}

}  // namespace

Rect ReducedRect(const Rect& rect, int shift) {
  const int32_t x = rect.x >> shift, y = rect.y >> shift;
  return {x, y, ReducedSize(rect.x + rect.width, shift) - x,
          ReducedSize(rect.y + rect.height, shift) - y};
}

void MeanOfBlocks(const uint32_t* sums, int32_t columns, int32_t rows, int shift, int16_t* light) {
  const int32_t side = 1 << shift;
  int32_t whole = 0;
  if (rows == side) {
    whole = columns / side;
    if (shift == 1) MeanOfWhole<1>(sums, whole, light);
    if (shift == 2) MeanOfWhole<2>(sums, whole, light);
    if (shift == 3) MeanOfWhole<3>(sums, whole, light);
  }
  for (int32_t n = whole; n < ReducedSize(columns, shift); ++n) {
    MeanOfPart(sums + 3 * n * side, Min(side, columns - n * side), rows, light + 3 * n);
  }
}

int16_t MedianOf(const int16_t* values, int32_t count) {
  int16_t low = values[0], high = values[0];
  for (int32_t n = 1; n < count; ++n) {
    low = values[n] < low ? values[n] : low;
    high = values[n] > high ? values[n] : high;
  }
  // Bisection: the median is the smallest number that is at least as large as more than half of the
  // values. The median always stays in [low, high].
  while (low < high) {
    const auto middle = static_cast<int16_t>((low + high) >> 1);
    int32_t not_above = 0;
    for (int32_t n = 0; n < count; ++n) not_above += values[n] <= middle ? 1 : 0;
    if (not_above > count / 2) {
      high = middle;
    } else {
      low = static_cast<int16_t>(middle + 1);
    }
  }
  return low;
}

}  // namespace starfocus
