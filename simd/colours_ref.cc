// SPDX-License-Identifier: Apache-2.0
#include "simd/colours.h"

namespace starfocus::simd::reference {

void CompareColours(const ColourSample* window, size_t stride, uint16_t* least) {
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

}  // namespace starfocus::simd::reference
