// SPDX-License-Identifier: Apache-2.0
// Vector code of spans.h. Included once per target.
#if defined(STARFOCUS_SIMD_SPANS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STARFOCUS_SIMD_SPANS_INL_H_
#undef STARFOCUS_SIMD_SPANS_INL_H_
#else
#define STARFOCUS_SIMD_SPANS_INL_H_
#endif

#include <cstring>

#include "simd/compat-inl.h"
#include "simd/spans.h"

HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

// Adds value(n, keep) to the accumulators of a span, a vector at a time. In the last vector `keep`
// zeroes the pixels beyond the span before they are weighed: what lies there may never have been
// written, and valgrind takes a pair of lanes multiplied together for one value.
template <class D32, class Value>
HWY_INLINE void AddSpan(D32 d32, uint32_t samples, uint32_t* HWY_RESTRICT target,
                        const Value& value) {
  using V32 = hn::Vec<D32>;
  const size_t lanes = hn::Lanes(d32);
  const auto keep_all = [](V32 pixels) HWY_ATTR { return pixels; };
  size_t n = 0;
  for (; n + lanes <= samples; n += lanes) {
    hn::StoreU(hn::Add(hn::LoadU(d32, target + n), value(n, keep_all)), d32, target + n);
  }
  if (n == samples) return;
  const auto mask = hn::FirstN(d32, samples - n);
  const auto keep = [&](V32 pixels) HWY_ATTR { return hn::IfThenElseZero(mask, pixels); };
  hn::StoreU(hn::Add(hn::LoadU(d32, target + n), value(n, keep)), d32, target + n);
}

inline void Accumulate(const Span* HWY_RESTRICT spans, size_t count,
                       uint32_t* HWY_RESTRICT accumulators) {
  const hn::ScalableTag<uint32_t> d32;
  const hn::Rebind<uint8_t, decltype(d32)> d8;
  for (size_t i = 0; i < count; ++i) {
    const Span& span = spans[i];
    const uint8_t* HWY_RESTRICT source = span.source;
    uint32_t* HWY_RESTRICT target = accumulators + span.target;
    const auto weight = hn::Set(d32, span.weight);
    const auto neighbour_weight = hn::Set(d32, span.neighbour_weight);
    if (span.neighbour_weight == 0) {
      AddSpan(d32, span.samples, target, [&](size_t n, const auto& keep) HWY_ATTR {
        const auto a = keep(hn::PromoteTo(d32, hn::LoadU(d8, source + n)));
        return WeighPair(d32, a, hn::Zero(d32), weight, hn::Zero(d32));
      });
    } else {
      const uint8_t* HWY_RESTRICT neighbour = source + span.neighbour_offset;
      AddSpan(d32, span.samples, target, [&](size_t n, const auto& keep) HWY_ATTR {
        const auto a = keep(hn::PromoteTo(d32, hn::LoadU(d8, source + n)));
        const auto b = keep(hn::PromoteTo(d32, hn::LoadU(d8, neighbour + n)));
        return WeighPair(d32, a, b, weight, neighbour_weight);
      });
    }
  }
}

// Returns sum / 256, rounded halves to even, of sums of 65280 at most.
template <class D16, class V16>
HWY_INLINE V16 RoundToByte(D16 d16, V16 sum) {
  const auto below_half = hn::Set(d16, uint16_t{127}), one = hn::Set(d16, uint16_t{1});
  const auto rounding = hn::Add(hn::And(hn::ShiftRight<8>(sum), one), below_half);
  return hn::ShiftRight<8>(hn::Add(sum, rounding));
}

// Stores target[n] = value(n) for n < samples, a vector of `lanes` values at a time.
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
  // The last vector overlaps the one before it, and stores the same values again.
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

inline void Blend(const Span* HWY_RESTRICT spans, size_t count, uint8_t* HWY_RESTRICT line) {
  for (size_t i = 0; i < count; ++i) {
    if (spans[i].neighbour_weight == 0) {
      std::memcpy(line + spans[i].target, spans[i].source, spans[i].samples);
    } else {
      BlendSpan(spans[i], line + spans[i].target);
    }
  }
}

inline void Finish(const uint32_t* HWY_RESTRICT accumulators, size_t count, int shift,
                   uint8_t* HWY_RESTRICT out) {
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
