// Vector code of slices.h. Included once per target.
#if defined(STARFOCUS_SIMD_SLICES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STARFOCUS_SIMD_SLICES_INL_H_
#undef STARFOCUS_SIMD_SLICES_INL_H_
#else
#define STARFOCUS_SIMD_SLICES_INL_H_
#endif

#include "simd/chunk-inl.h"
#include "simd/slices.h"

HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

inline SliceCover SelectSlice(const SurfaceRow& row, const SliceRange& range, size_t count,
                              size_t plane, int16_t* HWY_RESTRICT out) {
  const ChunkTag d16;
  const hn::Rebind<uint8_t, decltype(d16)> d8;
  const size_t lanes = hn::Lanes(d16);
  const auto low = hn::Set(d16, range.low), high = hn::Set(d16, range.high);
  const auto overlap = hn::Set(d16, range.overlap);
  const auto pixel = hn::Set(d16, kSliceWhole);
  const auto byte = [&](const uint8_t* at)
                        HWY_ATTR { return hn::PromoteTo(d16, hn::LoadU(d8, at)); };
  const auto inside = [&](const int16_t* at) HWY_ATTR {
    const auto disparity = hn::LoadU(d16, at);
    return hn::Not(hn::Or(hn::Lt(disparity, low), hn::Gt(disparity, overlap)));
  };
  SliceCover cover = {0, 0};
  uint64_t bit = 1;
  for (size_t chunk = 0; chunk < count; chunk += kSliceLanes, bit <<= 1) {
    bool some = false, all = true;
    if ((row.hiding & bit) == 0) {  // most
      for (size_t n = chunk; n < chunk + kSliceLanes; n += lanes) {
        const auto found = inside(row.disparity[0] + n);
        if (hn::AllFalse(d16, found)) {
          for (size_t c = 0; c < 4; ++c) hn::StoreU(hn::Zero(d16), d16, out + c * plane + n);
          all = all && n >= count;
          continue;
        }
        for (size_t c = 0; c < 3; ++c) {
          const auto value = hn::ShiftLeft<kSliceBits>(byte(row.rgb[0] + c * row.plane + n));
          hn::StoreU(hn::IfThenElseZero(found, value), d16, out + c * plane + n);
        }
        hn::StoreU(hn::IfThenElseZero(found, hn::Set(d16, kSliceOne)), d16, out + 3 * plane + n);
        const auto counted = hn::FirstN(d16, n < count ? count - n : 0);
        some = some || !hn::AllFalse(d16, hn::And(found, counted));
        all = all && hn::AllFalse(d16, hn::AndNot(found, counted));
      }
      if (some) cover.some |= bit;
      if (all) cover.all |= bit;
      continue;
    }
    for (size_t n = chunk; n < chunk + kSliceLanes; n += lanes) {
      const auto nearest = inside(row.disparity[0] + n), next = inside(row.disparity[1] + n);
      const auto last = inside(row.disparity[2] + n);
      int16_t* to = out + n;
      if (hn::AllFalse(d16, hn::Or(nearest, hn::Or(next, last)))) {  // most
        for (size_t c = 0; c < 4; ++c) hn::StoreU(hn::Zero(d16), d16, to + c * plane);
        all = all && n >= count;
        continue;
      }
      const auto share = byte(row.share + n);
      const auto twice =
          hn::And(hn::Ne(share, pixel), hn::Gt(hn::LoadU(d16, row.disparity[0] + n), high));
      const auto first = hn::AndNot(twice, nearest);
      const auto front = hn::IfThenElseZero(first, hn::Min(share, pixel));
      const auto behind = hn::IfThenElseZero(hn::Or(next, last), hn::Sub(pixel, front));
      const auto together = hn::Add(front, behind);
      const auto counted = hn::FirstN(d16, n < count ? count - n : 0);
      const auto found = hn::Ne(together, hn::Zero(d16));
      some = some || !hn::AllFalse(d16, hn::And(found, counted));
      all = all && hn::AllFalse(d16, hn::And(hn::Ne(together, pixel), counted));
      for (size_t c = 0; c < 3; ++c) {
        const size_t at = c * row.plane + n;
        // Where there is no surface its colours were never written; valgrind follows masks, but not
        // products with zero.
        const auto deepest = hn::IfThenElseZero(last, byte(row.rgb[2] + at));
        const auto hidden = hn::IfThenElse(next, byte(row.rgb[1] + at), deepest);
        const auto value = hn::Add(hn::Mul(byte(row.rgb[0] + at), front), hn::Mul(hidden, behind));
        hn::StoreU(value, d16, to + c * plane);
      }
      // 2^8 of them are kSliceOne, and one more of the whole pixel.
      const auto covered =
          hn::Sub(hn::ShiftLeft<8>(together), hn::ShiftRight<kSliceBits>(together));
      hn::StoreU(covered, d16, to + 3 * plane);
    }
    if (some) cover.some |= bit;
    if (all) cover.all |= bit;
  }
  return cover;
}

inline void SpreadSlice(const int16_t* HWY_RESTRICT in, ptrdiff_t step, const SliceTaps& taps,
                        size_t count, int16_t* HWY_RESTRICT out) {
  const ChunkTag d16;
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
    for (int32_t k = 1; k < taps.reach; ++k) {
      sum = hn::SaturatedAdd(sum, hn::MulFixedPoint15(mean(k * step), inner));
    }
    sum = hn::SaturatedAdd(sum, hn::MulFixedPoint15(mean(taps.reach * step), outer));
    hn::StoreU(sum, d16, out + n);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace starfocus::simd
HWY_AFTER_NAMESPACE();

#endif
