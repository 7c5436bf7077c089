// SPDX-License-Identifier: Apache-2.0
// Vector code of the functions in light.h. This file is included once per SIMD target.
#if defined(STARFOCUS_SIMD_LIGHT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STARFOCUS_SIMD_LIGHT_INL_H_
#undef STARFOCUS_SIMD_LIGHT_INL_H_
#else
#define STARFOCUS_SIMD_LIGHT_INL_H_
#endif

#include "simd/highway-inl.h"
#include "simd/light.h"
#include "simd/samples.h"

HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

// Stores out[n] = table[index[n]] for n < count. Entries are loaded individually, because gather
// instructions are not faster on most machines.
template <class T, class Index>
HWY_INLINE void LookUp(const T* HWY_RESTRICT table, const Index* HWY_RESTRICT index, size_t count,
                       T* HWY_RESTRICT out) {
  const bool done = ForVectors(count, 8, [&](size_t n) HWY_ATTR {
    for (size_t k = n; k < n + 8; ++k) out[k] = table[index[k]];
  });
  for (size_t n = 0; !done && n < count; ++n) out[n] = table[index[n]];
}

#if HWY_TARGET <= HWY_AVX3  // and its successors
// LookUp for a table of 256 entries, which fit into 8 registers. Highway 1.0.3 has no lookup in two
// registers.
HWY_INLINE void LookUpCodes(const int16_t* HWY_RESTRICT table, const uint8_t* HWY_RESTRICT codes,
                            size_t count, int16_t* HWY_RESTRICT out) {
  const hn::ScalableTag<int16_t> d16;
  using Vec = hn::Vec<decltype(d16)>;
  const auto quarter = [&](int n, Vec code) HWY_ATTR {
    const Vec low = hn::LoadU(d16, table + 64 * n), high = hn::LoadU(d16, table + 64 * n + 32);
    return Vec{_mm512_permutex2var_epi16(low.raw, code.raw, high.raw)};
  };
  const bool done = ForVectors(count, hn::Lanes(d16), [&](size_t n) HWY_ATTR {
    const Vec code = LoadBytes(d16, codes + n);
    const auto is_odd = hn::TestBit(code, hn::Set(d16, 64));
    const Vec dark = hn::IfThenElse(is_odd, quarter(1, code), quarter(0, code));
    const Vec bright = hn::IfThenElse(is_odd, quarter(3, code), quarter(2, code));
    const auto is_bright = hn::TestBit(code, hn::Set(d16, 128));
    hn::StoreU(hn::IfThenElse(is_bright, bright, dark), d16, out + n);
  });
  if (!done) LookUp(table, codes, count, out);
}
#else
HWY_INLINE void LookUpCodes(const int16_t* HWY_RESTRICT table, const uint8_t* HWY_RESTRICT codes,
                            size_t count, int16_t* HWY_RESTRICT out) {
  LookUp(table, codes, count, out);
}
#endif

inline void Decode(const uint8_t* HWY_RESTRICT codes, size_t count, const Encoding& encoding,
                   int16_t* HWY_RESTRICT light) {
  if (encoding.entries != nullptr) return LookUpCodes(encoding.light, codes, count, light);
  const hn::ScalableTag<int16_t> d16;
  const bool done = ForVectors(count, hn::Lanes(d16), [&](size_t n) HWY_ATTR {
    hn::StoreU(hn::ShiftLeft<kLightBits>(LoadBytes(d16, codes + n)), d16, light + n);
  });
  if (!done) reference::Decode(codes, count, encoding, light);
}

// Up to kEncodeChunk samples are encoded together. A vector of kPadding bytes may store up to
// kEncodeSpare samples after the last sample of a chunk.
inline constexpr size_t kEncodeChunk = 64, kEncodeSpare = kPadding / sizeof(int16_t);

// Encodes at most kEncodeChunk samples. Entries of the table are looked up one sample at a time,
// long before a vector loads the entries. A processor cannot forward several small stores to the
// load of a whole vector.
inline void EncodeChunk(const int16_t* HWY_RESTRICT light, size_t count, const Encoding& encoding,
                        uint8_t* HWY_RESTRICT codes) {
  // Vectors have at most 8 lanes, because a cell of layer 1 is only 12 samples wide.
  const hn::CappedTag<int16_t, 8> d16;
  const hn::RebindToUnsigned<decltype(d16)> du16;
  const size_t lanes = hn::Lanes(d16);
  if (count < lanes) return reference::Encode(light, count, encoding, codes);
  constexpr int kStepBits = 3;
  static_assert(1 << kStepBits == kEncodeStep, "kEncodeStep must be 2^kStepBits");
  uint16_t steps[kEncodeChunk], entries[kEncodeChunk];
  ForVectors(count, lanes, [&](size_t n) HWY_ATTR {
    const auto value = hn::BitCast(du16, hn::LoadU(d16, light + n));
    hn::StoreU(hn::ShiftRight<kStepBits>(value), du16, steps + n);
  });
  LookUp(encoding.entries, steps, count, entries);
  const auto rest = hn::Set(du16, uint16_t{kEncodeStep - 1});
  ForVectors(count, lanes, [&](size_t n) HWY_ATTR {
    const auto value = hn::BitCast(du16, hn::LoadU(d16, light + n));
    const auto sum = hn::Add(hn::LoadU(du16, entries + n), hn::And(value, rest));
    const auto code = hn::BitCast(d16, hn::ShiftRight<kEncodeBits>(sum));
    StoreBytes(d16, code, codes + n);
  });
}

// Encodes light that the caller's function `load` provides: load(n, light) stores a vector of
// `lanes` samples from sample n on. The last vector of a chunk may read and store up to kPadding
// bytes beyond the samples.
template <class Load>
HWY_INLINE void EncodeChunks(size_t count, size_t lanes, const Encoding& encoding,
                             uint8_t* HWY_RESTRICT codes, const Load& load) {
  int16_t light[kEncodeChunk + kEncodeSpare];
  for (size_t begin = 0; begin < count; begin += kEncodeChunk) {
    const size_t chunk = count - begin < kEncodeChunk ? count - begin : kEncodeChunk;
    for (size_t n = 0; n < chunk; n += lanes) load(begin + n, light + n);
    EncodeChunk(light, chunk, encoding, codes + begin);
  }
}

inline void Encode(const int16_t* HWY_RESTRICT light, size_t count, const Encoding& encoding,
                   uint8_t* HWY_RESTRICT codes) {
  if (encoding.entries != nullptr) {
    for (; count > kEncodeChunk; count -= kEncodeChunk) {
      EncodeChunk(light, kEncodeChunk, encoding, codes);
      light += kEncodeChunk;
      codes += kEncodeChunk;
    }
    EncodeChunk(light, count, encoding, codes);
    return;
  }
  const hn::ScalableTag<int16_t> d16;
  const hn::RebindToUnsigned<decltype(d16)> du16;
  const auto half = hn::Set(du16, uint16_t{1 << (kLightBits - 1)});
  const bool done = ForVectors(count, hn::Lanes(d16), [&](size_t n) HWY_ATTR {
    const auto sum = hn::Add(hn::BitCast(du16, hn::LoadU(d16, light + n)), half);
    StoreBytes(d16, hn::BitCast(d16, hn::ShiftRight<kLightBits>(sum)), codes + n);
  });
  if (!done) reference::Encode(light, count, encoding, codes);
}

inline void Finish(const uint32_t* HWY_RESTRICT accumulators, size_t count, int shift,
                   const Encoding& encoding, uint8_t* HWY_RESTRICT out) {
  const hn::CappedTag<uint32_t, kPadding / sizeof(uint32_t)> d32;
  const hn::RebindToSigned<decltype(d32)> di32;
  const int bits = encoding.entries == nullptr ? shift : shift - kLightBits;
  const auto half = hn::Set(d32, uint32_t{1} << (bits - 1));
  const auto rounded = [&](size_t n) HWY_ATTR {
    const auto sum = hn::Add(hn::LoadU(d32, accumulators + n), half);
    return hn::BitCast(di32, hn::ShiftRightSame(sum, bits));
  };
  if (encoding.entries != nullptr) {
    const hn::Rebind<int16_t, decltype(d32)> d16;
    EncodeChunks(count, hn::Lanes(d32), encoding, out, [&](size_t n, int16_t* light) HWY_ATTR {
      hn::StoreU(hn::DemoteTo(d16, rounded(n)), d16, light);
    });
    return;
  }
  const bool done = ForVectors(count, hn::Lanes(d32),
                               [&](size_t n) HWY_ATTR { StoreBytes(di32, rounded(n), out + n); });
  if (!done) reference::Finish(accumulators, count, shift, encoding, out);
}

}  // namespace HWY_NAMESPACE
}  // namespace starfocus::simd
HWY_AFTER_NAMESPACE();

#endif
