// SPDX-License-Identifier: Apache-2.0
#include "simd/light.h"

namespace starfocus::simd::reference {
namespace {

uint8_t CodeOf(int32_t light, const Encoding& encoding) {
  if (encoding.entries == nullptr) {
    return static_cast<uint8_t>((light + (1 << (kLightBits - 1))) >> kLightBits);
  }
  const int32_t entry = encoding.entries[light / kEncodeStep];
  return static_cast<uint8_t>((entry + light % kEncodeStep) >> kEncodeBits);
}

}  // namespace

void Decode(const uint8_t* codes, size_t count, const Encoding& encoding, int16_t* light) {
  for (size_t n = 0; n < count; ++n) {
    light[n] = encoding.light == nullptr ? static_cast<int16_t>(codes[n] << kLightBits)
                                         : encoding.light[codes[n]];
  }
}

void Encode(const int16_t* light, size_t count, const Encoding& encoding, uint8_t* codes) {
  for (size_t n = 0; n < count; ++n) codes[n] = CodeOf(light[n], encoding);
}

void Finish(const uint32_t* accumulators, size_t count, int shift, const Encoding& encoding,
            uint8_t* out) {
  const int bits = encoding.entries == nullptr ? shift : shift - kLightBits;
  const uint32_t half = uint32_t{1} << (bits - 1);
  for (size_t n = 0; n < count; ++n) {
    const uint32_t value = (accumulators[n] + half) >> bits;
    out[n] = encoding.entries == nullptr ? static_cast<uint8_t>(value)
                                         : CodeOf(static_cast<int32_t>(value), encoding);
  }
}

}  // namespace starfocus::simd::reference
