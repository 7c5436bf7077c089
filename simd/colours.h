// SPDX-License-Identifier: Apache-2.0
// SIMD kernel that compares the colours of pixels with those of the pixels around them, and finds
// the best match of each group of pixels.
#ifndef STARFOCUS_SIMD_COLOURS_H_
#define STARFOCUS_SIMD_COLOURS_H_

#include <cstddef>
#include <cstdint>

#include "simd/padding.h"

namespace starfocus::simd {

// Each pixel of a block of 4x4 is compared with the pixels up to kColourReach columns and rows
// away.
inline constexpr int32_t kColourBlock = 4, kColourReach = 8;
inline constexpr int32_t kColourWindow = kColourBlock + 2 * kColourReach;
static_assert(kColourBlock * kColourBlock == kSliceLanes, "a block is a group");

// Larger colour differences count as this one.
inline constexpr int16_t kMostColourDifference = 100;
// A key is a cost, and in these low bits a number that decides between pixels of equal cost. Keys
// of samples leave room for the largest difference in 16 bits.
inline constexpr int kColourKeyBits = 6;
inline constexpr uint16_t kNoColourKey = UINT16_MAX;

struct ColourSample {
  int16_t sum;                    // red + green + blue, [0, 765]
  int16_t red_green, green_blue;  // red - green, green - blue, [-255, 255]
  uint16_t key;                   // cost without the colour difference; kNoColourKey: skipped
  uint16_t place;                 // index of the results for its group
};

// Returns the difference of two colours from the differences of the members of ColourSample. Hue
// and saturation count four times as much as brightness, which shading changes as well.
inline int32_t ColourDifference(int32_t sum, int32_t red_green, int32_t green_blue) {
  const auto size = [](int32_t value) { return value < 0 ? -value : value; };
  return size(sum) / 4 + size(red_green) + size(green_blue) + size(red_green + green_blue);
}

namespace reference {

// Compares the block in the middle of a window with the samples of the window. Pixel n of the block
// is in column n % kColourBlock and row n / kColourBlock. For each sample within reach of pixel n,
// least[place + n] becomes at most the sample's key plus the colour difference in units of cost.
// `stride` is the number of samples from a row of the window to the next.
void CompareColours(const ColourSample* window, size_t stride, uint16_t* least);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_COLOURS_H_
