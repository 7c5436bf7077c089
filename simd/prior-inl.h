// SPDX-License-Identifier: Apache-2.0
// Vector code of prior.h. Included once per target.
#if defined(STARFOCUS_SIMD_PRIOR_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STARFOCUS_SIMD_PRIOR_INL_H_
#undef STARFOCUS_SIMD_PRIOR_INL_H_
#else
#define STARFOCUS_SIMD_PRIOR_INL_H_
#endif

#include "simd/chunk-inl.h"
#include "simd/prior.h"

HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

using PriorTag = hn::CappedTag<uint8_t, kSliceLanes>;

// The ways to labels of neighbours; one that is not there has kMostPrior, as far as can be.
HWY_INLINE hn::Vec<PriorTag> WayFrom(const uint8_t* from, size_t l, uint8_t way) {
  const PriorTag d8;
  if (from == nullptr) return hn::Set(d8, kMostPrior);
  return hn::SaturatedAdd(hn::LoadU(d8, from + l), hn::Set(d8, way));
}

inline void SpreadPrior(const PriorRow& row) {
  const PriorTag d8;
  const auto places = static_cast<ptrdiff_t>(row.places);
  const ptrdiff_t next = row.step * places;
  for (size_t k = 0; k < row.count; ++k) {
    const ptrdiff_t at = static_cast<ptrdiff_t>(k) * next;
    uint8_t* prior = row.prior + at;
    const uint8_t* before = row.before == nullptr ? nullptr : row.before + at;
    const uint8_t* beside = k > 0 ? prior - next : nullptr;
    const uint8_t* behind = before != nullptr && k > 0 ? before - next : nullptr;
    const uint8_t* ahead = before != nullptr && k + 1 < row.count ? before + next : nullptr;
    for (size_t l = 0; l < row.places; l += hn::Lanes(d8)) {
      const auto straight =
          hn::Min(WayFrom(beside, l, kBesideCost), WayFrom(before, l, kBesideCost));
      const auto diagonal =
          hn::Min(WayFrom(behind, l, kDiagonalCost), WayFrom(ahead, l, kDiagonalCost));
      const auto least = hn::Min(straight, diagonal);
      hn::StoreU(hn::Min(hn::LoadU(d8, prior + l), least), d8, prior + l);
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

#endif
