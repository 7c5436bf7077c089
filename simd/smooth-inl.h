// SPDX-License-Identifier: Apache-2.0
// Vector code of the functions in smooth.h. This file is included once per SIMD target.
#if defined(STARFOCUS_SIMD_SMOOTH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STARFOCUS_SIMD_SMOOTH_INL_H_
#undef STARFOCUS_SIMD_SMOOTH_INL_H_
#else
#define STARFOCUS_SIMD_SMOOTH_INL_H_
#endif

#include "simd/highway-inl.h"
#include "simd/smooth.h"

HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

using SmoothTag = hn::CappedTag<int32_t, kSliceLanes>;
using SmoothVec = hn::Vec<SmoothTag>;

// Sums the disparities and weights of the neighbours for a vector of pixels. The first pixel is n.
HWY_INLINE void SumSmooth(const SmoothRows& rows, size_t n, SmoothVec& disparity,
                          SmoothVec& weights) {
  const SmoothTag d32;
  const size_t plane = rows.plane;
  const int32_t* HWY_RESTRICT own = rows.own + n;
  const auto middle = hn::LoadU(d32, own), sum = hn::LoadU(d32, own + plane);
  const auto red_green = hn::LoadU(d32, own + 2 * plane);
  const auto green_blue = hn::LoadU(d32, own + 3 * plane);
  const auto tolerance = hn::Set(d32, rows.tolerance);
  const auto most = hn::Set(d32, kMostSmoothWeight), one = hn::Set(d32, 1);
  for (size_t k = 0; k < rows.count; ++k) {
    const int32_t* HWY_RESTRICT row = rows.rows[k] + n;
    for (int32_t x = -rows.radius; x <= rows.radius; x += rows.step) {
      const int32_t* HWY_RESTRICT other = row + x;
      const auto d = hn::LoadU(d32, other);
      const auto brightness = hn::Abs(hn::Sub(sum, hn::LoadU(d32, other + plane)));
      const auto a = hn::Sub(red_green, hn::LoadU(d32, other + 2 * plane));
      const auto b = hn::Sub(green_blue, hn::LoadU(d32, other + 3 * plane));
      const auto hue = hn::Add(hn::Add(hn::Abs(a), hn::Abs(b)), hn::Abs(hn::Add(a, b)));
      const auto difference = hn::Add(hn::ShiftRight<2>(brightness), hue);
      const auto far = hn::Gt(hn::Abs(hn::Sub(d, middle)), tolerance);
      const auto weight = hn::IfThenZeroElse(far, hn::Max(hn::Sub(most, difference), one));
      disparity = hn::Add(disparity, hn::Mul(weight, d));
      weights = hn::Add(weights, weight);
    }
  }
}

inline void SmoothDisparity(const SmoothRows& rows, size_t count, int16_t* HWY_RESTRICT smooth) {
  const SmoothTag d32;
  const size_t lanes = hn::Lanes(d32);
  int32_t disparities[kSliceLanes], weights[kSliceLanes];
  for (size_t n = 0; n < count; n += lanes) {
    auto disparity = hn::Zero(d32), weight = hn::Zero(d32);
    SumSmooth(rows, n, disparity, weight);
    hn::StoreU(disparity, d32, disparities);
    hn::StoreU(weight, d32, weights);
    for (size_t k = 0; k < lanes && n + k < count; ++k) {
      smooth[n + k] = SmoothSums{disparities[k], weights[k]}.Mean();
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace starfocus::simd
HWY_AFTER_NAMESPACE();

#endif
