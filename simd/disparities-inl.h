// SPDX-License-Identifier: Apache-2.0
// Vector code of the functions in disparities.h. This file is included once per SIMD target.
#include "simd/disparities.h"
#include "simd/highway-inl.h"

HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

inline bool ConvertDisparity(const float* HWY_RESTRICT disparity, size_t count, float low,
                             float high, int16_t* HWY_RESTRICT out) {
  const hn::ScalableTag<float> df;
  const hn::RebindToSigned<decltype(df)> di32;
  const hn::Rebind<int16_t, decltype(df)> di16;
  const auto scale = hn::Set(df, 64.0f);
  const auto half = hn::Set(df, 0.5f);
  bool all_inside = true;
  const bool done = ForVectors(count, hn::Lanes(df), [&](size_t n) HWY_ATTR {
    const auto d = hn::LoadU(df, disparity + n);
    const auto inside = hn::And(hn::Ge(d, hn::Set(df, low)), hn::Le(d, hn::Set(df, high)));
    all_inside = all_inside && hn::AllTrue(df, inside);
    const auto scaled = hn::Floor(hn::Add(hn::Mul(d, scale), half));
    const auto result = hn::ConvertTo(di32, hn::IfThenElseZero(inside, scaled));
    hn::StoreU(hn::DemoteTo(di16, result), di16, out + n);
  });
  return done ? all_inside : reference::ConvertDisparity(disparity, count, low, high, out);
}

// Returns the range of the disparities in `count` columns; `count` is at most kSliceLanes.
HWY_INLINE DisparityRange RangeOfColumns(const int16_t* HWY_RESTRICT disparity, size_t stride,
                                         size_t rows, size_t count) {
  const LanesTag d16;
  const auto none = hn::Set(d16, kNoSurface), one = hn::Set(d16, int16_t{1});
  // `below` is the lowest disparity minus 1. Subtracting 1 from kNoSurface wraps to INT16_MAX, so
  // that missing surfaces have no effect.
  auto below = hn::Set(d16, int16_t{INT16_MAX}), high = none;
  for (size_t n = 0; n < count; n += hn::Lanes(d16)) {
    const auto counted = hn::FirstN(d16, count - n);
    const int16_t* at = disparity + n;
    for (size_t row = 0; row < rows; ++row, at += stride) {
      auto value = hn::LoadU(d16, at);
      if (count < kSliceLanes) value = hn::IfThenElse(counted, value, none);
      below = hn::Min(below, hn::Sub(value, one));
      high = hn::Max(high, value);
    }
  }
  const int16_t least = hn::GetLane(hn::MinOfLanes(d16, below));
  return {static_cast<int16_t>(least < INT16_MAX ? least + 1 : least),
          hn::GetLane(hn::MaxOfLanes(d16, high))};
}

inline void FindRanges(const int16_t* disparity, size_t stride, size_t rows, size_t count,
                       DisparityRange* ranges) {
  for (size_t n = 0; n < count; n += kSliceLanes) {
    *ranges++ = RangeOfColumns(disparity + n, stride, rows,
                               count - n < kSliceLanes ? count - n : kSliceLanes);
  }
}

inline void FindWithin(const int16_t* HWY_RESTRICT disparity, size_t stride, size_t rows,
                       const DisparityRange& range, uint16_t* HWY_RESTRICT within) {
  const LanesTag d16;
  const auto low = hn::Set(d16, range.low), high = hn::Set(d16, range.high);
  for (size_t row = 0; row < rows; ++row, disparity += stride) {
    uint32_t bits = 0;
    for (size_t n = 0; n < kSliceLanes; n += hn::Lanes(d16)) {
      const auto value = hn::LoadU(d16, disparity + n);
      const auto outside = hn::Or(hn::Lt(value, low), hn::Gt(value, high));
      if (!hn::AllTrue(d16, outside)) bits |= BitsOf(d16, hn::Not(outside)) << n;
    }
    within[row] = static_cast<uint16_t>(bits);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace starfocus::simd
HWY_AFTER_NAMESPACE();
