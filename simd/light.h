// SPDX-License-Identifier: Apache-2.0
// SIMD kernels that convert between the codes of pictures, which are bytes, and light. Light is
// additive: mixtures are computed in light.
#ifndef STARFOCUS_SIMD_LIGHT_H_
#define STARFOCUS_SIMD_LIGHT_H_

#include <cstddef>
#include <cstdint>

namespace starfocus::simd {

// Scale of light: 1/255 of white, with kLightBits fractional bits. The value of white, kLightWhite,
// leaves a headroom of 0.4 % in signed 16 bits.
inline constexpr int kLightBits = 7;
inline constexpr int16_t kLightWhite = 255 << kLightBits;

// The table of an encoding has one entry per kEncodeStep levels of light. At most one code ends
// within the kEncodeStep levels of an entry. The code of light v is (entry[v / kEncodeStep] + v %
// kEncodeStep) >> kEncodeBits.
inline constexpr int kEncodeStep = 8;
inline constexpr int kEncodeBits = 4;
inline constexpr size_t kEncodeEntries = kLightWhite / kEncodeStep + 1;

// Conversion between codes and light by tables, or without tables if light is the code itself.
struct Encoding {
  const int16_t* light;  // Light of each of the 256 codes; null if light is code << kLightBits.
  const uint16_t*
      entries;  // kEncodeEntries entries; null if the code is the light rounded half up.
  // Light of each code in the format of layers (resample.h), rounded half up; null if `light` is
  // null.
  const int16_t* samples = nullptr;
};

namespace reference {

// Sets light[n] to the light of codes[n], n < count.
void Decode(const uint8_t* codes, size_t count, const Encoding& encoding, int16_t* light);

// Sets codes[n] to the code of light[n] for n < count. Each light[n] must be in [0, kLightWhite].
// No other elements of `codes` are written.
void Encode(const int16_t* light, size_t count, const Encoding& encoding, uint8_t* codes);

// Encodes accumulators with `shift` fractional bits, in [8, 24]. If light is the code itself,
// out[n] is (accumulators[n] + 2^(shift - 1)) >> shift. If light is not the code itself, the
// accumulators are rounded half up to light, and the light is encoded. Nothing past out[count - 1]
// is written.
void Finish(const uint32_t* accumulators, size_t count, int shift, const Encoding& encoding,
            uint8_t* out);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_LIGHT_H_
