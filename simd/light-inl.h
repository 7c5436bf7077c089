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

// Runs step(n) for each vector of `count` samples. The last vector ends with the samples, so that
// some are made twice. Returns whether there are enough samples for a vector.
template <class Step>
HWY_INLINE bool ForVectors(size_t count, size_t lanes, const Step& step) {
  if (count < lanes) return false;
  for (size_t n = 0; n < count - lanes; n += lanes) step(n);
  step(count - lanes);
  return true;
}

inline constexpr size_t kEncodeChunk = 64;  // samples encoded together

// Makes codes of at most kEncodeChunk samples. Entries are looked up sample by sample, long before
// they are read by vectors: what is stored by parts cannot be forwarded to a load of the whole.
inline void EncodeChunk(const int16_t* HWY_RESTRICT light, size_t count,
                        const uint16_t* HWY_RESTRICT entries, uint8_t* HWY_RESTRICT codes) {
  const hn::CappedTag<int16_t, 8> d16;  // a cell of a layer is 12 samples wide
  const hn::RebindToUnsigned<decltype(d16)> du16;
  const hn::Rebind<uint8_t, decltype(d16)> d8;
  const size_t lanes = hn::Lanes(d16);
  constexpr int kStepBits = 3;
  static_assert(1 << kStepBits == kEncodeStep, "entries are looked up by shifted light");
  uint16_t found[kEncodeChunk];
  const bool by_vectors = ForVectors(count, lanes, [&](size_t n) HWY_ATTR {
    const auto value = hn::BitCast(du16, hn::LoadU(d16, light + n));
    hn::StoreU(hn::ShiftRight<kStepBits>(value), du16, found + n);
  });
  for (size_t n = 0; !by_vectors && n < count; ++n) {
    found[n] = static_cast<uint16_t>(light[n] / kEncodeStep);
  }
  size_t n = 0;
  for (; n + 8 <= count; n += 8) {
    for (size_t k = n; k < n + 8; ++k) found[k] = entries[found[k]];
  }
  for (; n < count; ++n) found[n] = entries[found[n]];
  const auto rest = hn::Set(du16, uint16_t{kEncodeStep - 1});
  const bool done = ForVectors(count, lanes, [&](size_t at) HWY_ATTR {
    const auto value = hn::BitCast(du16, hn::LoadU(d16, light + at));
    const auto sum = hn::Add(hn::LoadU(du16, found + at), hn::And(value, rest));
    const auto code = hn::BitCast(d16, hn::ShiftRight<kEncodeBits>(sum));
    hn::StoreU(hn::DemoteTo(d8, code), d8, codes + at);
  });
  if (done) return;
  for (n = 0; n < count; ++n) {
    codes[n] = static_cast<uint8_t>((found[n] + light[n] % kEncodeStep) >> kEncodeBits);
  }
}

// Makes codes of the light that load(begin, count, light) stores, chunk by chunk.
template <class Load>
HWY_INLINE void EncodeChunks(size_t count, const uint16_t* HWY_RESTRICT entries,
                             uint8_t* HWY_RESTRICT codes, const Load& load) {
  int16_t light[kEncodeChunk];
  for (size_t begin = 0; begin < count; begin += kEncodeChunk) {
    const size_t chunk = count - begin < kEncodeChunk ? count - begin : kEncodeChunk;
    load(begin, chunk, light);
    EncodeChunk(light, chunk, entries, codes + begin);
  }
}

inline void Encode(const int16_t* HWY_RESTRICT light, size_t count, const Encoding& encoding,
                   uint8_t* HWY_RESTRICT codes) {
  if (encoding.entries != nullptr) {
    for (; count > kEncodeChunk; count -= kEncodeChunk) {
      EncodeChunk(light, kEncodeChunk, encoding.entries, codes);
      light += kEncodeChunk;
      codes += kEncodeChunk;
    }
    EncodeChunk(light, count, encoding.entries, codes);
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
  const hn::ScalableTag<uint32_t> d32;
  const hn::RebindToSigned<decltype(d32)> di32;
  const size_t lanes = hn::Lanes(d32);
  if (encoding.entries != nullptr) {
    const hn::Rebind<int16_t, decltype(d32)> d16;
    const int bits = shift - kLightBits;
    const uint32_t half = uint32_t{1} << (bits - 1);
    const auto vhalf = hn::Set(d32, half);
    EncodeChunks(count, encoding.entries, out,
                 [&](size_t begin, size_t chunk, int16_t* light) HWY_ATTR {
                   const uint32_t* from = accumulators + begin;
                   const bool done = ForVectors(chunk, lanes, [&](size_t n) HWY_ATTR {
                     const auto sum = hn::Add(hn::LoadU(d32, from + n), vhalf);
                     const auto value = hn::BitCast(di32, hn::ShiftRightSame(sum, bits));
                     hn::StoreU(hn::DemoteTo(d16, value), d16, light + n);
                   });
                   for (size_t n = 0; !done && n < chunk; ++n) {
                     light[n] = static_cast<int16_t>((from[n] + half) >> bits);
                   }
                 });
    return;
  }
  const hn::Rebind<uint8_t, decltype(d32)> d8;
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
