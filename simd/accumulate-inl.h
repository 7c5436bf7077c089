// Kernels::accumulate and Kernels::finish. Included once per target.
#if defined(STARFOCUS_SIMD_ACCUMULATE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STARFOCUS_SIMD_ACCUMULATE_INL_H_
#undef STARFOCUS_SIMD_ACCUMULATE_INL_H_
#else
#define STARFOCUS_SIMD_ACCUMULATE_INL_H_
#endif

#include "simd/compat-inl.h"
#include "simd/kernels.h"

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

HWY_INLINE void AccumulateSpans(const Span* HWY_RESTRICT spans, size_t count,
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

HWY_INLINE void FinishSamples(const uint32_t* HWY_RESTRICT accumulators, size_t count, int shift,
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
