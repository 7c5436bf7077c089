// SPDX-License-Identifier: Apache-2.0
// Vector code of the functions in coverage.h. This file is included once per SIMD target.
#if defined(STARFOCUS_SIMD_COVERAGE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STARFOCUS_SIMD_COVERAGE_INL_H_
#undef STARFOCUS_SIMD_COVERAGE_INL_H_
#else
#define STARFOCUS_SIMD_COVERAGE_INL_H_
#endif

#include "simd/coverage.h"
#include "simd/highway-inl.h"

HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

// Returns a mask of the lanes in which `difference` lies in [-limit, limit].
HWY_INLINE hn::Mask<LanesTag> IsWithin(LanesVec difference, int16_t limit) {
  const LanesTag d16;
  return hn::Not(hn::Or(hn::Gt(difference, hn::Set(d16, limit)),
                        hn::Lt(difference, hn::Set(d16, static_cast<int16_t>(-limit)))));
}

inline void CoverPlaces(const int16_t* HWY_RESTRICT near, const uint8_t* HWY_RESTRICT coverage,
                        const int16_t* HWY_RESTRICT far, const CoverView& view,
                        int16_t* HWY_RESTRICT covered) {
  const LanesTag d16;
  const hn::Rebind<uint8_t, LanesTag> d8;
  for (size_t n = 0; n < kSliceLanes; n += hn::Lanes(d16)) {
    const auto nearer = hn::SaturatedSub(hn::LoadU(d16, near + n), hn::LoadU(d16, far + n));
    const auto moved = hn::MulFixedPoint15(nearer, hn::Set(d16, view.along));
    const auto beside = hn::SaturatedSub(moved, hn::Set(d16, view.place));
    const auto covers =
        hn::And(hn::Gt(nearer, hn::Set(d16, view.least)), IsWithin(beside, view.within));
    const auto cover = hn::PromoteTo(d16, hn::LoadU(d8, coverage + n));
    const auto before = hn::LoadU(d16, covered + n);
    hn::StoreU(hn::Max(before, hn::IfThenElseZero(covers, cover)), d16, covered + n);
  }
}

inline void SumNear(const NearRows& rows, NearSums* sums) {
  const LanesTag d16;
  for (size_t n = 0; n < kSliceLanes; n += hn::Lanes(d16)) {
    const auto here = hn::LoadU(d16, rows.disparity + n);
    auto r = hn::Zero(d16), g = r, b = r, weights = r;
    for (int32_t y = -kNearReach; y <= kNearReach; ++y) {
      for (int32_t x = -kNearReach; x <= kNearReach; ++x) {
        const ptrdiff_t there = static_cast<ptrdiff_t>(n) + y * rows.stride + x;
        const int16_t tap = kNearTaps[y < 0 ? -y : y][x < 0 ? -x : x];
        const auto beyond = hn::SaturatedSub(hn::LoadU(d16, rows.disparity + there), here);
        const auto same = IsWithin(beyond, rows.step);
        const auto weight = hn::IfThenElseZero(
            same, hn::Mul(hn::LoadU(d16, rows.weight + there), hn::Set(d16, tap)));
        weights = hn::Add(weights, weight);
        r = hn::Add(r, hn::MulFixedPoint15(hn::LoadU(d16, rows.light[0] + there), weight));
        g = hn::Add(g, hn::MulFixedPoint15(hn::LoadU(d16, rows.light[1] + there), weight));
        b = hn::Add(b, hn::MulFixedPoint15(hn::LoadU(d16, rows.light[2] + there), weight));
      }
    }
    hn::StoreU(r, d16, sums->light[0] + n);
    hn::StoreU(g, d16, sums->light[1] + n);
    hn::StoreU(b, d16, sums->light[2] + n);
    hn::StoreU(weights, d16, sums->weight + n);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace starfocus::simd
HWY_AFTER_NAMESPACE();

#endif
