// SPDX-License-Identifier: Apache-2.0
// Vector code of the functions in spans.h. This file is included once per SIMD target.
#include "simd/highway-inl.h"
#include "simd/spans.h"

HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

// Adds value(n, keep) to the accumulators of a span, one vector at a time. In the last vector,
// `keep` zeroes the samples beyond the span before the weighting. The samples beyond the span may
// be uninitialised, and valgrind treats two lanes that are multiplied and added in pairs as one
// value.
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
  const hn::Rebind<uint16_t, decltype(d32)> d16;
  for (size_t i = 0; i < count; ++i) {
    const Span& span = spans[i];
    const auto* HWY_RESTRICT source = reinterpret_cast<const uint16_t*>(span.source);
    uint32_t* HWY_RESTRICT target = accumulators + span.target;
    const auto weight = hn::Set(d32, span.weight);
    const auto neighbour_weight = hn::Set(d32, span.neighbour_weight);
    if (span.neighbour_weight == 0) {
      AddSpan(d32, span.samples, target, [&](size_t n, const auto& keep) HWY_ATTR {
        const auto a = keep(hn::PromoteTo(d32, hn::LoadU(d16, source + n)));
        return WeighPair(d32, a, hn::Zero(d32), weight, hn::Zero(d32));
      });
    } else {
      const uint16_t* HWY_RESTRICT neighbour = source + span.neighbour_offset;
      AddSpan(d32, span.samples, target, [&](size_t n, const auto& keep) HWY_ATTR {
        const auto a = keep(hn::PromoteTo(d32, hn::LoadU(d16, source + n)));
        const auto b = keep(hn::PromoteTo(d32, hn::LoadU(d16, neighbour + n)));
        return WeighPair(d32, a, b, weight, neighbour_weight);
      });
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace starfocus::simd
HWY_AFTER_NAMESPACE();
