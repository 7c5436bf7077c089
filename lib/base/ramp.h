// SPDX-License-Identifier: Apache-2.0
// Ramps: blurred maps run from one surface to another over several pixels, which are of neither.
#ifndef STARFOCUS_LIB_BASE_RAMP_H_
#define STARFOCUS_LIB_BASE_RAMP_H_

#include "lib/base/fixed.h"

namespace starfocus {

// A pixel is on a ramp if its disparity lies between those of two opposite neighbours, and neither
// step is small, or more than kRampRatio times the other.
inline constexpr int32_t kLeastRamp = 1 << (kDisparityBits - 1);
inline constexpr int32_t kRampRatio = 4;

// Returns whether that is so of three disparities in a line, kDisparityBits.
inline bool IsRamp(int32_t before, int32_t here, int32_t after) {
  const int32_t sign = after < before ? -1 : 1;
  const int32_t a = sign * (here - before), b = sign * (after - here);
  return Min(a, b) >= kLeastRamp && Max(a, b) <= kRampRatio * Min(a, b);
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_BASE_RAMP_H_
