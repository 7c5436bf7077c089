// SPDX-License-Identifier: Apache-2.0
// Converts between floats and IEEE half floats, in which pictures store light (DeepImage).
#ifndef STARFOCUS_PLATFORM_HALF_H_
#define STARFOCUS_PLATFORM_HALF_H_

#include <cmath>
#include <cstdint>
#include <cstring>

namespace starfocus {

inline constexpr float kBrightestHalf = 65504;

// Returns the half float nearest to `light`; of two nearest ones, the even one. Light is not
// negative and has a limit: negative numbers and NaN give 0, and numbers above the largest half
// float give the largest.
inline uint16_t HalfOfLight(float light) {
  constexpr float kSmallestNormal = 1.0F / (1 << 14);
  if (!(light > 0)) return 0;
  if (light >= kBrightestHalf) return 0x7bff;
  if (light < kSmallestNormal) return static_cast<uint16_t>(std::lrint(light * (1 << 24)));
  uint32_t bits = 0;
  std::memcpy(&bits, &light, sizeof(bits));
  bits += 0xfff + (bits >> 13 & 1);  // 13 bits are rounded off
  return static_cast<uint16_t>((bits >> 13) - (112u << 10));
}

// Returns the light of a half float. Negative numbers and NaN give 0, and infinity gives the
// largest half float.
inline float LightOfHalf(uint16_t half) {
  constexpr uint16_t kInfinity = 0x7c00;
  if (half > kInfinity) return 0;
  if (half == kInfinity) return kBrightestHalf;
  if (half < 1 << 10) return static_cast<float>(half) / (1 << 24);
  const uint32_t bits = (uint32_t{half} << 13) + (112u << 23);
  float light = 0;
  std::memcpy(&light, &bits, sizeof(light));
  return light;
}

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_HALF_H_
