// SPDX-License-Identifier: Apache-2.0
// SIMD kernel that compares the colours of pixels with the colours of the surrounding pixels. For
// each group of disparities, the kernel finds the surrounding pixel with the lowest cost.
#ifndef STARFOCUS_SIMD_COLOURS_H_
#define STARFOCUS_SIMD_COLOURS_H_

#include <cstddef>
#include <cstdint>

#include "simd/samples.h"

namespace starfocus::simd {

// Geometry of the comparison. Each pixel of a block of 4x4 pixels is compared with all pixels up to
// kColourReach columns and rows away.
inline constexpr int32_t kColourBlock = 4, kColourReach = 8;
inline constexpr int32_t kColourWindow = kColourBlock + 2 * kColourReach;
static_assert(kColourBlock * kColourBlock == kSliceLanes, "a block is a group");

// Upper limit of a colour difference. Larger differences are clamped.
inline constexpr int16_t kMostColourDifference = 100;
// Number of low bits of a key that decide between pixels of equal cost. The high bits of a key are
// the cost. Keys of samples are small enough that a key plus the largest colour difference fits in
// 16 bits.
inline constexpr int kColourKeyBits = 6;
inline constexpr uint16_t kNoColourKey = UINT16_MAX;

struct ColourSample {
  int16_t sum;                    // Red + green + blue, [0, 765].
  int16_t red_green, green_blue;  // Red - green, green - blue, [-255, 255].
  // Key of the sample before the colour difference is added; samples with kNoColourKey are skipped.
  uint16_t key;
  uint16_t place;  // index in the array `least` of the results for the sample's group
};

// Returns the difference of two colours from the differences of the members of ColourSample. Hue
// and saturation have four times the weight of brightness, because shading changes the brightness
// of a surface.
inline int32_t ColourDifference(int32_t sum, int32_t red_green, int32_t green_blue) {
  const auto size = [](int32_t value) { return value < 0 ? -value : value; };
  return size(sum) / 4 + size(red_green) + size(green_blue) + size(red_green + green_blue);
}

namespace reference {

// Compares the block in the middle of a window with the samples of the window. Pixel n of the block
// is in column n % kColourBlock and row n / kColourBlock. For each sample within reach of pixel n,
// least[place + n] is lowered to the sample's key plus the colour difference (in units of cost), if
// this sum is smaller. `stride` is the distance in samples between rows of the window.
STARFOCUS_REFERENCE void CompareColours(const ColourSample* window, size_t stride,
                                        uint16_t* least) {
  constexpr size_t kBlock = kColourBlock, kReach = kColourReach;
  for (size_t n = 0; n < kSliceLanes; ++n) {
    const size_t left = n % kBlock, top = n / kBlock;
    const ColourSample& own = window[(top + kReach) * stride + left + kReach];
    for (size_t row = top; row <= top + 2 * kReach; ++row) {
      for (size_t column = left; column <= left + 2 * kReach; ++column) {
        const ColourSample& other = window[row * stride + column];
        if (other.key == kNoColourKey) continue;
        int32_t key = ColourDifference(own.sum - other.sum, own.red_green - other.red_green,
                                       own.green_blue - other.green_blue);
        if (key > kMostColourDifference) key = kMostColourDifference;
        key = (key << kColourKeyBits) + other.key;
        uint16_t* of_group = least + other.place + n;
        if (key < *of_group) *of_group = static_cast<uint16_t>(key);
      }
    }
  }
}

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_COLOURS_H_
