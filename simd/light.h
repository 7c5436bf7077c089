// SPDX-License-Identifier: Apache-2.0
// SIMD kernels that convert between the codes of pictures, which are bytes, and light. Light is
// additive: mixtures are computed in light.
#ifndef STARFOCUS_SIMD_LIGHT_H_
#define STARFOCUS_SIMD_LIGHT_H_

#include <cstddef>
#include <cstdint>

#include "simd/samples.h"

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

// Conversion between codes and light by tables. If light is the code itself, `entries` is null, and
// kernels use no tables: light is code << kLightBits, and the code is the light rounded half up.
struct Encoding {
  const int16_t* light;              // Light of each of the 256 codes.
  const uint16_t* entries;           // kEncodeEntries entries.
  const int16_t* samples = nullptr;  // Light of each code in the format of layers (resample.h),
                                     // rounded half up.
};

namespace reference {

inline uint8_t CodeOf(int32_t light, const Encoding& encoding) {
  if (encoding.entries == nullptr) {
    return static_cast<uint8_t>((light + (1 << (kLightBits - 1))) >> kLightBits);
  }
  const int32_t entry = encoding.entries[light / kEncodeStep];
  return static_cast<uint8_t>((entry + light % kEncodeStep) >> kEncodeBits);
}

// Sets light[n] to the light of codes[n], n < count.
STARFOCUS_REFERENCE void Decode(const uint8_t* codes, size_t count, const Encoding& encoding,
                                int16_t* light) {
  for (size_t n = 0; n < count; ++n) {
    light[n] = encoding.entries == nullptr ? static_cast<int16_t>(codes[n] << kLightBits)
                                           : encoding.light[codes[n]];
  }
}

// Sets codes[n] to the code of light[n] for n < count. Each light[n] must be in [0, kLightWhite].
// No other elements of `codes` are written.
STARFOCUS_REFERENCE void Encode(const int16_t* light, size_t count, const Encoding& encoding,
                                uint8_t* codes) {
  for (size_t n = 0; n < count; ++n) codes[n] = CodeOf(light[n], encoding);
}

// Encodes accumulators with `shift` fractional bits, in [8, 24]. If light is the code itself,
// out[n] is (accumulators[n] + 2^(shift - 1)) >> shift. If light is not the code itself, the
// accumulators are rounded half up to light, and the light is encoded. Nothing past out[count - 1]
// is written.
STARFOCUS_REFERENCE void Finish(const uint32_t* accumulators, size_t count, int shift,
                                const Encoding& encoding, uint8_t* out) {
  const int bits = encoding.entries == nullptr ? shift : shift - kLightBits;
  const uint32_t half = uint32_t{1} << (bits - 1);
  for (size_t n = 0; n < count; ++n) {
    const uint32_t value = (accumulators[n] + half) >> bits;
    out[n] = encoding.entries == nullptr ? static_cast<uint8_t>(value)
                                         : CodeOf(static_cast<int32_t>(value), encoding);
  }
}

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_LIGHT_H_
