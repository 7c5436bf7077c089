// SPDX-License-Identifier: Apache-2.0
// Vector code of the functions in prior.h. This file is included once per SIMD target.
#if defined(STARFOCUS_SIMD_PRIOR_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STARFOCUS_SIMD_PRIOR_INL_H_
#undef STARFOCUS_SIMD_PRIOR_INL_H_
#else
#define STARFOCUS_SIMD_PRIOR_INL_H_
#endif

#include "simd/highway-inl.h"
#include "simd/prior.h"

HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

using PriorTag = hn::CappedTag<uint8_t, kSliceLanes>;

HWY_INLINE hn::Vec<PriorTag> WayFrom(const uint8_t* from, uint8_t way) {
  const PriorTag d8;
  return hn::SaturatedAdd(hn::LoadU(d8, from), hn::Set(d8, way));
}

// If a diagonal neighbour is missing, an adjacent neighbour with a lower step cost takes its place,
// which does not change the result.
template <bool kBefore>
HWY_INLINE void SpreadPriorOf(const PriorRow& row) {
  const PriorTag d8;
  const ptrdiff_t next = row.step * static_cast<ptrdiff_t>(row.places);
  for (size_t k = 0; k < row.count; ++k) {
    const ptrdiff_t at = static_cast<ptrdiff_t>(k) * next;
    uint8_t* prior = row.prior + at;
    const uint8_t* beside = k > 0 ? prior - next : prior;
    const uint8_t* before = kBefore ? row.before + at : nullptr;
    const uint8_t* behind = kBefore && k > 0 ? before - next : before;
    const uint8_t* ahead = kBefore && k + 1 < row.count ? before + next : before;
    for (size_t l = 0; l < row.places; l += hn::Lanes(d8)) {
      auto least = hn::Min(hn::LoadU(d8, prior + l), WayFrom(beside + l, kBesideCost));
      if (kBefore) {
        const auto diagonal = hn::Min(hn::LoadU(d8, behind + l), hn::LoadU(d8, ahead + l));
        least = hn::Min(least, WayFrom(before + l, kBesideCost));
        least = hn::Min(least, hn::SaturatedAdd(diagonal, hn::Set(d8, kDiagonalCost)));
      }
      hn::StoreU(least, d8, prior + l);
    }
  }
}

inline void SpreadPrior(const PriorRow& row) {
  if (row.before != nullptr) {
    SpreadPriorOf<true>(row);
  } else {
    SpreadPriorOf<false>(row);
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

#endif
