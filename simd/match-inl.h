// SPDX-License-Identifier: Apache-2.0
// Vector code of match.h. Included once per target.
#if defined(STARFOCUS_SIMD_MATCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STARFOCUS_SIMD_MATCH_INL_H_
#undef STARFOCUS_SIMD_MATCH_INL_H_
#else
#define STARFOCUS_SIMD_MATCH_INL_H_
#endif

#include "simd/chunk-inl.h"
#include "simd/match.h"

HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

using MatchTag = hn::RebindToUnsigned<ChunkTag>;
using MatchVec = hn::Vec<MatchTag>;
using MatchBytes = hn::Rebind<uint8_t, MatchTag>;

HWY_INLINE MatchVec LoadWide(const uint8_t* at) {
  return hn::PromoteTo(MatchTag(), hn::LoadU(MatchBytes(), at));
}

HWY_INLINE void StoreNarrow(MatchVec values, uint8_t* at) {
  const hn::RebindToSigned<MatchTag> d16;
  hn::StoreU(hn::DemoteTo(MatchBytes(), hn::BitCast(d16, values)), MatchBytes(), at);
}

// Returns what lies `part` 128ths of the way from a to b.
HWY_INLINE MatchVec Between(MatchVec a, MatchVec b, int32_t part) {
  const MatchTag du16;
  const auto first = hn::Set(du16, static_cast<uint16_t>(128 - part));
  const auto second = hn::Set(du16, static_cast<uint16_t>(part));
  const auto sum = hn::Add(hn::Mul(a, first), hn::Mul(b, second));
  return hn::ShiftRight<7>(hn::Add(sum, hn::Set(du16, uint16_t{64})));
}

// Returns the view at n for whole or broken moves; the compiler leaves out what is not needed.
template <bool kAcross, bool kDown>
HWY_INLINE MatchVec SampleView(const uint8_t* view, const MatchRow& row) {
  const size_t stride = row.view_stride;
  auto left = LoadWide(view);
  if (kDown) left = Between(left, LoadWide(view + stride), row.down);
  if (!kAcross) return left;
  auto right = LoadWide(view + 1);
  if (kDown) right = Between(right, LoadWide(view + stride + 1), row.down);
  return Between(left, right, row.across);
}

template <bool kAcross, bool kDown>
HWY_INLINE void MatchMoved(const MatchRow& row, size_t count, uint8_t* HWY_RESTRICT difference) {
  const MatchTag du16;
  const auto most = hn::Set(du16, uint16_t{kMostDifference});
  for (size_t n = 0; n < count; n += hn::Lanes(du16)) {
    auto sum = hn::Zero(du16);
    for (int c = 0; c < 3; ++c) {
      const auto view = SampleView<kAcross, kDown>(row.view[c] + n, row);
      const auto centre = LoadWide(row.centre[c] + n);
      sum = hn::Add(sum, hn::Sub(hn::Max(view, centre), hn::Min(view, centre)));
    }
    StoreNarrow(hn::Min(sum, most), difference + n);
  }
}

inline void MatchView(const MatchRow& row, size_t count, uint8_t* HWY_RESTRICT difference) {
  if (row.across == 0) {
    if (row.down == 0) return MatchMoved<false, false>(row, count, difference);
    return MatchMoved<false, true>(row, count, difference);
  }
  if (row.down == 0) return MatchMoved<true, false>(row, count, difference);
  MatchMoved<true, true>(row, count, difference);
}

inline void StandIn(const int16_t* HWY_RESTRICT highest_a, const int16_t* HWY_RESTRICT highest_b,
                    int16_t limit, size_t count, uint8_t* HWY_RESTRICT a, uint8_t* HWY_RESTRICT b) {
  const ChunkTag d16;
  const MatchTag du16;
  const auto most = hn::Set(d16, limit);
  const auto unknown = hn::Set(d16, int16_t{kUnknownDifference});
  for (size_t n = 0; n < count; n += hn::Lanes(d16)) {
    const auto hidden_a = hn::Gt(hn::LoadU(d16, highest_a + n), most);
    const auto hidden_b = hn::Gt(hn::LoadU(d16, highest_b + n), most);
    if (hn::AllFalse(d16, hn::Or(hidden_a, hidden_b))) continue;
    const auto of_a = hn::BitCast(d16, LoadWide(a + n)), of_b = hn::BitCast(d16, LoadWide(b + n));
    const auto both = hn::And(hidden_a, hidden_b);
    const auto new_a = hn::IfThenElse(hidden_a, of_b, of_a);
    const auto new_b = hn::IfThenElse(hidden_b, of_a, of_b);
    StoreNarrow(hn::BitCast(du16, hn::IfThenElse(both, unknown, new_a)), a + n);
    StoreNarrow(hn::BitCast(du16, hn::IfThenElse(both, unknown, new_b)), b + n);
  }
}

inline void LimitHidden(const int16_t* const* highest, int16_t limit, size_t views, size_t count,
                        uint8_t* const* differences) {
  const ChunkTag d16;
  const auto bound = hn::Set(d16, limit);
  const auto of_hidden = hn::Set(d16, int16_t{kHiddenDifference});
  const auto of_unseen = hn::Set(d16, int16_t{kUnseenDifference});
  for (size_t n = 0; n < count; n += hn::Lanes(d16)) {
    auto least = hn::LoadU(d16, highest[0] + n), most = least;
    for (size_t k = 1; k < views; ++k) {
      const auto value = hn::LoadU(d16, highest[k] + n);
      least = hn::Min(least, value);
      most = hn::Max(most, value);
    }
    if (hn::AllFalse(d16, hn::Gt(most, bound))) continue;
    const auto at_most = hn::IfThenElse(hn::Gt(least, bound), of_unseen, of_hidden);
    for (size_t k = 0; k < views; ++k) {
      const auto hidden = hn::Gt(hn::LoadU(d16, highest[k] + n), bound);
      const auto known = hn::BitCast(d16, LoadWide(differences[k] + n));
      const auto limited = hn::IfThenElse(hidden, hn::Min(known, at_most), known);
      StoreNarrow(hn::BitCast(MatchTag(), limited), differences[k] + n);
    }
  }
}

HWY_INLINE MatchVec ArmAt(const uint8_t* const* differences, size_t arms, size_t rings, size_t k,
                          size_t n) {
  const auto outer = LoadWide(differences[k] + n);
  return rings == 1 ? outer : hn::Add(outer, LoadWide(differences[arms + k] + n));
}

inline void LeastSide(const uint8_t* const* differences, size_t arms, size_t rings, size_t count,
                      uint8_t* HWY_RESTRICT cost) {
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

inline void MeanCost(const uint8_t* const* differences, size_t views, size_t count,
                     uint8_t* HWY_RESTRICT cost) {
  const MatchTag du16;
  for (size_t n = 0; n < count; n += hn::Lanes(du16)) {
    auto sum = hn::Zero(du16);
    for (size_t k = 0; k < views; ++k) sum = hn::Add(sum, LoadWide(differences[k] + n));
    if (views == 8) sum = hn::ShiftRight<1>(sum);
    if (views == 16) sum = hn::ShiftRight<2>(sum);
    StoreNarrow(sum, cost + n);
  }
}

using reference::GatherLabels;

}  // namespace HWY_NAMESPACE
}  // namespace starfocus::simd
HWY_AFTER_NAMESPACE();

#endif
