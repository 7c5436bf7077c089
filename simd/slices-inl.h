// The kernels of slices: select_slice, spread_slice, shift_slice, composite. Included once per
// target.
#if defined(STARFOCUS_SIMD_SLICES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STARFOCUS_SIMD_SLICES_INL_H_
#undef STARFOCUS_SIMD_SLICES_INL_H_
#else
#define STARFOCUS_SIMD_SLICES_INL_H_
#endif

#include "simd/compat-inl.h"
#include "simd/kernels.h"

HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

// Wider vectors would hold more than a narrow tile.
using SliceTag = hn::CappedTag<int16_t, kSliceLanes>;

HWY_INLINE SliceCover SelectPixels(const SurfaceRow& row, const SliceRange& range, size_t count,
                                   size_t plane, int16_t* HWY_RESTRICT out) {
  const SliceTag d16;
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
    for (size_t n = chunk; n < chunk + kSliceLanes; n += lanes) {
      const auto next = inside(row.disparity[1] + n), last = inside(row.disparity[2] + n);
      const auto share = byte(row.share + n);
      const auto twice =
          hn::And(hn::Ne(share, pixel), hn::Gt(hn::LoadU(d16, row.disparity[0] + n), high));
      const auto first = hn::AndNot(twice, inside(row.disparity[0] + n));
      const auto front = hn::IfThenElseZero(first, hn::Min(share, pixel));
      const auto behind = hn::IfThenElseZero(hn::Or(next, last), hn::Sub(pixel, front));
      const auto together = hn::Add(front, behind);
      const auto counted = hn::FirstN(d16, n < count ? count - n : 0);
      const auto found = hn::Ne(together, hn::Zero(d16));
      some = some || !hn::AllFalse(d16, hn::And(found, counted));
      all = all && hn::AllFalse(d16, hn::And(hn::Ne(together, pixel), counted));
      int16_t* to = out + n;
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

HWY_INLINE void SpreadSamplesOfSlice(const int16_t* HWY_RESTRICT in, ptrdiff_t step,
                                     const SliceTaps& taps, size_t count,
                                     int16_t* HWY_RESTRICT out) {
  const SliceTag d16;
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

HWY_INLINE void ShiftPlanes(const SlicePlanes& in, const SliceFraction& fraction, size_t rows,
                            size_t count, size_t plane, int16_t* HWY_RESTRICT out,
                            uint32_t* HWY_RESTRICT some) {
  const SliceTag d16;
  const size_t lanes = hn::Lanes(d16), whole = SliceSamples(count);
  const auto inside = hn::Set(d16, fraction.inside), edge = hn::Set(d16, fraction.edge);
  const int16_t* HWY_RESTRICT from = in.samples;
  for (size_t row = 0; row < rows; ++row, from += 4 * in.plane, out += 4 * plane) {
    uint32_t chunks = 0;
    for (size_t n = 0; n < whole; n += lanes) {
      const auto covered = hn::LoadU(d16, from + 3 * in.plane + n);
      const auto next = hn::LoadU(d16, from + 3 * in.plane + n + 1);
      if (hn::AllTrue(d16, hn::Eq(hn::Or(covered, next), hn::Zero(d16)))) {
        for (size_t c = 0; c < 4; ++c) hn::StoreU(hn::Zero(d16), d16, out + c * plane + n);
        continue;
      }
      const auto weight = hn::IfThenElse(hn::Eq(covered, next), inside, edge);
      const auto between = [&](auto value, auto other) HWY_ATTR {
        return hn::Add(other, hn::MulFixedPoint15(hn::Sub(other, value), weight));
      };
      for (size_t c = 0; c < 3; ++c) {
        const int16_t* at = from + c * in.plane + n;
        hn::StoreU(between(hn::LoadU(d16, at), hn::LoadU(d16, at + 1)), d16, out + c * plane + n);
      }
      const auto shown = between(covered, next);
      hn::StoreU(shown, d16, out + 3 * plane + n);
      const bool none = hn::AllTrue(d16, hn::Eq(shown, hn::Zero(d16)));
      chunks |= static_cast<uint32_t>(none ? 0 : 1) << (n / kSliceLanes);
    }
    some[row] = chunks;
  }
}

// Adds 16 bits to sums of 32.
HWY_INLINE void AddSums(hn::Vec<SliceTag> value, uint32_t* HWY_RESTRICT sums) {
  const hn::RebindToUnsigned<SliceTag> d16;
  const hn::CappedTag<uint32_t, kSliceLanes> d32;
  const hn::Rebind<uint16_t, decltype(d32)> part;
  uint16_t bits[kSliceLanes];
  hn::StoreU(hn::BitCast(d16, value), d16, bits);
  for (size_t n = 0; n < hn::Lanes(d16); n += hn::Lanes(d32)) {
    const auto more = hn::PromoteTo(d32, hn::LoadU(part, bits + n));
    hn::StoreU(hn::Add(hn::LoadU(d32, sums + n), more), d32, sums + n);
  }
}

// light / covered, where that is less than one: SliceShare.
HWY_INLINE hn::Vec<SliceTag> ShareOfLight(hn::Vec<SliceTag> covered, hn::Vec<SliceTag> light,
                                          hn::Vec<SliceTag> excess) {
  const SliceTag d16;
  const auto one = hn::Set(d16, kSliceOne);
  const auto open = hn::Sub(one, covered);
  const auto first = hn::MulFixedPoint15(excess, open);
  const auto second = hn::MulFixedPoint15(first, open);
  const auto taken = hn::SaturatedAdd(hn::SaturatedAdd(excess, first), second);
  const auto twice = hn::SaturatedAdd(light, light);
  return hn::Min(hn::Sub(one, taken), hn::SaturatedAdd(twice, twice));
}

using SliceVec = hn::Vec<SliceTag>;

// A slice's colours and coverage in a row of a view: `excess` is what it covers of the light more
// than is left, which it gives nothing for.
HWY_INLINE void TakeLight(SliceVec weight, SliceVec red, SliceVec green, SliceVec blue,
                          SliceVec covered, SliceVec excess, SliceVec& light, SliceVec& r,
                          SliceVec& g, SliceVec& b, SliceVec& a) {
  const SliceTag d16;
  const auto taken = hn::Sub(covered, excess);
  if (!hn::AllTrue(d16, hn::Eq(excess, hn::Zero(d16)))) {
    const auto over = hn::Gt(covered, light);
    const auto share = ShareOfLight(covered, light, excess);
    const auto lit = [&](SliceVec value) HWY_ATTR {
      return hn::IfThenElse(over, hn::MulFixedPoint15(value, share), value);
    };
    red = lit(red);
    green = lit(green);
    blue = lit(blue);
    covered = lit(covered);
  }
  light = hn::Sub(light, taken);
  r = hn::Add(r, hn::MulFixedPoint15(weight, red));
  g = hn::Add(g, hn::MulFixedPoint15(weight, green));
  b = hn::Add(b, hn::MulFixedPoint15(weight, blue));
  a = hn::Add(a, hn::MulFixedPoint15(weight, covered));
}

// Two rows at once: what lies between them is read for both.
HWY_INLINE void CompositeRows(const SliceViews& views, size_t row, size_t n, size_t plane,
                              bool second, uint32_t* HWY_RESTRICT sums) {
  const SliceTag d16;
  const size_t row_size = 4 * plane, offset = row * row_size + views.column + n;
  const uint32_t chunk = uint32_t{1} << (views.column / kSliceLanes);
  const auto zero = hn::Zero(d16), one = hn::Set(d16, kSliceOne);
  auto r0 = zero, g0 = zero, b0 = zero, a0 = zero, r1 = zero, g1 = zero, b1 = zero, a1 = zero;
  const SliceShift* shifts = views.shifts;
  for (size_t view = 0; view < views.count; ++view, shifts += views.slices) {
    const auto weight = hn::Set(d16, views.weights[view]);
    auto light0 = one, light1 = one;
    for (size_t k = 0; k < views.shown_count; ++k) {
      const SliceShift& shift = shifts[views.shown[k]];
      const uint32_t* some = shift.some + row;
      if (((some[0] | some[1] | some[2]) & chunk) == 0) continue;
      const int16_t* at = shift.samples + offset;
      const auto inside = hn::Set(d16, shift.fraction.inside);
      const auto edge = hn::Set(d16, shift.fraction.edge);
      const auto load = [&](size_t c) HWY_ATTR { return hn::LoadU(d16, at + c); };
      const auto between = [&](SliceVec value, SliceVec next, SliceVec fraction) HWY_ATTR {
        return hn::Add(next, hn::MulFixedPoint15(hn::Sub(next, value), fraction));
      };
      const size_t cover = 3 * plane;
      const auto above = load(cover), middle = load(cover + row_size);
      const auto below = load(cover + 2 * row_size);
      const auto fraction0 = hn::IfThenElse(hn::Eq(above, middle), inside, edge);
      const auto fraction1 = hn::IfThenElse(hn::Eq(middle, below), inside, edge);
      const auto covered0 = between(above, middle, fraction0);
      const auto covered1 = between(middle, below, fraction1);
      if (hn::AllTrue(d16, hn::Eq(hn::Or(covered0, covered1), zero))) continue;
      const auto red = load(row_size), green = load(plane + row_size);
      const auto blue = load(2 * plane + row_size);
      const auto excess0 = hn::Max(hn::Sub(covered0, light0), zero);
      TakeLight(weight, between(load(0), red, fraction0), between(load(plane), green, fraction0),
                between(load(2 * plane), blue, fraction0), covered0, excess0, light0, r0, g0, b0,
                a0);
      const auto excess1 = hn::Max(hn::Sub(covered1, light1), zero);
      TakeLight(weight, between(red, load(2 * row_size), fraction1),
                between(green, load(plane + 2 * row_size), fraction1),
                between(blue, load(2 * plane + 2 * row_size), fraction1), covered1, excess1, light1,
                r1, g1, b1, a1);
      if (hn::AllTrue(d16, hn::Eq(hn::Or(light0, light1), zero))) break;
    }
  }
  const auto add = [&](SliceVec r, SliceVec g, SliceVec b, SliceVec a, uint32_t* to) HWY_ATTR {
    AddSums(r, to);
    AddSums(g, to + plane);
    AddSums(b, to + 2 * plane);
    AddSums(a, to + 3 * plane);
  };
  add(r0, g0, b0, a0, sums + n);
  if (second) add(r1, g1, b1, a1, sums + row_size + n);
}

HWY_INLINE void CompositeViews(const SliceViews& views, size_t rows, size_t plane,
                               uint32_t* HWY_RESTRICT sums) {
  const size_t lanes = hn::Lanes(SliceTag());
  for (size_t y = 0; y < rows; y += 2, sums += 8 * plane) {
    for (size_t n = 0; n < kSliceLanes; n += lanes) {
      CompositeRows(views, views.row + y, n, plane, y + 1 < rows, sums);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace starfocus::simd
HWY_AFTER_NAMESPACE();

#endif
