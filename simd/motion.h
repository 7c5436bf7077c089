// SPDX-License-Identifier: Apache-2.0
// SIMD kernels that follow the pixels of a video from frame to frame.
#ifndef STARFOCUS_SIMD_MOTION_H_
#define STARFOCUS_SIMD_MOTION_H_

#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "simd/samples.h"

namespace starfocus::simd {

inline constexpr size_t kCompared = 16;     // side of the squares that CompareSquares compares
inline constexpr size_t kFollowed = 8;      // side of the blocks of FollowBlock
inline constexpr int32_t kMostStep = 192;   // limit of a difference of disparities, 3 pixels
inline constexpr uint16_t kNoCost = 65535;  // cost of a pixel that no motion explains

// A block of pixels and the block that it is compared with. Pointers refer to the first pixel of
// the block; the colours around the block are read, too.
struct FollowedBlock {
  const uint8_t *now, *before;   // packed R, G, B
  size_t stride;                 // bytes from row to row of both
  const int16_t *given, *known;  // disparities of both
  size_t given_stride, known_stride;
};

namespace reference {

// Returns the sum of absolute differences of two squares of kCompared x kCompared bytes, whose rows
// are `stride` bytes apart.
STARFOCUS_REFERENCE uint32_t CompareSquares(const uint8_t* a, const uint8_t* b, size_t stride) {
  uint32_t sum = 0;
  for (size_t y = 0; y < kCompared; ++y) {
    for (size_t x = 0; x < kCompared; ++x) {
      sum += static_cast<uint32_t>(std::abs(a[y * stride + x] - b[y * stride + x]));
    }
  }
  return sum;
}

// Sets limits[8 y + x] to `base` plus twice the difference of the pixels to the left and right of
// pixel (x, y) plus twice that of the pixels above and below it, summed over R, G and B. `base` is
// at most 32767.
STARFOCUS_REFERENCE void LimitBlock(const uint8_t* rgb, size_t stride, uint16_t base,
                                    uint16_t* limits) {
  for (size_t y = 0; y < kFollowed; ++y) {
    for (size_t x = 0; x < kFollowed; ++x) {
      const uint8_t* const at = rgb + y * stride + 3 * x;
      int32_t sum = 0;
      for (ptrdiff_t c = 0; c < 3; ++c) {
        const auto row = static_cast<ptrdiff_t>(stride);
        sum += std::abs(at[c - 3] - at[c + 3]) + std::abs(at[c - row] - at[c + row]);
      }
      limits[kFollowed * y + x] = static_cast<uint16_t>(base + 2 * sum);
    }
  }
}

// Compares a block with the block to which one motion leads. The colour difference of a pixel is
// summed over R, G and B of the pixel and its eight neighbours. Its cost is the colour difference
// plus the difference of disparities, which is limited to kMostStep. If the colour difference of
// pixel (x, y) is at most limits[8 y + x] and its cost is less than costs[8 y + x], sets this
// element of `costs` to the cost, and that of `choices` to `choice`.
STARFOCUS_REFERENCE void FollowBlock(const FollowedBlock& block, const uint16_t* limits,
                                     uint16_t choice, uint16_t* costs, uint16_t* choices) {
  for (size_t y = 0; y < kFollowed; ++y) {
    for (size_t x = 0; x < kFollowed; ++x) {
      const uint8_t* const now = block.now + y * block.stride + 3 * x;
      const uint8_t* const before = block.before + y * block.stride + 3 * x;
      int32_t colour = 0;
      for (ptrdiff_t row = -1; row <= 1; ++row) {
        for (ptrdiff_t k = -3; k < 6; ++k) {
          const ptrdiff_t at = row * static_cast<ptrdiff_t>(block.stride) + k;
          colour += std::abs(now[at] - before[at]);
        }
      }
      const int32_t step = std::abs(Saturated(block.given[y * block.given_stride + x] -
                                              block.known[y * block.known_stride + x]));
      const int32_t cost = colour + (step < kMostStep ? step : kMostStep);
      const size_t n = kFollowed * y + x;
      if (colour > limits[n] || cost >= costs[n]) continue;
      costs[n] = static_cast<uint16_t>(cost);
      choices[n] = choice;
    }
  }
}

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_MOTION_H_
