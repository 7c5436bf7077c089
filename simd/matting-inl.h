// SPDX-License-Identifier: Apache-2.0
// Vector code of the functions in matting.h. This file is included once per SIMD target.
#include "simd/highway-inl.h"
#include "simd/matting.h"

HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

// Returns a mask of the lanes in which `difference` lies in [-limit, limit].
HWY_INLINE hn::Mask<LanesTag> IsWithin(LanesVec difference, int16_t limit) {
  const LanesTag d16;
  return hn::Not(hn::Or(hn::Gt(difference, hn::Set(d16, limit)),
                        hn::Lt(difference, hn::Set(d16, static_cast<int16_t>(-limit)))));
}

inline void FindBeyond(const int16_t* HWY_RESTRICT row, ptrdiff_t stride, int16_t step,
                       int16_t* HWY_RESTRICT beyond, int16_t* HWY_RESTRICT square) {
  const LanesTag d16;
  for (size_t n = 0; n < kSliceLanes; n += hn::Lanes(d16)) {
    const auto here = hn::LoadU(d16, row + n), none = hn::Set(d16, int16_t{INT16_MAX});
    auto found = here, distance = none;
    for (int32_t y = -kBeyondRadius; y <= kBeyondRadius; ++y) {
      for (int32_t x = -kBeyondRadius; x <= kBeyondRadius; ++x) {
        const auto there = hn::LoadU(d16, row + n + y * stride + x);
        const auto own = hn::Set(d16, static_cast<int16_t>(x * x + y * y));
        const auto larger = hn::And(hn::Eq(distance, own), hn::Gt(there, found));
        const auto better = hn::Or(hn::Gt(distance, own), larger);
        const auto takes = hn::AndNot(IsWithin(hn::SaturatedSub(there, here), step), better);
        found = hn::IfThenElse(takes, there, found);
        distance = hn::IfThenElse(takes, own, distance);
      }
    }
    distance = hn::IfThenZeroElse(hn::Eq(distance, none), distance);
    hn::StoreU(found, d16, beyond + n);
    hn::StoreU(distance, d16, square + n);
  }
}

inline void CoverPlaces(const int16_t* HWY_RESTRICT near, const uint8_t* HWY_RESTRICT coverage,
                        const int16_t* HWY_RESTRICT far, const CoverView& view,
                        int16_t* HWY_RESTRICT covered) {
  const LanesTag d16;
  for (size_t n = 0; n < kSliceLanes; n += hn::Lanes(d16)) {
    const auto nearer = hn::SaturatedSub(hn::LoadU(d16, near + n), hn::LoadU(d16, far + n));
    const auto moved = hn::MulFixedPoint15(nearer, hn::Set(d16, view.along));
    const auto beside = hn::SaturatedSub(moved, hn::Set(d16, view.place));
    const auto covers =
        hn::And(hn::Gt(nearer, hn::Set(d16, view.least)), IsWithin(beside, view.within));
    const auto cover = LoadBytes(d16, coverage + n);
    const auto before = hn::LoadU(d16, covered + n);
    hn::StoreU(hn::Max(before, hn::IfThenElseZero(covers, cover)), d16, covered + n);
  }
}

inline void SumNear(const int16_t* const light[3], const int16_t* disparity, const int16_t* weight,
                    ptrdiff_t stride, int16_t step, int16_t sums[4][kSliceLanes]) {
  const LanesTag d16;
  for (size_t n = 0; n < kSliceLanes; n += hn::Lanes(d16)) {
    const auto here = hn::LoadU(d16, disparity + n);
    auto r = hn::Zero(d16), g = r, b = r, weights = r;
    for (int32_t y = -kNearRadius; y <= kNearRadius; ++y) {
      for (int32_t x = -kNearRadius; x <= kNearRadius; ++x) {
        const ptrdiff_t there = static_cast<ptrdiff_t>(n) + y * stride + x;
        const int16_t tap = kNearTaps[y < 0 ? -y : y][x < 0 ? -x : x];
        const auto beyond = hn::SaturatedSub(hn::LoadU(d16, disparity + there), here);
        const auto same = IsWithin(beyond, step);
        const auto part =
            hn::IfThenElseZero(same, hn::Mul(hn::LoadU(d16, weight + there), hn::Set(d16, tap)));
        weights = hn::Add(weights, part);
        r = hn::Add(r, hn::MulFixedPoint15(hn::LoadU(d16, light[0] + there), part));
        g = hn::Add(g, hn::MulFixedPoint15(hn::LoadU(d16, light[1] + there), part));
        b = hn::Add(b, hn::MulFixedPoint15(hn::LoadU(d16, light[2] + there), part));
      }
    }
    hn::StoreU(r, d16, sums[0] + n);
    hn::StoreU(g, d16, sums[1] + n);
    hn::StoreU(b, d16, sums[2] + n);
    hn::StoreU(weights, d16, sums[3] + n);
  }
}

inline void SumVotes(const int16_t* const colours[3], const int16_t* surface, const int16_t* trusts,
                     const int16_t* middles, ptrdiff_t stride, int32_t reach, int32_t step,
                     const int16_t* closeness, VoteSums* HWY_RESTRICT sums) {
  const LanesTag d16;
  const hn::RebindToUnsigned<LanesTag> du16;
  const auto zero = hn::Zero(d16);
  for (size_t n = 0; n < kSliceLanes; n += hn::Lanes(d16)) {
    const auto red = hn::LoadU(d16, colours[0] + n);
    const auto green = hn::LoadU(d16, colours[1] + n);
    const auto blue = hn::LoadU(d16, colours[2] + n);
    const auto middle = hn::LoadU(d16, middles + n);
    auto similar_far = hn::Zero(du16), similar_near = similar_far;
    auto weight_all = zero, weight_near = zero;
    const int16_t* HWY_RESTRICT close = closeness;
    for (int32_t y = -reach; y <= reach; y += step) {
      const ptrdiff_t row = static_cast<ptrdiff_t>(n) + y * stride;
      auto all = zero, near = zero;
      for (int32_t x = -reach; x <= reach; x += step, ++close) {
        const ptrdiff_t at = row + x;
        const auto trust = hn::LoadU(d16, trusts + at);
        const auto r = hn::Abs(hn::Sub(hn::LoadU(d16, colours[0] + at), red));
        const auto g = hn::Abs(hn::Sub(hn::LoadU(d16, colours[1] + at), green));
        const auto b = hn::Abs(hn::Sub(hn::LoadU(d16, colours[2] + at), blue));
        const auto difference = hn::BitCast(du16, hn::Add(hn::Add(r, g), b));
        const auto wide = hn::SaturatedSub(hn::Set(du16, kWide), difference);
        const auto tight = hn::SaturatedSub(hn::Set(du16, kTight), difference);
        const auto similar = hn::BitCast(d16, hn::Add(hn::ShiftRight<9>(hn::Mul(wide, wide)),
                                                      hn::ShiftRight<2>(hn::Mul(tight, tight))));
        const auto weight = hn::MulFixedPoint15(trust, hn::Set(d16, *close));
        const auto weighted = hn::Mul(weight, similar);
        const auto nearer = hn::Gt(hn::LoadU(d16, surface + at), middle);
        all = hn::Add(all, weighted);
        near = hn::Add(near, hn::IfThenElseZero(nearer, weighted));
        weight_all = hn::Add(weight_all, weight);
        weight_near = hn::Add(weight_near, hn::IfThenElseZero(nearer, weight));
      }
      const auto far = hn::BitCast(du16, hn::Sub(all, near));
      similar_near = hn::Add(similar_near, hn::ShiftRight<4>(hn::BitCast(du16, near)));
      similar_far = hn::Add(similar_far, hn::ShiftRight<4>(far));
    }
    const auto weight_far = hn::Sub(weight_all, weight_near);
    hn::StoreU(similar_far, du16, sums->similar[0] + n);
    hn::StoreU(similar_near, du16, sums->similar[1] + n);
    hn::StoreU(hn::BitCast(du16, weight_far), du16, sums->weight[0] + n);
    hn::StoreU(hn::BitCast(du16, weight_near), du16, sums->weight[1] + n);
  }
}

inline void SmoothDisparity(const int32_t* own, const int32_t* const* rows, size_t height,
                            size_t plane, int32_t radius, int32_t step, int32_t tolerance,
                            size_t count, int16_t* HWY_RESTRICT smooth) {
  const hn::CappedTag<int32_t, kSliceLanes> d32;
  const size_t lanes = hn::Lanes(d32);
  const auto limit = hn::Set(d32, tolerance);
  const auto most = hn::Set(d32, kMostSmoothWeight), one = hn::Set(d32, 1);
  for (size_t n = 0; n < count; n += lanes) {
    const int32_t* HWY_RESTRICT here = own + n;
    const auto middle = hn::LoadU(d32, here), sum = hn::LoadU(d32, here + plane);
    const auto red_green = hn::LoadU(d32, here + 2 * plane);
    const auto green_blue = hn::LoadU(d32, here + 3 * plane);
    auto disparity = hn::Zero(d32), weights = hn::Zero(d32);
    for (size_t k = 0; k < height; ++k) {
      const int32_t* HWY_RESTRICT row = rows[k] + n;
      for (int32_t x = -radius; x <= radius; x += step) {
        const int32_t* HWY_RESTRICT other = row + x;
        const auto d = hn::LoadU(d32, other);
        const auto brightness = hn::Abs(hn::Sub(sum, hn::LoadU(d32, other + plane)));
        const auto a = hn::Sub(red_green, hn::LoadU(d32, other + 2 * plane));
        const auto b = hn::Sub(green_blue, hn::LoadU(d32, other + 3 * plane));
        const auto hue = hn::Add(hn::Add(hn::Abs(a), hn::Abs(b)), hn::Abs(hn::Add(a, b)));
        const auto difference = hn::Add(hn::ShiftRight<2>(brightness), hue);
        const auto far = hn::Gt(hn::Abs(hn::Sub(d, middle)), limit);
        const auto weight = hn::IfThenZeroElse(far, hn::Max(hn::Sub(most, difference), one));
        disparity = hn::Add(disparity, hn::Mul(weight, d));
        weights = hn::Add(weights, weight);
      }
    }
    int32_t disparities[kSliceLanes], sums[kSliceLanes];
    hn::StoreU(disparity, d32, disparities);
    hn::StoreU(weights, d32, sums);
    for (size_t k = 0; k < lanes && n + k < count; ++k) {
      smooth[n + k] = SmoothMean(disparities[k], sums[k]);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace starfocus::simd
HWY_AFTER_NAMESPACE();
