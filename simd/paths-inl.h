// SPDX-License-Identifier: Apache-2.0
// Vector code of paths.h. Included once per target.
#if defined(STARFOCUS_SIMD_PATHS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STARFOCUS_SIMD_PATHS_INL_H_
#undef STARFOCUS_SIMD_PATHS_INL_H_
#else
#define STARFOCUS_SIMD_PATHS_INL_H_
#endif

#include "simd/chunk-inl.h"
#include "simd/paths.h"

HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

HWY_INLINE ChunkVec LoadCost(const uint8_t* at) {
  const ChunkTag d16;
  return hn::PromoteTo(d16, hn::LoadU(hn::Rebind<uint8_t, ChunkTag>(), at));
}

// What a pixel's path adds to the costs of labels from l on. The label before the first one is what
// lies before it in memory, and doesn't count.
HWY_INLINE ChunkVec OnwardFrom(const int16_t* before, size_t l, ChunkVec least, ChunkVec jump) {
  const ChunkTag d16;
  const auto none = hn::Set(d16, kNoLabel);
  auto lower = hn::LoadU(d16, before + l - 1);
  if (l == 0) lower = hn::IfThenElse(hn::FirstN(d16, 1), none, lower);
  const auto sides = hn::Min(lower, hn::LoadU(d16, before + l + 1));
  const auto sloping = hn::SaturatedAdd(hn::Sub(sides, least), hn::Set(d16, kSlopeCost));
  return hn::Min(hn::Min(hn::Sub(hn::LoadU(d16, before + l), least), sloping), jump);
}

template <bool kBegin>
HWY_INLINE void AddPathsOf(const PathRow& row, size_t labels, ptrdiff_t step, size_t count) {
  const ChunkTag d16;
  const size_t places = PathLabels(labels);
  const auto none = hn::Set(d16, kNoLabel);
  for (size_t k = 0; k < count; ++k) {
    const ptrdiff_t pixel = static_cast<ptrdiff_t>(k) * step;
    const ptrdiff_t at = pixel * static_cast<ptrdiff_t>(places);
    const uint8_t* cost = row.cost + at;
    int16_t* path = row.path + at;
    int16_t* sum = row.sum + at;
    const auto before_least = hn::Set(d16, kBegin ? int16_t{0} : row.before_least[pixel]);
    const auto jump = hn::Set(d16, kBegin ? int16_t{0} : row.jump[pixel]);
    auto least = none;
    for (size_t l = 0; l < places; l += hn::Lanes(d16)) {
      auto value = LoadCost(cost + l);
      if (!kBegin) value = hn::Add(value, OnwardFrom(row.before + at, l, before_least, jump));
      if (l + hn::Lanes(d16) > labels) {
        value = hn::IfThenElse(hn::FirstN(d16, l < labels ? labels - l : 0), value, none);
      }
      hn::StoreU(value, d16, path + l);
      hn::StoreU(hn::Add(hn::LoadU(d16, sum + l), value), d16, sum + l);
      least = hn::Min(least, value);
    }
    row.least[pixel] = hn::GetLane(hn::MinOfLanes(d16, least));
  }
}

inline void AddPaths(const PathRow& row, size_t labels, ptrdiff_t step, size_t count) {
  if (row.before == nullptr) {
    AddPathsOf<true>(row, labels, step, count);
  } else {
    AddPathsOf<false>(row, labels, step, count);
  }
}

// Returns the first of the labels with the least sum.
HWY_INLINE size_t BestLabel(const int16_t* sum, size_t labels) {
  const ChunkTag d16;
  auto least = hn::Set(d16, kNoLabel), where = hn::Zero(d16);
  for (size_t l = 0; l < labels; l += hn::Lanes(d16)) {
    const auto counted = hn::FirstN(d16, labels - l);
    const auto value = hn::IfThenElse(counted, hn::LoadU(d16, sum + l), hn::Set(d16, kNoLabel));
    where = hn::IfThenElse(hn::Lt(value, least), hn::Iota(d16, static_cast<int16_t>(l)), where);
    least = hn::Min(least, value);
  }
  const auto of_all = hn::Set(d16, hn::GetLane(hn::MinOfLanes(d16, least)));
  const auto first = hn::IfThenElse(hn::Eq(least, of_all), where, hn::Set(d16, kNoLabel));
  return static_cast<size_t>(hn::GetLane(hn::MinOfLanes(d16, first)));
}

// Returns the least sum of the labels 2 or more away from `best`, or kNoLabel.
HWY_INLINE int16_t LeastAway(const int16_t* sum, size_t labels, size_t best) {
  const ChunkTag d16;
  const auto none = hn::Set(d16, kNoLabel);
  const auto low = hn::Set(d16, static_cast<int16_t>(static_cast<int>(best) - 2));
  const auto high = hn::Set(d16, static_cast<int16_t>(best + 2));
  auto least = none;
  for (size_t l = 0; l < labels; l += hn::Lanes(d16)) {
    const auto label = hn::Iota(d16, static_cast<int16_t>(l));
    const auto beside = hn::And(hn::Gt(label, low), hn::Lt(label, high));
    const auto counted = hn::AndNot(beside, hn::FirstN(d16, labels - l));
    least = hn::Min(least, hn::IfThenElse(counted, hn::LoadU(d16, sum + l), none));
  }
  return hn::GetLane(hn::MinOfLanes(d16, least));
}

inline void ChooseLabels(const int16_t* HWY_RESTRICT sum, size_t labels, size_t count,
                         int16_t* HWY_RESTRICT choice, uint8_t* HWY_RESTRICT margin) {
  for (size_t n = 0; n < count; ++n, sum += PathLabels(labels)) {
    const size_t best = BestLabel(sum, labels);
    const int other = (LeastAway(sum, labels, best) - sum[best]) / 8;
    int refined = 0;
    if (best > 0 && best + 1 < labels) {
      const int left = sum[best - 1] - sum[best], right = sum[best + 1] - sum[best];
      const int most = left > right ? left : right;
      if (most > 0) refined = (left - right) * (1 << (kChoiceBits - 1)) / most;
    }
    choice[n] = static_cast<int16_t>((static_cast<int>(best) << kChoiceBits) + refined);
    margin[n] = static_cast<uint8_t>(other < 255 ? other : 255);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace starfocus::simd
HWY_AFTER_NAMESPACE();

#endif
