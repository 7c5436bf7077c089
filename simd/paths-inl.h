// SPDX-License-Identifier: Apache-2.0
// Vector code of the functions in paths.h. This file is included once per SIMD target.
#include "simd/highway-inl.h"
#include "simd/paths.h"

HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

template <bool kAdds>
HWY_INLINE void AddPathsOf(const PathRow& row, size_t labels, ptrdiff_t step, size_t count) {
  const LanesTag d16;
  const size_t lanes = hn::Lanes(d16), places = PathLabels(labels);
  // `whole` is the number of labels in full vectors. `is_label` marks the labels in the vector
  // after the full vectors.
  const size_t whole = labels / lanes * lanes;
  const auto is_label = hn::FirstN(d16, labels - whole);
  const auto none = hn::Set(d16, kNoLabel), slope = hn::Set(d16, kSlopeCost);
  for (size_t k = 0; k < count; ++k) {
    const ptrdiff_t pixel = static_cast<ptrdiff_t>(k) * step;
    const ptrdiff_t at = pixel * static_cast<ptrdiff_t>(places);
    const uint8_t* cost = row.cost + at;
    const int16_t* before = row.before + at;
    int16_t* path = row.path + at;
    int16_t* sum = row.sum + at;
    const auto before_least = hn::Set(d16, row.before_least[pixel]);
    const auto jump = hn::Add(hn::Set(d16, row.jump[pixel]), before_least);
    const auto path_at = [&](size_t l) HWY_ATTR {
      const auto sides = hn::Min(hn::LoadU(d16, before + l - 1), hn::LoadU(d16, before + l + 1));
      const auto sloping = hn::Min(hn::SaturatedAdd(sides, slope), jump);
      const auto onward = hn::Min(hn::LoadU(d16, before + l), sloping);
      return hn::Add(hn::Sub(onward, before_least), LoadBytes(d16, cost + l));
    };
    auto least = none;
    size_t l = 0;
    for (; l < whole; l += lanes) {
      const auto value = path_at(l);
      hn::StoreU(value, d16, path + l);
      hn::StoreU(kAdds ? hn::Add(hn::LoadU(d16, sum + l), value) : value, d16, sum + l);
      least = hn::Min(least, value);
    }
    const auto last = hn::IfThenElse(is_label, path_at(l), none);
    hn::StoreU(last, d16, path + l);
    hn::StoreU(kAdds ? hn::SaturatedAdd(hn::LoadU(d16, sum + l), last) : last, d16, sum + l);
    least = hn::Min(least, last);
    for (l += lanes; l < places; l += lanes) {
      hn::StoreU(none, d16, path + l);
      if (!kAdds) hn::StoreU(none, d16, sum + l);
    }
    row.least[pixel] = hn::GetLane(hn::MinOfLanes(d16, least));
  }
}

inline void AddPaths(const PathRow& row, size_t labels, ptrdiff_t step, size_t count) {
  if (row.adds) return AddPathsOf<true>(row, labels, step, count);
  AddPathsOf<false>(row, labels, step, count);
}

inline void FindJumps(const uint8_t* pixels, const uint8_t* before, size_t plane, size_t count,
                      int16_t* HWY_RESTRICT jump) {
  // A jump costs kLeastJump if the colour difference is kFar or more.
  constexpr int kFar = kLargestJump * kSimilarColours / kLeastJump - kSimilarColours + 1;
  int16_t jumps[kFar + 1];
  for (int apart = 0; apart < kFar; ++apart) {
    jumps[apart] = static_cast<int16_t>(kLargestJump * kSimilarColours / (kSimilarColours + apart));
  }
  jumps[kFar] = kLeastJump;
  const hn::CappedTag<uint8_t, kSliceLanes> d8;
  for (size_t n = 0; n < count; n += hn::Lanes(d8)) {
    const auto sum = ColourDistance(d8, pixels + n, before + n, plane);
    HWY_ALIGN uint8_t apart[kSliceLanes];
    hn::Store(hn::Min(sum, hn::Set(d8, uint8_t{kFar})), d8, apart);
    const size_t here = count - n < hn::Lanes(d8) ? count - n : hn::Lanes(d8);
    for (size_t k = 0; k < here; ++k) jump[n + k] = jumps[apart[k]];
  }
}

// Returns the first label with the smallest sum, and stores this sum in *least_sum.
HWY_INLINE size_t BestLabel(const int16_t* sum, size_t labels, int16_t* least_sum) {
  const LanesTag d16;
  auto least = hn::LoadU(d16, sum);
  for (size_t l = hn::Lanes(d16); l < labels; l += hn::Lanes(d16)) {
    least = hn::Min(least, hn::LoadU(d16, sum + l));
  }
  *least_sum = hn::GetLane(hn::MinOfLanes(d16, least));
  const auto of_all = hn::Set(d16, *least_sum);
  for (size_t l = 0;; l += hn::Lanes(d16)) {
    const auto found = hn::FindFirstTrue(d16, hn::Eq(hn::LoadU(d16, sum + l), of_all));
    if (found >= 0) return l + static_cast<size_t>(found);
  }
}

// Returns the smallest sum of all labels 2 or more away from `best`, or kNoLabel if there is no
// such label.
HWY_INLINE int16_t LeastAway(const int16_t* sum, size_t labels, size_t best) {
  const LanesTag d16;
  const auto none = hn::Set(d16, kNoLabel);
  const auto low = hn::Set(d16, static_cast<int16_t>(static_cast<int>(best) - 2));
  const auto high = hn::Set(d16, static_cast<int16_t>(best + 2));
  auto least = none;
  for (size_t l = 0; l < labels; l += hn::Lanes(d16)) {
    const auto label = CountFrom(d16, static_cast<int16_t>(l));
    const auto beside = hn::And(hn::Gt(label, low), hn::Lt(label, high));
    least = hn::Min(least, hn::IfThenElse(beside, none, hn::LoadU(d16, sum + l)));
  }
  return hn::GetLane(hn::MinOfLanes(d16, least));
}

inline void ChooseLabels(const int16_t* HWY_RESTRICT sum, size_t labels, size_t count,
                         int16_t* HWY_RESTRICT choice, uint8_t* HWY_RESTRICT margin) {
  for (size_t n = 0; n < count; ++n, sum += PathLabels(labels)) {
    int16_t least = 0;
    const size_t best = BestLabel(sum, labels, &least);
    int refined = 0;
    if (best > 0 && best + 1 < labels) {
      refined = reference::Refine(sum[best - 1], least, sum[best + 1]);
    }
    choice[n] = static_cast<int16_t>((static_cast<int>(best) << kChoiceBits) + refined);
    if (margin == nullptr) continue;
    const int other = (LeastAway(sum, labels, best) - least) / 8;
    margin[n] = static_cast<uint8_t>(other < 255 ? other : 255);
  }
}

using PriorTag = hn::CappedTag<uint8_t, kSliceLanes>;

HWY_INLINE hn::Vec<PriorTag> WayFrom(const uint8_t* from, uint8_t way) {
  const PriorTag d8;
  return hn::SaturatedAdd(hn::LoadU(d8, from), hn::Set(d8, way));
}

// If a neighbour is missing, another pixel with a lower step cost takes its place, which does not
// change the result: a missing diagonal neighbour is replaced by the adjacent one, and a missing
// row by the pixel itself.
inline void PropagatePrior(uint8_t* first, const uint8_t* before, size_t places, ptrdiff_t step,
                           size_t count) {
  const PriorTag d8;
  const ptrdiff_t next = step * static_cast<ptrdiff_t>(places);
  for (size_t k = 0; k < count; ++k) {
    const ptrdiff_t at = static_cast<ptrdiff_t>(k) * next;
    uint8_t* prior = first + at;
    const uint8_t* beside = k > 0 ? prior - next : prior;
    const uint8_t* above = before != nullptr ? before + at : prior;
    const uint8_t* behind = before != nullptr && k > 0 ? above - next : above;
    const uint8_t* ahead = before != nullptr && k + 1 < count ? above + next : above;
    for (size_t l = 0; l < places; l += hn::Lanes(d8)) {
      const auto diagonal = hn::Min(hn::LoadU(d8, behind + l), hn::LoadU(d8, ahead + l));
      auto least = hn::Min(hn::LoadU(d8, prior + l), WayFrom(beside + l, kBesideCost));
      least = hn::Min(least, WayFrom(above + l, kBesideCost));
      least = hn::Min(least, hn::SaturatedAdd(diagonal, hn::Set(d8, kDiagonalCost)));
      hn::StoreU(least, d8, prior + l);
    }
  }
}

inline void AddPrior(const uint8_t* HWY_RESTRICT prior, size_t count, uint8_t* HWY_RESTRICT cost) {
  const PriorTag d8;
  for (size_t n = 0; n < count; n += hn::Lanes(d8)) {
    hn::StoreU(hn::SaturatedAdd(hn::LoadU(d8, cost + n), hn::LoadU(d8, prior + n)), d8, cost + n);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace starfocus::simd
HWY_AFTER_NAMESPACE();
