// SPDX-License-Identifier: Apache-2.0
// Vector code of light.h. Included once per target.
#if defined(STARFOCUS_SIMD_LIGHT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STARFOCUS_SIMD_LIGHT_INL_H_
#undef STARFOCUS_SIMD_LIGHT_INL_H_
#else
#define STARFOCUS_SIMD_LIGHT_INL_H_
#endif

#include "simd/compat-inl.h"
#include "simd/light.h"

HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

// Tables are read sample by sample: gathering loads are no faster on most machines.
inline void Decode(const uint8_t* HWY_RESTRICT codes, size_t count, const Encoding& encoding,
                   int16_t* HWY_RESTRICT light) {
  if (encoding.light != nullptr) {
    const int16_t* HWY_RESTRICT table = encoding.light;
    size_t n = 0;
    for (; n + 8 <= count; n += 8) {
      for (size_t k = n; k < n + 8; ++k) light[k] = table[codes[k]];
    }
    for (; n < count; ++n) light[n] = table[codes[n]];
    return;
  }
  const hn::ScalableTag<int16_t> d16;
  const hn::Rebind<uint8_t, decltype(d16)> d8;
  const size_t lanes = hn::Lanes(d16);
  size_t n = 0;
  for (; n + lanes <= count; n += lanes) {
    hn::StoreU(hn::ShiftLeft<kLightBits>(hn::PromoteTo(d16, hn::LoadU(d8, codes + n))), d16,
               light + n);
  }
  for (; n < count; ++n) light[n] = static_cast<int16_t>(codes[n] << kLightBits);
}

HWY_INLINE uint8_t CodeOf(int32_t light, const uint16_t* entries) {
  const auto at = static_cast<uint32_t>(light);
  return static_cast<uint8_t>((entries[at / kEncodeStep] + at % kEncodeStep) >> kEncodeBits);
}

inline void Encode(const int16_t* HWY_RESTRICT light, size_t count, const Encoding& encoding,
                   uint8_t* HWY_RESTRICT codes) {
  if (encoding.entries != nullptr) {
    const uint16_t* HWY_RESTRICT entries = encoding.entries;
    for (size_t n = 0; n < count; ++n) codes[n] = CodeOf(light[n], entries);
    return;
  }
  const hn::ScalableTag<int16_t> d16;
  const hn::RebindToUnsigned<decltype(d16)> du16;
  const hn::Rebind<uint8_t, decltype(d16)> d8;
  constexpr uint16_t kHalf = 1 << (kLightBits - 1);
  const auto half = hn::Set(du16, kHalf);
  const size_t lanes = hn::Lanes(d16);
  size_t n = 0;
  for (; n + lanes <= count; n += lanes) {
    const auto sum = hn::Add(hn::BitCast(du16, hn::LoadU(d16, light + n)), half);
    hn::StoreU(hn::DemoteTo(d8, hn::BitCast(d16, hn::ShiftRight<kLightBits>(sum))), d8, codes + n);
  }
  for (; n < count; ++n) codes[n] = static_cast<uint8_t>((light[n] + kHalf) >> kLightBits);
}

inline void Finish(const uint32_t* HWY_RESTRICT accumulators, size_t count, int shift,
                   const Encoding& encoding, uint8_t* HWY_RESTRICT out) {
  if (encoding.entries != nullptr) {
    const uint16_t* HWY_RESTRICT entries = encoding.entries;
    const int bits = shift - kLightBits;
    const uint32_t half = uint32_t{1} << (bits - 1);
    for (size_t n = 0; n < count; ++n) {
      out[n] = CodeOf(static_cast<int32_t>((accumulators[n] + half) >> bits), entries);
    }
    return;
  }
  const hn::ScalableTag<uint32_t> d32;
  const hn::Rebind<uint8_t, decltype(d32)> d8;
  const hn::RebindToSigned<decltype(d32)> di32;
  const size_t lanes = hn::Lanes(d32);
  const uint32_t half = uint32_t{1} << (shift - 1);
  const auto vhalf = hn::Set(d32, half);
  size_t n = 0;
  for (; n + lanes <= count; n += lanes) {
    const auto sum = hn::Add(hn::LoadU(d32, accumulators + n), vhalf);
    const auto value = hn::ShiftRightSame(sum, shift);
    hn::StoreU(hn::DemoteTo(d8, hn::BitCast(di32, value)), d8, out + n);
  }
  for (; n < count; ++n) out[n] = static_cast<uint8_t>((accumulators[n] + half) >> shift);
}

}  // namespace HWY_NAMESPACE
}  // namespace starfocus::simd
HWY_AFTER_NAMESPACE();

#endif
