// SPDX-License-Identifier: Apache-2.0
// Ramps of disparity. In a blurred map the pixels between two surfaces belong to neither.
#ifndef STARFOCUS_LIB_BASE_RAMP_H_
#define STARFOCUS_LIB_BASE_RAMP_H_

#include "lib/base/fixed.h"

namespace starfocus {

// A pixel is on a ramp if its disparity lies between the disparities of two opposite neighbours,
// both steps are at least kLeastRamp, and the larger step is at most kRampRatio times the smaller
// one.
inline constexpr int32_t kLeastRamp = 1 << (kDisparityBits - 1);
inline constexpr int32_t kRampRatio = 4;

// Returns true if `here` is on a ramp; disparities of three pixels in a line, kDisparityBits.
inline bool IsRamp(int32_t before, int32_t here, int32_t after) {
  const int32_t sign = after < before ? -1 : 1;
  const int32_t a = sign * (here - before), b = sign * (after - here);
  return Min(a, b) >= kLeastRamp && Max(a, b) <= kRampRatio * Min(a, b);
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_BASE_RAMP_H_
