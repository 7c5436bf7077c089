// SPDX-License-Identifier: Apache-2.0
// The kernel that prepares a picture for discs whose taps lie two pixels apart.
#ifndef STARFOCUS_SIMD_PREFILTER_H_
#define STARFOCUS_SIMD_PREFILTER_H_

#include <cstddef>
#include <cstdint>

namespace starfocus::simd {

// Pixels that a prefiltered one is made of on each side.
inline constexpr int32_t kPrefilterReach = 2;
// A prefiltered sample is half the light, which the filter's negative taps and their opposite may
// leave by up to 9/32 on either side, and this offset: it lies in [0, 25599].
inline constexpr int kPrefilterBits = 1;  // fewer than light has
inline constexpr int32_t kPrefilterOffset = 4608;

namespace reference {

// Filters light along columns and then along rows with the taps -1, 4, 10, 4, -1 of sixteenths:
// they let none of the highest frequency through, which every second pixel would show as the
// lowest, and their variance is zero, so that nothing gets wider. `samples` are `rows` rows of
// `count` samples each, R, G and B interleaved, 2 kPrefilterReach rows and pixels at least. The
// results take their place, moved to the left and up by kPrefilterReach: row y gets the filtered
// samples of row y + kPrefilterReach, y < rows - 2 kPrefilterReach, and sample n those of pixel n /
// 3 + kPrefilterReach, n < count - 6 kPrefilterReach. The others keep what they hold.
//
// Of samples a, b, c, d, e in a line the sum is Mean(c, Mean(b, d)) + (c - Mean(a, e)) / 8, means
// rounded halves up and the rest rounded down. What is filtered along columns is halved, rounded
// halves up, before it is filtered along rows.
void Prefilter(int16_t* samples, size_t stride, size_t rows, size_t count);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_PREFILTER_H_
