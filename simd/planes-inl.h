// SPDX-License-Identifier: Apache-2.0
// Vector code of the functions in planes.h. This file is included once per SIMD target.
#if defined(STARFOCUS_SIMD_PLANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STARFOCUS_SIMD_PLANES_INL_H_
#undef STARFOCUS_SIMD_PLANES_INL_H_
#else
#define STARFOCUS_SIMD_PLANES_INL_H_
#endif

#include "simd/highway-inl.h"
#include "simd/match-inl.h"
#include "simd/planes.h"

HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

inline void SplitRow(const uint8_t* HWY_RESTRICT rgb, size_t count, size_t stride,
                     uint8_t* HWY_RESTRICT plane) {
  const hn::CappedTag<uint8_t, kSliceLanes> d8;
  const bool done = ForVectors(count, hn::Lanes(d8), [&](size_t n) HWY_ATTR {
    auto r = hn::Zero(d8), g = hn::Zero(d8), b = hn::Zero(d8);
    hn::LoadInterleaved3(d8, rgb + 3 * n, r, g, b);
    hn::StoreU(r, d8, plane + n);
    hn::StoreU(g, d8, plane + n + stride);
    hn::StoreU(b, d8, plane + n + 2 * stride);
  });
  if (!done) reference::SplitRow(rgb, count, stride, plane);
}

// Returns a + (b - a) * part / 128, rounded half up.
HWY_INLINE MatchVec Between(MatchVec a, MatchVec b, int32_t part) {
  const MatchTag du16;
  const auto first = hn::Set(du16, static_cast<uint16_t>(128 - part));
  const auto second = hn::Set(du16, static_cast<uint16_t>(part));
  const auto sum = hn::Add(hn::Mul(a, first), hn::Mul(b, second));
  return hn::ShiftRight<7>(hn::Add(sum, hn::Set(du16, uint16_t{64})));
}

// Implements InterpolateRow. The parameters kAcross and kDown are true if the shift in the
// respective direction is not 0.
template <bool kAcross, bool kDown>
HWY_INLINE void InterpolateMoved(const uint8_t* HWY_RESTRICT row, const uint8_t* HWY_RESTRICT next,
                                 int32_t across, int32_t down, size_t count,
                                 uint8_t* HWY_RESTRICT out) {
  for (size_t n = 0; n < count; n += hn::Lanes(MatchTag())) {
    auto value = LoadWide(row + n);
    if (kDown) value = Between(value, LoadWide(next + n), down);
    if (kAcross) {
      auto right = LoadWide(row + n + 1);
      if (kDown) right = Between(right, LoadWide(next + n + 1), down);
      value = Between(value, right, across);
    }
    StoreNarrow(value, out + n);
  }
}

inline void InterpolateRow(const uint8_t* row, const uint8_t* next, int32_t across, int32_t down,
                           size_t count, uint8_t* out) {
  if (across == 0) {
    if (down == 0) return InterpolateMoved<false, false>(row, next, across, down, count, out);
    return InterpolateMoved<false, true>(row, next, across, down, count, out);
  }
  if (down == 0) return InterpolateMoved<true, false>(row, next, across, down, count, out);
  InterpolateMoved<true, true>(row, next, across, down, count, out);
}

}  // namespace HWY_NAMESPACE
}  // namespace starfocus::simd
HWY_AFTER_NAMESPACE();

#endif
