// SPDX-License-Identifier: Apache-2.0
// Vector code of the functions in slope.h. This file is included once per SIMD target.
#if defined(STARFOCUS_SIMD_SLOPE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STARFOCUS_SIMD_SLOPE_INL_H_
#undef STARFOCUS_SIMD_SLOPE_INL_H_
#else
#define STARFOCUS_SIMD_SLOPE_INL_H_
#endif

#include "simd/highway-inl.h"
#include "simd/slope.h"

HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

inline void MixSamples(const int16_t* HWY_RESTRICT less, const int16_t* HWY_RESTRICT more,
                       const int16_t* HWY_RESTRICT share, size_t count, int16_t* HWY_RESTRICT out) {
  const hn::CappedTag<int16_t, kSliceLanes> d16;
  for (size_t n = 0; n < SliceSamples(count); n += hn::Lanes(d16)) {
    const auto from = hn::LoadU(d16, less + n);
    const auto rest = hn::Sub(hn::LoadU(d16, more + n), from);
    hn::StoreU(hn::Add(from, hn::MulFixedPoint15(rest, hn::LoadU(d16, share + n))), d16, out + n);
  }
}

inline void MoveSamples(const SampleRows& in, const HalfMove& move, int16_t* HWY_RESTRICT out,
                        size_t out_stride) {
  const size_t stride = in.stride, whole = SliceSamples(in.count);
  const hn::CappedTag<int16_t, kSliceLanes> d16;
  const auto across = hn::Set(d16, move.across), down = hn::Set(d16, move.down);
  const auto white = hn::Set(d16, kLayerWhite);
  const int16_t* HWY_RESTRICT row = in.samples;
  for (size_t y = 0; y < in.rows; ++y, row += stride, out += out_stride) {
    const auto change = [&](const int16_t* from, const int16_t* to) HWY_ATTR {
      return hn::SaturatedSub(hn::LoadU(d16, to), hn::LoadU(d16, from));
    };
    for (size_t n = 0; n < whole; n += hn::Lanes(d16)) {
      const int16_t* at = row + n;
      auto value =
          hn::SaturatedAdd(hn::LoadU(d16, at), hn::MulFixedPoint15(change(at - 3, at + 3), across));
      value = hn::SaturatedAdd(value, hn::MulFixedPoint15(change(at - stride, at + stride), down));
      hn::StoreU(hn::Min(hn::Max(value, hn::Zero(d16)), white), d16, out + n);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace starfocus::simd
HWY_AFTER_NAMESPACE();

#endif
