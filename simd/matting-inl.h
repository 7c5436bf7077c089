// SPDX-License-Identifier: Apache-2.0
// Vector code of the functions in matting.h. This file is included once per SIMD target.
#if defined(STARFOCUS_SIMD_MATTING_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STARFOCUS_SIMD_MATTING_INL_H_
#undef STARFOCUS_SIMD_MATTING_INL_H_
#else
#define STARFOCUS_SIMD_MATTING_INL_H_
#endif

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
    const auto here = hn::LoadU(d16, row + n), zero = hn::Zero(d16);
    auto found = here, distance = zero;
    for (int32_t k = 0; k < BeyondOffsets::kCount; ++k) {
      const auto there =
          hn::LoadU(d16, row + n + kBeyondOffsets.y[k] * stride + kBeyondOffsets.x[k]);
      const auto own = hn::Set(d16, int16_t{kBeyondOffsets.square[k]});
      const auto larger = hn::And(hn::Eq(distance, own), hn::Gt(there, found));
      const auto better = hn::Or(hn::Eq(distance, zero), larger);
      const auto takes = hn::AndNot(IsWithin(hn::SaturatedSub(there, here), step), better);
      found = hn::IfThenElse(takes, there, found);
      distance = hn::IfThenElse(takes, own, distance);
    }
    hn::StoreU(found, d16, beyond + n);
    hn::StoreU(distance, d16, square + n);
  }
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

// Masks of the columns and rows of the window for each pixel of the block. A mask is all ones if
// the column or row is out of reach of the pixel, and 0 otherwise.
struct OutOfReach {
  uint16_t column[kColourWindow][kSliceLanes], row[kColourWindow][kSliceLanes];

  constexpr OutOfReach() : column(), row() {
    for (int k = 0; k < kColourWindow; ++k) {
      for (int n = 0; n < static_cast<int>(kSliceLanes); ++n) {
        const int across = k - n % kColourBlock, down = k - n / kColourBlock;
        column[k][n] = across < 0 || across > 2 * kColourReach ? UINT16_MAX : 0;
        row[k][n] = down < 0 || down > 2 * kColourReach ? UINT16_MAX : 0;
      }
    }
  }
};

inline void CompareColours(const ColourSample* HWY_RESTRICT window, size_t stride,
                           uint16_t* HWY_RESTRICT least) {
  static constexpr OutOfReach kOut;
  const LanesTag d16;
  const hn::RebindToUnsigned<LanesTag> du16;
  // Colours of the 16 pixels of the block, one array for each member of ColourSample.
  int16_t sums[kSliceLanes], red_greens[kSliceLanes], green_blues[kSliceLanes];
  const ColourSample* block = window + kColourReach * (stride + 1);
  for (size_t n = 0; n < kSliceLanes; ++n) {
    const ColourSample& sample = block[n / kColourBlock * stride + n % kColourBlock];
    sums[n] = sample.sum;
    red_greens[n] = sample.red_green;
    green_blues[n] = sample.green_blue;
  }
  for (size_t n = 0; n < kSliceLanes; n += hn::Lanes(d16)) {
    const auto sum = hn::LoadU(d16, sums + n);
    const auto red_green = hn::LoadU(d16, red_greens + n);
    const auto green_blue = hn::LoadU(d16, green_blues + n);
    const ColourSample* row = window;
    for (int32_t y = 0; y < kColourWindow; ++y, row += stride) {
      const auto row_out = hn::LoadU(du16, kOut.row[y] + n);
      for (int32_t x = 0; x < kColourWindow; ++x) {
        const ColourSample& other = row[x];
        if (other.key == kNoColourKey) continue;
        const auto brightness = hn::Abs(hn::Sub(sum, hn::Set(d16, other.sum)));
        const auto a = hn::Sub(red_green, hn::Set(d16, other.red_green));
        const auto b = hn::Sub(green_blue, hn::Set(d16, other.green_blue));
        const auto hue = hn::Add(hn::Add(hn::Abs(a), hn::Abs(b)), hn::Abs(hn::Add(a, b)));
        const auto difference = hn::Min(hn::Add(hn::ShiftRight<2>(brightness), hue),
                                        hn::Set(d16, kMostColourDifference));
        const auto key = hn::Add(hn::BitCast(du16, hn::ShiftLeft<kColourKeyBits>(difference)),
                                 hn::Set(du16, other.key));
        const auto out = hn::Or(row_out, hn::LoadU(du16, kOut.column[x] + n));
        uint16_t* of_group = least + other.place + n;
        hn::StoreU(hn::Min(hn::LoadU(du16, of_group), hn::Or(key, out)), du16, of_group);
      }
    }
  }
}

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
      smooth[n + k] = SmoothMean(disparities[k], weights[k]);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace starfocus::simd
HWY_AFTER_NAMESPACE();

#endif
