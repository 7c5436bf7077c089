// SPDX-License-Identifier: Apache-2.0
// Vector code of the functions in match.h. This file is included once per SIMD target.
#include "simd/highway-inl.h"
#include "simd/match.h"

HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

using MatchTag = hn::RebindToUnsigned<LanesTag>;
using MatchVec = hn::Vec<MatchTag>;

HWY_INLINE void StoreNarrow(MatchVec values, uint8_t* at) {
  const hn::RebindToSigned<MatchTag> d16;
  StoreBytes(d16, hn::BitCast(d16, values), at);
}

inline void DeinterleaveRow(const uint8_t* HWY_RESTRICT rgb, size_t count, size_t stride,
                            uint8_t* HWY_RESTRICT plane) {
  const hn::CappedTag<uint8_t, kSliceLanes> d8;
  const bool done = SplitColours(d8, rgb, count, stride, plane);
  if (!done) reference::DeinterleaveRow(rgb, count, stride, plane);
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
    auto value = LoadBytes(MatchTag(), row + n);
    if (kDown) value = Between(value, LoadBytes(MatchTag(), next + n), down);
    if (kAcross) {
      auto right = LoadBytes(MatchTag(), row + n + 1);
      if (kDown) right = Between(right, LoadBytes(MatchTag(), next + n + 1), down);
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

// Number of pixels that are matched at a time. On ARM, vectors are limited to 16 bytes. With the
// 32-byte vectors of SVE_256, GCC 12 and Highway 1.0.3 compute costs that differ from the
// reference.
inline constexpr size_t kMatchPixels = 32;
using ByteTag = hn::CappedTag<uint8_t, HWY_ARCH_ARM_A64 ? 16 : kMatchPixels>;

HWY_INLINE void MatchView(const uint8_t* centre, const uint8_t* view, size_t plane, size_t count,
                          uint8_t* HWY_RESTRICT difference) {
  const ByteTag d8;
  const auto most = hn::Set(d8, uint8_t{kMostDifference});
  for (size_t n = 0; n < count; n += hn::Lanes(d8)) {
    const auto sum = ColourDistance(d8, centre + n, view + n, plane);
    hn::StoreU(hn::Min(sum, most), d8, difference + n);
  }
}

// Returns a mask of the lanes in which the label is hidden.
HWY_INLINE hn::Mask<ByteTag> IsHidden(hn::Vec<ByteTag> hidden, hn::Vec<ByteTag> after_label) {
  return hn::Eq(hn::Max(hidden, after_label), hidden);
}

HWY_INLINE void StandIn(const uint8_t* HWY_RESTRICT hidden_a, const uint8_t* HWY_RESTRICT hidden_b,
                        uint8_t label, size_t count, uint8_t* HWY_RESTRICT a,
                        uint8_t* HWY_RESTRICT b) {
  const ByteTag d8;
  const auto after_label = hn::Set(d8, static_cast<uint8_t>(label + 1));
  const auto unknown = hn::Set(d8, uint8_t{kUnknownDifference});
  for (size_t n = 0; n < count; n += hn::Lanes(d8)) {
    const auto by_a = IsHidden(hn::LoadU(d8, hidden_a + n), after_label);
    const auto by_b = IsHidden(hn::LoadU(d8, hidden_b + n), after_label);
    if (hn::AllFalse(d8, hn::Or(by_a, by_b))) continue;
    const auto of_a = hn::LoadU(d8, a + n), of_b = hn::LoadU(d8, b + n);
    const auto both = hn::And(by_a, by_b);
    hn::StoreU(hn::IfThenElse(both, unknown, hn::IfThenElse(by_a, of_b, of_a)), d8, a + n);
    hn::StoreU(hn::IfThenElse(both, unknown, hn::IfThenElse(by_b, of_a, of_b)), d8, b + n);
  }
}

HWY_INLINE void LimitHidden(const uint8_t* const* hidden, uint8_t label, size_t views, size_t count,
                            uint8_t* const* differences) {
  const ByteTag d8;
  const auto after_label = hn::Set(d8, static_cast<uint8_t>(label + 1));
  const auto of_hidden = hn::Set(d8, uint8_t{kHiddenDifference});
  const auto of_unseen = hn::Set(d8, uint8_t{kUnseenDifference});
  for (size_t n = 0; n < count; n += hn::Lanes(d8)) {
    auto least = hn::LoadU(d8, hidden[0] + n), most = least;
    for (size_t k = 1; k < views; ++k) {
      const auto value = hn::LoadU(d8, hidden[k] + n);
      least = hn::Min(least, value);
      most = hn::Max(most, value);
    }
    if (hn::AllFalse(d8, IsHidden(most, after_label))) continue;
    const auto at_most = hn::IfThenElse(IsHidden(least, after_label), of_unseen, of_hidden);
    for (size_t k = 0; k < views; ++k) {
      const auto by = IsHidden(hn::LoadU(d8, hidden[k] + n), after_label);
      const auto known = hn::LoadU(d8, differences[k] + n);
      hn::StoreU(hn::IfThenElse(by, hn::Min(known, at_most), known), d8, differences[k] + n);
    }
  }
}

HWY_INLINE MatchVec ArmAt(const uint8_t* const* differences, size_t arms, size_t rings, size_t k,
                          size_t n) {
  const auto outer = LoadBytes(MatchTag(), differences[k] + n);
  return rings == 1 ? outer : hn::Add(outer, LoadBytes(MatchTag(), differences[arms + k] + n));
}

// LeastSide for four views: the cost is twice the sum of two differences, which is equal to (3 *
// 171 * sum) >> 8.
HWY_INLINE void LeastSideOfFour(const uint8_t* const* differences, size_t count,
                                uint8_t* HWY_RESTRICT cost) {
  const ByteTag d8;
  for (size_t n = 0; n < count; n += hn::Lanes(d8)) {
    const auto a = hn::LoadU(d8, differences[0] + n), b = hn::LoadU(d8, differences[1] + n);
    const auto c = hn::LoadU(d8, differences[2] + n), d = hn::LoadU(d8, differences[3] + n);
    const auto least =
        hn::Min(hn::Min(hn::Add(a, b), hn::Add(b, c)), hn::Min(hn::Add(c, d), hn::Add(d, a)));
    hn::StoreU(hn::Add(least, least), d8, cost + n);
  }
}

HWY_INLINE void LeastSide(const uint8_t* const* differences, size_t arms, size_t rings,
                          size_t count, uint8_t* HWY_RESTRICT cost) {
  if (arms * rings == 4) return LeastSideOfFour(differences, count, cost);
  const MatchTag du16;
  const int scale = (rings == 1 ? (arms == 4 ? 3 : 2) : 1) * 171;
  const auto factor = hn::Set(du16, static_cast<uint16_t>(scale));
  for (size_t n = 0; n < count; n += hn::Lanes(du16)) {
    const auto first = ArmAt(differences, arms, rings, 0, n);
    const auto second = ArmAt(differences, arms, rings, 1, n);
    auto before = first, here = second;
    auto least = hn::Set(du16, uint16_t{UINT16_MAX});
    for (size_t k = 2; k < arms + 2; ++k) {
      const auto next = k < arms    ? ArmAt(differences, arms, rings, k, n)
                        : k == arms ? first
                                    : second;
      const auto pair = hn::Add(before, here);
      least = hn::Min(least, arms == 4 ? pair : hn::Add(pair, next));
      before = here;
      here = next;
    }
    StoreNarrow(hn::ShiftRight<8>(hn::Mul(least, factor)), cost + n);
  }
}

HWY_INLINE void SumOfFour(const uint8_t* const* differences, size_t count,
                          uint8_t* HWY_RESTRICT cost) {
  const ByteTag d8;
  for (size_t n = 0; n < count; n += hn::Lanes(d8)) {
    auto sum = hn::LoadU(d8, differences[0] + n);
    for (size_t k = 1; k < 4; ++k) sum = hn::Add(sum, hn::LoadU(d8, differences[k] + n));
    hn::StoreU(sum, d8, cost + n);
  }
}

HWY_INLINE void MeanCost(const uint8_t* const* differences, size_t views, size_t count,
                         uint8_t* HWY_RESTRICT cost) {
  if (views == 4) return SumOfFour(differences, count, cost);
  const MatchTag du16;
  for (size_t n = 0; n < count; n += hn::Lanes(du16)) {
    auto sum = hn::Zero(du16);
    for (size_t k = 0; k < views; ++k)
      sum = hn::Add(sum, LoadBytes(MatchTag(), differences[k] + n));
    if (views == 8) sum = hn::ShiftRight<1>(sum);
    if (views == 16) sum = hn::ShiftRight<2>(sum);
    StoreNarrow(sum, cost + n);
  }
}

// Returns the mean cost of the views in `mask` that see the pixels from pixel n on. The result is
// UINT16_MAX at pixels that no view in `mask` sees.
HWY_INLINE MatchVec SeenMean(const uint8_t* const* differences, const uint8_t* const* hidden,
                             uint8_t label, uint32_t mask, size_t n) {
  const MatchTag du16;
  const auto one = hn::Set(du16, uint16_t{1}), last = hn::Set(du16, uint16_t{label});
  auto sum = hn::Zero(du16), seen = sum;
  size_t views = 0;
  for (size_t k = 0; mask >> k != 0; ++k) {
    if ((mask >> k & 1) == 0) continue;
    ++views;
    const auto difference = LoadBytes(MatchTag(), differences[k] + n);
    if (hidden == nullptr) {
      sum = hn::Add(sum, difference);
      seen = hn::Add(seen, one);
      continue;
    }
    const auto behind = LoadBytes(MatchTag(), hidden[k] + n);
    const auto sees = hn::Eq(hn::Min(behind, last), behind);
    sum = hn::Add(sum, hn::IfThenElseZero(sees, difference));
    seen = hn::Add(seen, hn::IfThenElseZero(sees, one));
  }
  auto mean = hn::Set(du16, uint16_t{UINT16_MAX});
  for (size_t k = hidden == nullptr ? views : 1; k <= views; ++k) {
    const auto factor = hn::Set(du16, static_cast<uint16_t>(MeanFactor(k)));
    const auto is_count = hn::Eq(seen, hn::Set(du16, static_cast<uint16_t>(k)));
    mean = hn::IfThenElse(is_count, hn::ShiftRight<8>(hn::Mul(sum, factor)), mean);
  }
  return mean;
}

HWY_INLINE void SeenCost(const uint8_t* const* differences, const uint8_t* const* hidden,
                         uint8_t label, const uint16_t* sides, size_t side_count, size_t count,
                         uint8_t* HWY_RESTRICT cost) {
  const MatchTag du16;
  const auto none = hn::Set(du16, uint16_t{UINT16_MAX});
  const auto unknown = hn::Set(du16, uint16_t{kUnknownDifference * kCostScale});
  const auto most = hn::Set(du16, uint16_t{kMostDifference * kCostScale});
  for (size_t n = 0; n < count; n += hn::Lanes(du16)) {
    auto least = none;
    for (size_t side = 0; side < side_count; ++side) {
      least = hn::Min(least, SeenMean(differences, hidden, label, sides[side], n));
    }
    least = hn::IfThenElse(hn::Eq(least, none), unknown, least);
    StoreNarrow(hn::Min(least, most), cost + n);
  }
}

#if HWY_TARGET != HWY_SCALAR
// Interleaves rows i, i + 4, i + 8 and i + 12 of a matrix of 16 rows. In the output rows 4 i to 4 i
// + 3, samples of one column are adjacent. Two such passes transpose the matrix.
HWY_INLINE void ShuffleFour(const uint8_t* HWY_RESTRICT rows, size_t stride, size_t count,
                            size_t to_stride, uint8_t* HWY_RESTRICT to) {
  const hn::CappedTag<uint8_t, kSliceLanes> d8;
  const auto a = hn::LoadU(d8, rows), b = hn::LoadU(d8, rows + 4 * stride);
  const auto c = hn::LoadU(d8, rows + 8 * stride), d = hn::LoadU(d8, rows + 12 * stride);
  const auto low_ac = hn::InterleaveLower(d8, a, c), high_ac = hn::InterleaveUpper(d8, a, c);
  const auto low_bd = hn::InterleaveLower(d8, b, d), high_bd = hn::InterleaveUpper(d8, b, d);
  if (count > 0) hn::StoreU(hn::InterleaveLower(d8, low_ac, low_bd), d8, to);
  if (count > 1) hn::StoreU(hn::InterleaveUpper(d8, low_ac, low_bd), d8, to + to_stride);
  if (count > 2) hn::StoreU(hn::InterleaveLower(d8, high_ac, high_bd), d8, to + 2 * to_stride);
  if (count > 3) hn::StoreU(hn::InterleaveUpper(d8, high_ac, high_bd), d8, to + 3 * to_stride);
}
#endif

// Transposes costs. Each input row contains the costs of one label at kMatchPixels pixels. Each
// output row contains the costs of kSliceLanes labels at one pixel; output rows are `places` apart.
HWY_INLINE void GatherLabels(const uint8_t* HWY_RESTRICT rows, size_t count,
                             uint8_t* HWY_RESTRICT pixels, size_t places) {
#if HWY_TARGET == HWY_SCALAR
  for (size_t n = 0; n < count; ++n) {
    for (size_t k = 0; k < kSliceLanes; ++k) pixels[n * places + k] = rows[k * kMatchPixels + n];
  }
#else
  for (size_t n = 0; n < count; n += kSliceLanes) {
    uint8_t half[kSliceLanes * kSliceLanes];
    for (size_t i = 0; i < 4; ++i) {
      ShuffleFour(rows + n + i * kMatchPixels, kMatchPixels, 4, kSliceLanes,
                  half + 4 * i * kSliceLanes);
    }
    for (size_t i = 0; i < 4 && n + 4 * i < count; ++i) {
      ShuffleFour(half + i * kSliceLanes, kSliceLanes, count - n - 4 * i, places,
                  pixels + (n + 4 * i) * places);
    }
  }
#endif
}

// Replaces or limits the differences of views that do not show the pixels at the disparity of
// `label`. hidden[k] is the number of hidden labels of the first pixel in view k.
HWY_INLINE void ChangeHidden(const LabelRow& row, const uint8_t* const* hidden, uint8_t label,
                             uint8_t* const* differences) {
  const size_t views = row.views, half = row.arms / 2;
  if (!row.limits || row.ends) {
    const uint8_t last = row.limits ? uint8_t{kViewEnds - 1} : label;
    for (size_t k = 0; k < views; ++k) {
      if (k % row.arms >= half) continue;
      StandIn(hidden[k], hidden[k + half], last, kMatchPixels, differences[k],
              differences[k + half]);
    }
  }
  if (row.limits) LimitHidden(hidden, label, views, kMatchPixels, differences);
}

inline void CostLabels(const LabelRow& row, size_t count, size_t places,
                       uint8_t* HWY_RESTRICT cost) {
  const size_t views = row.views;
  // Colour differences between each side view and the centre view, at kMatchPixels pixels.
  uint8_t values[kMostMatched][kMatchPixels];
  uint8_t* differences[kMostMatched];
  for (size_t k = 0; k < views; ++k) differences[k] = values[k];
  uint8_t costs[kSliceLanes][kMatchPixels] = {};
  for (size_t n = 0; n < count; n += kMatchPixels) {
    const uint8_t* pixels = row.pixels + n;
    const size_t left = count - n;
    for (size_t l = 0; l < row.labels; ++l) {
      const ViewMove* moves = row.moves + l * views;
      for (size_t k = 0; k < views; ++k) {
        MatchView(pixels, pixels + moves[k].at, row.plane, kMatchPixels, differences[k]);
      }
      const auto label = static_cast<uint8_t>(l);
      const uint8_t* hidden[kMostMatched] = {};
      if (row.hidden != nullptr) {
        for (size_t k = 0; k < views; ++k) hidden[k] = row.hidden + n + moves[k].hidden;
        if (row.side_count == 0) ChangeHidden(row, hidden, label, differences);
      }
      uint8_t* here = costs[l % kSliceLanes];
      if (row.side_count > 0) {
        SeenCost(differences, row.hidden == nullptr ? nullptr : hidden, label, row.sides,
                 row.side_count, kMatchPixels, here);
      } else if (row.one_side) {
        LeastSide(differences, row.arms, row.rings, kMatchPixels, here);
      } else {
        MeanCost(differences, views, kMatchPixels, here);
      }
      if (l % kSliceLanes + 1 < kSliceLanes && l + 1 < row.labels) continue;
      uint8_t* of_pixel = cost + n * places + l / kSliceLanes * kSliceLanes;
      GatherLabels(costs[0], left < kMatchPixels ? left : kMatchPixels, of_pixel, places);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace starfocus::simd
HWY_AFTER_NAMESPACE();
