// SPDX-License-Identifier: Apache-2.0
// Vector code of the functions in resample.h. This file is included once per SIMD target.
#include "simd/light-inl.h"
#include "simd/resample.h"

HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

inline void Narrow(const int16_t* HWY_RESTRICT in, size_t count, const Encoding& encoding,
                   uint8_t* HWY_RESTRICT out) {
  const hn::CappedTag<int16_t, kEncodeSpare> d16;
  if (encoding.entries != nullptr) {
    EncodeChunks(count, hn::Lanes(d16), encoding, out, [&](size_t n, int16_t* light) HWY_ATTR {
      hn::StoreU(hn::ShiftLeft<kLightBits - kLayerBits>(hn::LoadU(d16, in + n)), d16, light);
    });
    return;
  }
  const auto below_half = hn::Set(d16, int16_t{(1 << (kLayerBits - 1)) - 1});
  const auto one = hn::Set(d16, int16_t{1});
  const bool done = ForVectors(count, hn::Lanes(d16), [&](size_t n) HWY_ATTR {
    const auto value = hn::LoadU(d16, in + n);
    const auto odd = hn::And(hn::ShiftRight<kLayerBits>(value), one);
    const auto sum = hn::Add(value, hn::Add(below_half, odd));
    StoreBytes(d16, hn::ShiftRight<kLayerBits>(sum), out + n);
  });
  if (!done) reference::Narrow(in, count, encoding, out);
}

inline void FinishLayer(const uint32_t* HWY_RESTRICT accumulators, size_t count, int shift,
                        int16_t* HWY_RESTRICT out) {
  const hn::ScalableTag<uint32_t> d32;
  const hn::RebindToSigned<decltype(d32)> di32;
  const hn::Rebind<int16_t, decltype(d32)> d16;
  const auto half = hn::Set(d32, uint32_t{1} << (shift - kLayerBits - 1));
  const bool done = ForVectors(count, hn::Lanes(d32), [&](size_t n) HWY_ATTR {
    const auto sum = hn::Add(hn::LoadU(d32, accumulators + n), half);
    const auto value = hn::BitCast(di32, hn::ShiftRightSame(sum, shift - kLayerBits));
    hn::StoreU(hn::DemoteTo(d16, value), d16, out + n);
  });
  if (!done) reference::FinishLayer(accumulators, count, shift, out);
}

#if HWY_TARGET == HWY_SCALAR

using reference::Between;
using reference::DeinterleavePhases;
using reference::FilterHalfBand;
using reference::Halve;
using reference::WidenPhases;

#else

// Processes five pairs of pixels at once, which are 15 samples of each phase. Two vectors hold the
// first 8 and the last 8 of these samples. Each byte is moved to the high byte of a lane, and the
// lane is then shifted right.
inline void ShiftPhases(const uint8_t* HWY_RESTRICT in, size_t pairs, int16_t* HWY_RESTRICT even,
                        int16_t* HWY_RESTRICT odd) {
  constexpr uint8_t kZero = 0x80;
  alignas(16) static constexpr uint8_t kFirst[16] = {kZero, 0, kZero, 1, kZero, 2,  kZero, 6,
                                                     kZero, 7, kZero, 8, kZero, 12, kZero, 13};
  alignas(16) static constexpr uint8_t kEvenLast[16] = {kZero, 0, kZero, 1,  kZero, 5,  kZero, 6,
                                                        kZero, 7, kZero, 11, kZero, 12, kZero, 13};
  alignas(16) static constexpr uint8_t kOddLast[16] = {kZero, 2, kZero, 3,  kZero, 7,  kZero, 8,
                                                       kZero, 9, kZero, 13, kZero, 14, kZero, 15};
  const hn::FixedTag<uint8_t, 16> d8;
  const hn::Repartition<uint16_t, decltype(d8)> du16;
  const hn::RebindToSigned<decltype(du16)> d16;
  const auto first = hn::Load(d8, kFirst), even_last = hn::Load(d8, kEvenLast),
             odd_last = hn::Load(d8, kOddLast);
  const auto widen = [&](const uint8_t* from, auto bytes, int16_t* to) HWY_ATTR {
    const auto high = hn::BitCast(du16, hn::TableLookupBytesOr0(hn::LoadU(d8, from), bytes));
    hn::StoreU(hn::BitCast(d16, hn::ShiftRight<8 - kLayerBits>(high)), d16, to);
  };
  const bool done = ForVectors(pairs, 5, [&](size_t pair) HWY_ATTR {
    const uint8_t* from = in + 6 * pair;
    widen(from, first, even + 3 * pair);
    widen(from + 13, even_last, even + 3 * pair + 7);
    widen(from + 3, first, odd + 3 * pair);
    widen(from + 14, odd_last, odd + 3 * pair + 7);
  });
  if (!done) reference::WidenPhases(in, pairs, {nullptr, nullptr}, even, odd);
}

inline void WidenPhases(const uint8_t* HWY_RESTRICT in, size_t pairs, const Encoding& encoding,
                        int16_t* HWY_RESTRICT even, int16_t* HWY_RESTRICT odd) {
  if (encoding.entries == nullptr) {
    ShiftPhases(in, pairs, even, odd);
    return;
  }
  const int16_t* HWY_RESTRICT samples = encoding.samples;
  for (; pairs != 0; --pairs, in += 6, even += 3, odd += 3) {
    for (size_t c = 0; c < 3; ++c) {
      even[c] = samples[in[c]];
      odd[c] = samples[in[3 + c]];
    }
  }
}

// Each store writes a pixel and a fourth sample. The next pixel overwrites the fourth sample.
inline void DeinterleavePhases(const int16_t* HWY_RESTRICT in, size_t pairs,
                               int16_t* HWY_RESTRICT even, int16_t* HWY_RESTRICT odd) {
  const hn::FixedTag<int16_t, 4> d16;
  const auto split = [&](size_t pair) HWY_ATTR {
    hn::StoreU(hn::LoadU(d16, in + 6 * pair), d16, even + 3 * pair);
    hn::StoreU(hn::LoadU(d16, in + 6 * pair + 3), d16, odd + 3 * pair);
  };
  size_t pair = 0;
  for (; pair + 2 <= pairs; pair += 2) {
    split(pair);
    split(pair + 1);
  }
  if (pair < pairs) split(pair);
}

using FilterTag = hn::ScalableTag<int16_t>;
using WideTag = hn::Repartition<int32_t, FilterTag>;
using FilterVec = hn::Vec<FilterTag>;
using WideVec = hn::Vec<WideTag>;

HWY_INLINE FilterVec LoadSamples(const int16_t* at) { return hn::LoadU(FilterTag(), at); }

// Initialises the sums to the centre sample times its tap, plus one half, so that the final shift
// by kTapBits rounds.
HWY_INLINE void BeginTaps(FilterVec centre, int32_t tap, WideVec& low, WideVec& high) {
#if STARFOCUS_HAVE_PAIR_MULTIPLY
  low = high = hn::Zero(WideTag());
  AddWeighed(centre, hn::Set(FilterTag(), int16_t{1}), tap, 1 << (kTapBits - 1), low, high);
#else
  low = high = hn::Set(WideTag(), 1 << (kTapBits - 1));
  const auto taps = hn::Set(FilterTag(), static_cast<int16_t>(tap));
  low = hn::ReorderWidenMulAccumulate(WideTag(), centre, taps, low, high);
#endif
}

HWY_INLINE FilterVec EndTaps(WideVec low, WideVec high) {
  return DemoteSums(FilterTag(), hn::ShiftRight<kTapBits>(low), hn::ShiftRight<kTapBits>(high));
}

inline void FilterHalfBand(const int16_t* in, ptrdiff_t step, const HalfBand& filter, size_t count,
                           int16_t low, int16_t high, int16_t* out) {
  // `taps` is a local copy, because the compiler must assume that writes to `out` change `filter`.
  const HalfBand taps = filter;
  const FilterTag d16;
  const auto least = hn::Set(d16, low), most = hn::Set(d16, high);
  const bool done = ForVectors(count, hn::Lanes(d16), [&](size_t n) HWY_ATTR {
    const int16_t* at = in + n;
    WideVec low_sums, high_sums;
    BeginTaps(LoadSamples(at), taps.centre, low_sums, high_sums);
    AddWeighed(LoadSamples(at - step), LoadSamples(at + step), taps.near, taps.near, low_sums,
               high_sums);
    AddWeighed(LoadSamples(at - 3 * step), LoadSamples(at + 3 * step), taps.far, taps.far, low_sums,
               high_sums);
    const auto value = EndTaps(low_sums, high_sums);
    hn::StoreU(hn::Min(hn::Max(value, least), most), d16, out + n);
  });
  if (!done) reference::FilterHalfBand(in, step, filter, count, low, high, out);
}

inline void Halve(const int16_t* HWY_RESTRICT even, const int16_t* HWY_RESTRICT odd,
                  const HalfBand& filter, size_t count, int16_t* HWY_RESTRICT out) {
  const HalfBand taps = filter;
  const FilterTag d16;
  const bool done = ForVectors(count, hn::Lanes(d16), [&](size_t n) HWY_ATTR {
    const int16_t* at = odd + n;
    // The sums of two samples fit in 16 bits.
    const auto beside = hn::Add(LoadSamples(at - 3), LoadSamples(at));
    const auto beyond = hn::Add(LoadSamples(at - 6), LoadSamples(at + 3));
    WideVec low, high;
    BeginTaps(LoadSamples(even + n), taps.centre, low, high);
    AddWeighed(beside, beyond, taps.near, taps.far, low, high);
    hn::StoreU(EndTaps(low, high), d16, out + n);
  });
  if (!done) reference::Halve(even, odd, filter, count, out);
}

inline void Between(const int16_t* in, ptrdiff_t step, const HalfBand& filter, size_t count,
                    int16_t low, int16_t high, int16_t* out) {
  const HalfBand taps = filter;
  const FilterTag d16;
  const auto least = hn::Set(d16, low), most = hn::Set(d16, high);
  const bool done = ForVectors(count, hn::Lanes(d16), [&](size_t n) HWY_ATTR {
    const int16_t* at = in + n;
    WideVec low_sums = hn::Set(WideTag(), 1 << (kTapBits - 1)), high_sums = low_sums;
    AddWeighed(LoadSamples(at), LoadSamples(at + step), taps.near, taps.near, low_sums, high_sums);
    AddWeighed(LoadSamples(at - step), LoadSamples(at + 2 * step), taps.far, taps.far, low_sums,
               high_sums);
    const auto value = EndTaps(low_sums, high_sums);
    hn::StoreU(hn::Min(hn::Max(value, least), most), d16, out + n);
  });
  if (!done) reference::Between(in, step, filter, count, low, high, out);
}

#endif

}  // namespace HWY_NAMESPACE
}  // namespace starfocus::simd
HWY_AFTER_NAMESPACE();
