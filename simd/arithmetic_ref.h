// SPDX-License-Identifier: Apache-2.0
// Fixed-point arithmetic that the references of several kernel families share.
#ifndef STARFOCUS_SIMD_ARITHMETIC_REF_H_
#define STARFOCUS_SIMD_ARITHMETIC_REF_H_

#include <cstdint>

namespace starfocus::simd::reference {

inline int16_t Saturated(int32_t value) {
  return static_cast<int16_t>(value < INT16_MIN   ? INT16_MIN
                              : value > INT16_MAX ? INT16_MAX
                                                  : value);
}

// Returns the mean of two numbers, rounded half up.
inline int32_t Mean(int32_t a, int32_t b) { return (a + b + 1) >> 1; }

// Returns the product of two numbers with 15 fractional bits, rounded half up.
inline int16_t Product15(int32_t a, int32_t b) {
  return static_cast<int16_t>((a * b + (1 << 14)) >> 15);
}

}  // namespace starfocus::simd::reference

#endif  // STARFOCUS_SIMD_ARITHMETIC_REF_H_
