// SPDX-License-Identifier: Apache-2.0
// Curves of all starfocus_transfer values in double precision; light is in 255ths of white.
#ifndef STARFOCUS_TESTS_SUPPORT_TRANSFER_CURVE_H_
#define STARFOCUS_TESTS_SUPPORT_TRANSFER_CURVE_H_

#include <cmath>

#include "starfocus/starfocus.h"

namespace test {

inline double LightOf(double code, int transfer) {
  if (transfer == STARFOCUS_TRANSFER_NONE) return code;
  const double value = code / 255;
  return 255 * (value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4));
}

inline double CodeOf(double light, int transfer) {
  if (transfer == STARFOCUS_TRANSFER_NONE) return light;
  const double value = light / 255;
  return 255 * (value <= 0.0031308 ? value * 12.92 : 1.055 * std::pow(value, 1 / 2.4) - 0.055);
}

}  // namespace test

#endif  // STARFOCUS_TESTS_SUPPORT_TRANSFER_CURVE_H_
