// SPDX-License-Identifier: Apache-2.0
// The kernel that compares the colours of pixels with those of all others around them, and keeps
// the best of each group.
#ifndef STARFOCUS_SIMD_COLOURS_H_
#define STARFOCUS_SIMD_COLOURS_H_

#include <cstddef>
#include <cstdint>

#include "simd/padding.h"

namespace starfocus::simd {

// A block of pixels, this many each way, is compared with those up to kColourReach away.
inline constexpr int32_t kColourBlock = 4, kColourReach = 8;
inline constexpr int32_t kColourWindow = kColourBlock + 2 * kColourReach;
static_assert(kColourBlock * kColourBlock == kSliceLanes, "a block is a group");

// Colours that differ by more differ by this.
inline constexpr int16_t kMostColourDifference = 100;
// A key is a cost times this and what decides between pixels that cost as much.
inline constexpr int kColourKeyBits = 6;
inline constexpr uint16_t kNoColourKey = UINT16_MAX;

struct ColourSample {
  int16_t sum;                    // of red, green and blue, [0, 765]
  int16_t red_green, green_blue;  // red less green, green less blue, [-255, 255]
  uint16_t key;                   // what it costs without its colour; kNoColourKey: isn't compared
  uint16_t place;                 // of its group's keys
};

// Returns the difference of two colours, of which all that is given differs by so much: hue and
// saturation count four times as much as brightness does, which shading changes as well.
inline int32_t ColourDifference(int32_t sum, int32_t red_green, int32_t green_blue) {
  const auto size = [](int32_t value) { return value < 0 ? -value : value; };
  return size(sum) / 4 + size(red_green) + size(green_blue) + size(red_green + green_blue);
}

namespace reference {

// Compares the block in the middle of a window with all samples around: pixel n of the block is in
// its column n % kColourBlock and row n / kColourBlock. Lessens least[place + n] to the key of each
// sample within reach of pixel n, and the difference to it. Rows of the window are `stride` samples
// apart.
void CompareColours(const ColourSample* window, size_t stride, uint16_t* least);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_COLOURS_H_
