// SPDX-License-Identifier: Apache-2.0
// Vector code of the functions in slices.h. This file is included once per SIMD target.
#include "simd/highway-inl.h"
#include "simd/slices.h"

HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

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

// SelectFirst and SelectAny select a vector of pixels, whose first pixel is n, and write the
// colours to planes that are `plane` samples apart. They return the coverage.

// Selects pixels that are fully covered by their first surface.
HWY_INLINE LanesVec SelectFirst(const SurfaceRow& row, LanesVec low, LanesVec overlap, size_t n,
                                size_t plane, int16_t* HWY_RESTRICT out) {
  const LanesTag d16;
  const auto found = LiesIn(row.disparity[0] + n, low, overlap);
  for (size_t c = 0; c < 3; ++c) {
    const auto value = hn::LoadU(d16, row.rgb[0] + c * row.plane + n);
    hn::StoreU(hn::IfThenElseZero(found, value), d16, out + c * plane + n);
  }
  return hn::IfThenElseZero(found, hn::Set(d16, kSliceOne));
}

// Selects pixels, considering all surfaces.
HWY_INLINE LanesVec SelectAny(const SurfaceRow& row, LanesVec low, LanesVec high, LanesVec overlap,
                              size_t n, size_t plane, int16_t* HWY_RESTRICT out) {
  const LanesTag d16;
  const auto pixel = hn::Set(d16, kSliceWhole), share = LoadBytes(row.share + n);
  const auto nearest = LiesIn(row.disparity[0] + n, low, overlap);
  const auto next = LiesIn(row.disparity[1] + n, low, overlap);
  const auto last = LiesIn(row.disparity[2] + n, low, overlap);
  const auto twice =
      hn::And(hn::Ne(share, pixel), hn::Gt(hn::LoadU(d16, row.disparity[0] + n), high));
  const auto first = hn::AndNot(twice, nearest);
  const auto front = hn::IfThenElseZero(first, hn::Min(share, pixel));
  const auto behind = hn::IfThenElseZero(hn::Or(next, last), hn::Sub(pixel, front));
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
    hn::StoreU(hn::IfThenElse(whole, nearest_light, hn::Add(hidden, part)), d16,
               out + c * plane + n);
  }
  // kSliceWhole times 2^8 is kSliceOne + 1, so 1 is subtracted for whole pixels.
  const auto together = hn::Add(front, behind);
  return hn::Sub(hn::ShiftLeft<8>(together), hn::ShiftRight<kSliceBits>(together));
}

// Selects the group of pixels from `strip` on. kHiding is true if the group may have more than one
// surface. If the slice covers any of the first `count` pixels of the row, sets `bit` in
// cover->some; if it covers all of them completely, also in cover->all. Writes nothing if no
// disparity of the group lies in the slice.
template <bool kHiding>
HWY_INLINE void SelectGroup(const SurfaceRow& row, const SliceRange& slice, size_t strip,
                            size_t count, size_t plane, int16_t* HWY_RESTRICT out, uint64_t bit,
                            SliceCover* cover) {
  const LanesTag d16;
  const auto low = hn::Set(d16, slice.low), high = hn::Set(d16, slice.high);
  const auto overlap = hn::Set(d16, slice.overlap);
  const size_t lanes = hn::Lanes(d16), end = strip + kSliceLanes;
  const auto one = hn::Set(d16, kSliceOne);
  auto found = hn::Zero(d16), mixed = hn::Zero(d16);
  for (size_t n = strip; n < end; n += lanes) {
    const auto first = LiesIn(row.disparity[0] + n, low, overlap);
    found = hn::Or(found, hn::VecFromMask(d16, first));
    if (!kHiding) continue;
    const auto next = LiesIn(row.disparity[1] + n, low, overlap);
    const auto last = LiesIn(row.disparity[2] + n, low, overlap);
    const auto whole = hn::Eq(LoadBytes(row.share + n), hn::Set(d16, kSliceWhole));
    const auto more = hn::AndNot(hn::And(first, whole), hn::Or(first, hn::Or(next, last)));
    mixed = hn::Or(mixed, hn::VecFromMask(d16, more));
  }
  const bool is_mixed = kHiding && !AllZero(d16, mixed);
  if (!is_mixed && AllZero(d16, found)) return;
  auto some = hn::Zero(d16), all = one;
  for (size_t n = strip; n < end; n += lanes) {
    const auto covered = is_mixed ? SelectAny(row, low, high, overlap, n, plane, out)
                                  : SelectFirst(row, low, overlap, n, plane, out);
    hn::StoreU(covered, d16, out + 3 * plane + n);
    if (n + lanes <= count) {
      some = hn::Or(some, covered);
      all = hn::And(all, covered);
    } else {  // the last group of a row
      const auto counted = hn::FirstN(d16, n < count ? count - n : 0);
      some = hn::Or(some, hn::IfThenElseZero(counted, covered));
      all = hn::And(all, hn::IfThenElse(counted, covered, one));
    }
  }
  if (!AllZero(d16, some)) cover->some |= bit;
  if (hn::AllTrue(d16, hn::Eq(all, one))) cover->all |= bit;
}

inline void SelectSlice(const SurfaceRows& from, const SliceRange& slice, uint64_t groups,
                        size_t width, size_t plane, int16_t* HWY_RESTRICT out,
                        SliceCover* HWY_RESTRICT cover) {
  const LanesTag d16;
  const uint64_t written = (uint64_t{2} << (width / kSliceLanes - 1)) - 1;
  for (size_t y = 0; y < from.rows; ++y, out += 4 * plane) {
    const SurfaceRow row = from.Row(y);
    SliceCover covers = {0, 0};
    for (uint64_t rest = groups; rest != 0; rest &= rest - 1) {
      const size_t strip = kSliceLanes * hwy::Num0BitsBelowLS1Bit_Nonzero64(rest);
      const uint64_t bit = rest & (~rest + 1);
      if ((row.hiding & bit) == 0) {  // Most groups have one surface per pixel.
        SelectGroup<false>(row, slice, strip, from.count, plane, out, bit, &covers);
      } else {
        SelectGroup<true>(row, slice, strip, from.count, plane, out, bit, &covers);
      }
    }
    cover[y] = covers;
    if (covers.some == 0) continue;
    for (uint64_t rest = written & ~covers.some; rest != 0; rest &= rest - 1) {
      int16_t* to = out + kSliceLanes * hwy::Num0BitsBelowLS1Bit_Nonzero64(rest);
      for (size_t c = 0; c < 4; ++c, to += plane) {
        for (size_t n = 0; n < kSliceLanes; n += hn::Lanes(d16)) {
          hn::StoreU(hn::Zero(d16), d16, to + n);
        }
      }
    }
  }
}

// Implements SpreadSlice for taps with a reach of kReach.
template <int32_t kReach>
HWY_INLINE void SpreadBy(const int16_t* const* rows, const SliceTaps& taps, size_t count,
                         int16_t* HWY_RESTRICT out) {
  const LanesTag d16;
  const hn::RebindToUnsigned<decltype(d16)> du16;
  const size_t lanes = hn::Lanes(d16), whole = SliceSamples(count);
  const auto centre = hn::Set(d16, taps.centre), inner = hn::Set(d16, taps.inner),
             outer = hn::Set(d16, taps.outer);
  const int16_t* at[2 * kReach + 1];
  for (int32_t k = 0; k <= 2 * kReach; ++k) at[k] = rows[k];
  for (size_t n = 0; n < whole; n += lanes) {
    const auto mean = [&](int32_t k) HWY_ATTR {
      const auto before = hn::LoadU(d16, at[kReach - k] + n);
      const auto after = hn::LoadU(d16, at[kReach + k] + n);
      return hn::BitCast(d16,
                         hn::AverageRound(hn::BitCast(du16, before), hn::BitCast(du16, after)));
    };
    auto sum = hn::MulFixedPoint15(hn::LoadU(d16, at[kReach] + n), centre);
    for (int32_t k = 1; k < kReach; ++k) {
      sum = hn::SaturatedAdd(sum, hn::MulFixedPoint15(mean(k), inner));
    }
    sum = hn::SaturatedAdd(sum, hn::MulFixedPoint15(mean(kReach), outer));
    hn::StoreU(sum, d16, out + n);
  }
}

inline void SpreadSlice(const int16_t* const* rows, const SliceTaps& taps, size_t count,
                        int16_t* HWY_RESTRICT out) {
  static_assert(kMaxSpread == 3, "SpreadSlice must handle every reach up to kMaxSpread");
  if (taps.reach == 1) return SpreadBy<1>(rows, taps, count, out);
  if (taps.reach == 2) return SpreadBy<2>(rows, taps, count, out);
  SpreadBy<3>(rows, taps, count, out);
}

}  // namespace HWY_NAMESPACE
}  // namespace starfocus::simd
HWY_AFTER_NAMESPACE();
