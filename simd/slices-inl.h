// SPDX-License-Identifier: Apache-2.0
// Vector code of the functions in slices.h. This file is included once per SIMD target.
#include "simd/highway-inl.h"
#include "simd/slices.h"

HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

// Coverage of a group of pixels by a slice: `some` is true if the slice covers any pixel, `all` if
// it covers all pixels completely.
struct GroupCover {
  bool some = false, all = true;

  // Adds a vector of pixels to the coverage; `n` is the index of the first pixel. Pixels at or
  // after `count` are ignored.
  HWY_INLINE void Add(hn::Mask<LanesTag> covered, hn::Mask<LanesTag> whole, size_t n,
                      size_t count) {
    const LanesTag d16;
    if (n + hn::Lanes(d16) > count) {  // This condition is only true in the last group of a row.
      const auto counted = hn::FirstN(d16, n < count ? count - n : 0);
      covered = hn::And(covered, counted);
      whole = hn::Or(whole, hn::Not(counted));
    }
    some = some || !hn::AllFalse(d16, covered);
    all = all && hn::AllTrue(d16, whole);
  }
};

// Returns a mask of the pixels whose disparity is in [low, high].
HWY_INLINE hn::Mask<LanesTag> LiesIn(const int16_t* disparity, LanesVec low, LanesVec high) {
  const LanesTag d16;
  const auto value = hn::LoadU(d16, disparity);
  return hn::Not(hn::Or(hn::Lt(value, low), hn::Gt(value, high)));
}

HWY_INLINE LanesVec LoadBytes(const uint8_t* at) {
  const LanesTag d16;
  return hn::PromoteTo(d16, hn::LoadU(hn::Rebind<uint8_t, LanesTag>(), at));
}

HWY_INLINE void StoreNothing(size_t plane, int16_t* HWY_RESTRICT out) {
  const LanesTag d16;
  for (size_t c = 0; c < 4; ++c) hn::StoreU(hn::Zero(d16), d16, out + c * plane);
}

// SelectFirst and SelectAny write to a row of `count` pixels in planes that are `plane` samples
// apart.

// Selects a vector of pixels that are fully covered by their first surface. The first pixel is n.
HWY_INLINE void SelectFirst(const SurfaceRow& row, int16_t least, int16_t most, size_t n,
                            size_t plane, size_t count, int16_t* HWY_RESTRICT out,
                            GroupCover& cover) {
  const LanesTag d16;
  const auto low = hn::Set(d16, least), overlap = hn::Set(d16, most);
  const auto found = LiesIn(row.disparity[0] + n, low, overlap);
  if (hn::AllFalse(d16, found)) {
    StoreNothing(plane, out + n);
    cover.all = cover.all && n >= count;
    return;
  }
  for (size_t c = 0; c < 3; ++c) {
    const auto value = hn::LoadU(d16, row.rgb[0] + c * row.plane + n);
    hn::StoreU(hn::IfThenElseZero(found, value), d16, out + c * plane + n);
  }
  hn::StoreU(hn::IfThenElseZero(found, hn::Set(d16, kSliceOne)), d16, out + 3 * plane + n);
  cover.Add(found, found, n, count);
}

// Selects a vector of pixels, considering all surfaces. The first pixel is n.
HWY_INLINE void SelectAny(const SurfaceRow& row, int16_t least, int16_t most, int16_t overlapping,
                          size_t n, size_t plane, size_t count, int16_t* HWY_RESTRICT out,
                          GroupCover& cover) {
  const LanesTag d16;
  const auto low = hn::Set(d16, least), high = hn::Set(d16, most);
  const auto overlap = hn::Set(d16, overlapping);
  const auto pixel = hn::Set(d16, kSliceWhole);
  const auto nearest = LiesIn(row.disparity[0] + n, low, overlap);
  const auto next = LiesIn(row.disparity[1] + n, low, overlap);
  const auto last = LiesIn(row.disparity[2] + n, low, overlap);
  int16_t* HWY_RESTRICT to = out + n;
  // Most vectors contain no pixel of the slice.
  if (hn::AllFalse(d16, hn::Or(nearest, hn::Or(next, last)))) {
    StoreNothing(plane, to);
    cover.all = cover.all && n >= count;
    return;
  }
  const auto share = LoadBytes(row.share + n);
  const auto twice =
      hn::And(hn::Ne(share, pixel), hn::Gt(hn::LoadU(d16, row.disparity[0] + n), high));
  const auto first = hn::AndNot(twice, nearest);
  const auto front = hn::IfThenElseZero(first, hn::Min(share, pixel));
  const auto behind = hn::IfThenElseZero(hn::Or(next, last), hn::Sub(pixel, front));
  const auto together = hn::Add(front, behind);
  cover.Add(hn::Ne(together, hn::Zero(d16)), hn::Eq(together, pixel), n, count);
  const auto whole = hn::Eq(front, pixel), shows = hn::Ne(behind, hn::Zero(d16));
  // The weight of a whole pixel exceeds 16 bits. The products of a share and a colour are therefore
  // not used for pixels that one surface covers completely.
  const auto parts = hn::ShiftLeft<15 - kSliceBits>(hn::IfThenZeroElse(whole, front));
  for (size_t c = 0; c < 3; ++c) {
    const size_t at = c * row.plane + n;
    // Uninitialised colours of missing surfaces are masked rather than multiplied by zero, because
    // valgrind would report the multiplication.
    const auto deepest = hn::IfThenElseZero(last, hn::LoadU(d16, row.rgb[2] + at));
    const auto hidden =
        hn::IfThenElseZero(shows, hn::IfThenElse(next, hn::LoadU(d16, row.rgb[1] + at), deepest));
    const auto nearest_light = hn::LoadU(d16, row.rgb[0] + at);
    const auto part = hn::MulFixedPoint15(hn::Sub(nearest_light, hidden), parts);
    hn::StoreU(hn::IfThenElse(whole, nearest_light, hn::Add(hidden, part)), d16, to + c * plane);
  }
  // kSliceWhole times 2^8 is kSliceOne + 1, so 1 is subtracted for whole pixels.
  const auto covered = hn::Sub(hn::ShiftLeft<8>(together), hn::ShiftRight<kSliceBits>(together));
  hn::StoreU(covered, d16, to + 3 * plane);
}

inline SliceCover SelectSlice(const SurfaceRow& row, int16_t low, int16_t high, int16_t overlap,
                              size_t count, size_t plane, int16_t* HWY_RESTRICT out) {
  const LanesTag d16;
  const size_t lanes = hn::Lanes(d16);
  SliceCover cover = {0, 0};
  uint64_t bit = 1;
  for (size_t strip = 0; strip < count; strip += kSliceLanes, bit <<= 1) {
    GroupCover group;
    if ((row.hiding & bit) == 0) {  // Most groups have one surface per pixel.
      for (size_t n = strip; n < strip + kSliceLanes; n += lanes) {
        SelectFirst(row, low, overlap, n, plane, count, out, group);
      }
    } else {
      for (size_t n = strip; n < strip + kSliceLanes; n += lanes) {
        SelectAny(row, low, high, overlap, n, plane, count, out, group);
      }
    }
    if (group.some) cover.some |= bit;
    if (group.all) cover.all |= bit;
  }
  return cover;
}

// Implements SpreadSlice for taps with a reach of kReach.
template <int32_t kReach>
HWY_INLINE void SpreadBy(const int16_t* HWY_RESTRICT in, ptrdiff_t step, const SliceTaps& taps,
                         size_t count, int16_t* HWY_RESTRICT out) {
  const LanesTag d16;
  const hn::RebindToUnsigned<decltype(d16)> du16;
  const size_t lanes = hn::Lanes(d16), whole = SliceSamples(count);
  const auto centre = hn::Set(d16, taps.centre), inner = hn::Set(d16, taps.inner),
             outer = hn::Set(d16, taps.outer);
  for (size_t n = 0; n < whole; n += lanes) {
    const auto mean = [&](ptrdiff_t offset) HWY_ATTR {
      return hn::BitCast(d16, hn::AverageRound(hn::BitCast(du16, hn::LoadU(d16, in + n - offset)),
                                               hn::BitCast(du16, hn::LoadU(d16, in + n + offset))));
    };
    auto sum = hn::MulFixedPoint15(hn::LoadU(d16, in + n), centre);
    for (int32_t k = 1; k < kReach; ++k) {
      sum = hn::SaturatedAdd(sum, hn::MulFixedPoint15(mean(k * step), inner));
    }
    sum = hn::SaturatedAdd(sum, hn::MulFixedPoint15(mean(kReach * step), outer));
    hn::StoreU(sum, d16, out + n);
  }
}

inline void SpreadSlice(const int16_t* HWY_RESTRICT in, ptrdiff_t step, const SliceTaps& taps,
                        size_t count, int16_t* HWY_RESTRICT out) {
  static_assert(kMaxSpread == 3, "SpreadSlice must handle every reach up to kMaxSpread");
  if (taps.reach == 1) return SpreadBy<1>(in, step, taps, count, out);
  if (taps.reach == 2) return SpreadBy<2>(in, step, taps, count, out);
  SpreadBy<3>(in, step, taps, count, out);
}

}  // namespace HWY_NAMESPACE
}  // namespace starfocus::simd
HWY_AFTER_NAMESPACE();
