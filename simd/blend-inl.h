// Kernels::blend, spread and convert_disparity. Included once per target.
#if defined(STARFOCUS_SIMD_BLEND_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STARFOCUS_SIMD_BLEND_INL_H_
#undef STARFOCUS_SIMD_BLEND_INL_H_
#else
#define STARFOCUS_SIMD_BLEND_INL_H_
#endif

#include <cstring>

#include "simd/compat-inl.h"
#include "simd/kernels.h"

HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

// sum / 256 of at most 65280, halves to even.
template <class D16, class V16>
HWY_INLINE V16 RoundToByte(D16 d16, V16 sum) {
  const auto below_half = hn::Set(d16, uint16_t{127}), one = hn::Set(d16, uint16_t{1});
  const auto rounding = hn::Add(hn::And(hn::ShiftRight<8>(sum), one), below_half);
  return hn::ShiftRight<8>(hn::Add(sum, rounding));
}

// target[n] = value(n) for n < samples, a vector of `lanes` values at a time.
template <class D8, class Value>
HWY_INLINE void StoreSamples(D8 d8, size_t lanes, size_t samples, uint8_t* HWY_RESTRICT target,
                             const Value& value) {
  if (samples < lanes) {
    uint8_t last[HWY_MAX_BYTES];
    hn::StoreU(value(0), d8, last);
    std::memcpy(target, last, samples);
    return;
  }
  size_t n = 0;
  for (; n + lanes <= samples; n += lanes) hn::StoreU(value(n), d8, target + n);
  // The last vector overlaps the one before it: the same values again.
  if (n != samples) hn::StoreU(value(samples - lanes), d8, target + samples - lanes);
}

HWY_INLINE void BlendSpan(const Span& span, uint8_t* HWY_RESTRICT target) {
  const hn::ScalableTag<uint16_t> d16;
  const hn::RebindToSigned<decltype(d16)> di16;
  const hn::Rebind<uint8_t, decltype(d16)> d8;
  const auto weight = hn::Set(d16, span.weight);
  const auto neighbour_weight = hn::Set(d16, span.neighbour_weight);
  const uint8_t* HWY_RESTRICT source = span.source;
  const uint8_t* HWY_RESTRICT neighbour = source + span.neighbour_offset;
  StoreSamples(d8, hn::Lanes(d16), span.samples, target, [&](size_t n) HWY_ATTR {
    const auto a = hn::Mul(hn::PromoteTo(d16, hn::LoadU(d8, source + n)), weight);
    const auto b = hn::Mul(hn::PromoteTo(d16, hn::LoadU(d8, neighbour + n)), neighbour_weight);
    return hn::DemoteTo(d8, hn::BitCast(di16, RoundToByte(d16, hn::Add(a, b))));
  });
}

HWY_INLINE void BlendSpans(const Span* HWY_RESTRICT spans, size_t count,
                           uint8_t* HWY_RESTRICT line) {
  for (size_t i = 0; i < count; ++i) {
    if (spans[i].neighbour_weight == 0) {
      std::memcpy(line + spans[i].target, spans[i].source, spans[i].samples);
    } else {
      BlendSpan(spans[i], line + spans[i].target);
    }
  }
}

HWY_INLINE bool ConvertDisparities(const float* HWY_RESTRICT disparity, size_t count, float low,
                                   float high, int16_t* HWY_RESTRICT out) {
  const hn::ScalableTag<float> df;
  const hn::RebindToSigned<decltype(df)> di32;
  const hn::Rebind<int16_t, decltype(df)> di16;
  const size_t lanes = hn::Lanes(df);
  const auto scale = hn::Set(df, 64.0f);
  const auto half = hn::Set(df, 0.5f);
  size_t n = 0;
  for (; n + lanes <= count; n += lanes) {
    const auto d = hn::LoadU(df, disparity + n);
    const auto inside = hn::And(hn::Ge(d, hn::Set(df, low)), hn::Le(d, hn::Set(df, high)));
    if (!hn::AllTrue(df, inside)) return false;
    const auto scaled = hn::Floor(hn::Add(hn::Mul(d, scale), half));
    hn::StoreU(hn::DemoteTo(di16, hn::ConvertTo(di32, scaled)), di16, out + n);
  }
  return n == count ||
         ReferenceKernels().convert_disparity(disparity + n, count - n, low, high, out + n);
}

}  // namespace HWY_NAMESPACE
}  // namespace starfocus::simd
HWY_AFTER_NAMESPACE();

#endif
