// SPDX-License-Identifier: Apache-2.0
// Kernels between the codes of pictures, a byte each, and light, which is what lenses add.
#ifndef STARFOCUS_SIMD_LIGHT_H_
#define STARFOCUS_SIMD_LIGHT_H_

#include <cstddef>
#include <cstdint>

namespace starfocus::simd {

// Light has kLightBits fractional bits of a 255th of white: white is kLightWhite, which leaves 0.4
// % of 16 bits with sign.
inline constexpr int kLightBits = 7;
inline constexpr int16_t kLightWhite = 255 << kLightBits;

// An encoding's table has an entry for each kEncodeStep levels of light, in which at most one code
// ends. Light v has the code (entry[v / kEncodeStep] + v % kEncodeStep) >> kEncodeBits.
inline constexpr int kEncodeStep = 8;
inline constexpr int kEncodeBits = 4;
inline constexpr size_t kEncodeEntries = kLightWhite / kEncodeStep + 1;

// Codes of which light is a table, or none where light is the code itself.
struct Encoding {
  const int16_t* light;     // of each of the 256 codes; null: code << kLightBits
  const uint16_t* entries;  // kEncodeEntries; null: light is rounded halves up
};

namespace reference {

// light[n] is the light of codes[n], n < count.
void Decode(const uint8_t* codes, size_t count, const Encoding& encoding, int16_t* light);

// codes[n] is the code of light[n], which lies in [0, kLightWhite], n < count. Nothing else is
// written.
void Encode(const int16_t* light, size_t count, const Encoding& encoding, uint8_t* codes);

// Makes codes of accumulators, whose `shift` fractional bits lie in [8, 24]. Where light is the
// code itself, out[n] is (accumulators[n] + 2^(shift - 1)) >> shift; else the accumulators are
// rounded likewise to light. Nothing past out[count - 1] is written.
void Finish(const uint32_t* accumulators, size_t count, int shift, const Encoding& encoding,
            uint8_t* out);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_LIGHT_H_
