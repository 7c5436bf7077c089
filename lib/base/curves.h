// SPDX-License-Identifier: Apache-2.0
// Light of 16-bit codes: the curves of sRGB, PQ and HLG, and linear light.
#ifndef STARFOCUS_LIB_BASE_CURVES_H_
#define STARFOCUS_LIB_BASE_CURVES_H_

#include <cstdint>

namespace starfocus {

// Fractional bits of LightOfCode, beyond the bits of light (simd/light.h).
inline constexpr int kCurveBits = 8;

// Returns the light of a code in [0, 65535]; white is kLightWhite << kCurveBits, and the light of
// code 65535 is at most 50 times white. The light increases with the code. It differs from the
// curve of `transfer` (starfocus_transfer) by at most a third of a level of light, or 1/30000 of
// the light. White is code 65535 of sRGB and linear light, 203 cd/m2 of PQ (SMPTE ST 2084), and
// code 0.75 of HLG (ITU-R BT.2100), whose light is that of the scene.
uint32_t LightOfCode(int32_t transfer, uint32_t code);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_BASE_CURVES_H_
