// SPDX-License-Identifier: Apache-2.0
// Vector code of the functions in hidden_fill.h. This file is included once per SIMD target.
#include "simd/hidden_fill.h"
#include "simd/highway-inl.h"

HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

// Copies the farthest surfaces of a vector of pixels, some of which have hidden surfaces. Returns
// the largest distance over which a colour is repeated.
HWY_INLINE int32_t CopyHidden(const SurfaceRow& from, const uint16_t* const* source, size_t n,
                              const FarRow& far) {
  const LanesTag d16;
  const hn::RebindToUnsigned<LanesTag> du16;
  const hn::Rebind<uint8_t, LanesTag> d8;
  const auto nothing = hn::Set(d16, kNoSurface);
  const auto first = hn::LoadU(d16, from.disparity[0] + n);
  const auto second = hn::LoadU(d16, from.disparity[1] + n);
  const auto third = hn::LoadU(d16, from.disparity[2] + n);
  const auto is_second = hn::And(hn::Ne(second, nothing), hn::Lt(second, first));
  const auto upper = hn::IfThenElse(is_second, second, first);
  const auto is_third = hn::And(hn::Ne(third, nothing), hn::Lt(third, upper));
  hn::StoreU(hn::IfThenElse(is_third, third, upper), d16, far.disparity + n);
  for (size_t c = 0; c < 3; ++c) {
    const size_t at = c * from.plane + n;
    const auto hidden = hn::IfThenElse(is_second, hn::LoadU(d16, from.rgb[1] + at),
                                       hn::LoadU(d16, from.rgb[0] + at));
    const auto colour = hn::IfThenElse(is_third, hn::LoadU(d16, from.rgb[2] + at), hidden);
    hn::StoreU(colour, d16, far.rgb + c * far.plane + n);
  }
  const auto share = hn::PromoteTo(d16, hn::LoadU(d8, from.share + n));
  const auto whole = hn::Or(hn::Eq(share, hn::Set(d16, kSliceWhole)),
                            hn::Eq(share, hn::Set(d16, int16_t{kSliceEnd})));
  const auto of_second = hn::BitCast(d16, hn::LoadU(du16, source[0] + n));
  const auto of_third = hn::BitCast(d16, hn::LoadU(du16, source[1] + n));
  const auto behind = hn::IfThenElse(whole, of_third, of_second);
  const auto before = hn::IfThenElseZero(hn::And(is_second, whole), of_second);
  const auto found = hn::BitCast(du16, hn::IfThenElse(is_third, behind, before));
  const auto distance = hn::ShiftRight<kSourceDistance>(found);
  const auto repeated = hn::Ne(distance, hn::Zero(du16));
  hn::StoreU(hn::IfThenElseZero(repeated, found), du16, far.source + n);
  return hn::GetLane(hn::MaxOfLanes(d16, hn::BitCast(d16, distance)));
}

inline int32_t CopyFarthest(const SurfaceRow& from, const uint16_t* const* source, size_t count,
                            const FarRow& far, uint64_t* strips) {
  const LanesTag d16;
  const hn::RebindToUnsigned<LanesTag> du16;
  int32_t most = 0;
  *strips = 0;
  for (size_t n = 0; n < SliceSamples(count); n += hn::Lanes(d16)) {
    if ((from.hiding >> (n / kSliceLanes) & 1) != 0) {
      const int32_t distance = CopyHidden(from, source, n, far);
      most = distance > most ? distance : most;
      if (distance > 0) *strips |= uint64_t{1} << (n / kSliceLanes);
      continue;
    }
    hn::StoreU(hn::LoadU(d16, from.disparity[0] + n), d16, far.disparity + n);
    hn::StoreU(hn::Zero(du16), du16, far.source + n);
    for (size_t c = 0; c < 3; ++c) {
      hn::StoreU(hn::LoadU(d16, from.rgb[0] + c * from.plane + n), d16,
                 far.rgb + c * far.plane + n);
    }
  }
  return most;
}

inline void PutFarthest(const FarRow& far, const int16_t* HWY_RESTRICT disparity, uint64_t hiding,
                        size_t plane, int16_t* HWY_RESTRICT rgb) {
  const LanesTag d16;
  const hn::RebindToUnsigned<LanesTag> du16;
  for (size_t strip = 0; hiding != 0; hiding >>= 1, strip += kSliceLanes) {
    if ((hiding & 1) == 0) continue;
    for (size_t n = strip; n < strip + kSliceLanes; n += hn::Lanes(d16)) {
      const auto source = hn::BitCast(d16, hn::LoadU(du16, far.source + n));
      const auto same = hn::Eq(hn::LoadU(d16, disparity + n), hn::LoadU(d16, far.disparity + n));
      const auto puts = hn::And(same, hn::Ne(source, hn::Zero(d16)));
      if (hn::AllFalse(d16, puts)) continue;
      for (size_t c = 0; c < 3; ++c) {
        int16_t* out = rgb + c * plane + n;
        const auto colour = hn::LoadU(d16, far.rgb + c * far.plane + n);
        hn::StoreU(hn::IfThenElse(puts, colour, hn::LoadU(d16, out)), d16, out);
      }
    }
  }
}

// Returns a mask of the lanes whose disparities differ by more than `unit`.
HWY_INLINE hn::Mask<LanesTag> Differ(LanesVec a, LanesVec b, int16_t unit) {
  const LanesTag d16;
  const auto less = hn::SaturatedSub(a, b);
  return hn::Or(hn::Gt(less, hn::Set(d16, unit)),
                hn::Gt(hn::Set(d16, static_cast<int16_t>(-unit)), less));
}

// Calls act(n) for the vectors from pixel n on of all groups of kSliceLanes in `strips`.
template <class Act>
HWY_INLINE void ForStrips(uint64_t strips, const Act& act) {
  for (size_t strip = 0; strips != 0; strips >>= 1, strip += kSliceLanes) {
    if ((strips & 1) == 0) continue;
    for (size_t n = strip; n < strip + kSliceLanes; n += hn::Lanes(LanesTag())) act(n);
  }
}

inline void LimitFar(const FarRows& rows, int16_t* HWY_RESTRICT out) {
  const LanesTag d16;
  const auto zero = hn::Zero(d16);
  ForStrips(rows.strips, [&](size_t n) HWY_ATTR {
    const auto from = hn::LoadU(d16, reinterpret_cast<const int16_t*>(rows.source) + n);
    if (hn::AllTrue(d16, hn::Eq(from, zero))) return;
    const auto across = hn::Ne(hn::And(from, hn::Set(d16, kSourceAlongRow)), zero);
    const auto down = hn::Ne(hn::And(from, hn::Set(d16, kSourceAlongColumn)), zero);
    const auto own = hn::LoadU(d16, rows.disparity[1] + n);
    const auto is_other = [&](const int16_t* beside, const int16_t* along) HWY_ATTR {
      const auto there = hn::IfThenElse(across, hn::LoadU(d16, beside + n), hn::LoadU(d16, along));
      return Differ(own, there, rows.unit);
    };
    const auto other = hn::Or(is_other(rows.disparity[0], rows.disparity[1] + n - 1),
                              is_other(rows.disparity[2], rows.disparity[1] + n + 1));
    const auto takes = hn::AndNot(other, hn::Xor(across, down));
    if (hn::AllFalse(d16, takes)) return;
    for (size_t c = 0; c < 3; ++c) {
      const size_t at = c * rows.plane + n;
      const auto first = hn::IfThenElse(across, hn::LoadU(d16, rows.rgb[0] + at),
                                        hn::LoadU(d16, rows.rgb[1] + at - 1));
      const auto second = hn::IfThenElse(across, hn::LoadU(d16, rows.rgb[2] + at),
                                         hn::LoadU(d16, rows.rgb[1] + at + 1));
      const auto low = hn::Min(first, second), high = hn::Max(first, second);
      const auto range = hn::Sub(high, low);
      const auto more = hn::SaturatedAdd(range, hn::Set(d16, kStreakLight));
      const auto limited =
          hn::Min(hn::Max(hn::LoadU(d16, rows.rgb[1] + at), hn::SaturatedSub(low, more)),
                  hn::SaturatedAdd(high, more));
      hn::StoreU(hn::IfThenElse(takes, limited, hn::LoadU(d16, out + at)), d16, out + at);
    }
  });
}

inline void SmoothFar(const FarRows& rows, int32_t step, int16_t* HWY_RESTRICT out) {
  const LanesTag d16;
  const hn::RebindToUnsigned<LanesTag> du16;
  // Largest integer distance n for which 2 n < step.
  const auto short_of = hn::Set(d16, static_cast<int16_t>((step - 1) / 2));
  const auto mean = [&](LanesVec a, LanesVec b) HWY_ATTR {
    return hn::BitCast(d16, hn::AverageRound(hn::BitCast(du16, a), hn::BitCast(du16, b)));
  };
  ForStrips(rows.strips, [&](size_t n) HWY_ATTR {
    const auto distance = hn::ShiftRight<kSourceDistance>(hn::LoadU(du16, rows.source + n));
    const auto takes = hn::Gt(hn::BitCast(d16, distance), short_of);
    if (hn::AllFalse(d16, takes)) return;
    const auto own = hn::LoadU(d16, rows.disparity[1] + n);
    const auto differs = [&](const int16_t* at)
                             HWY_ATTR { return Differ(own, hn::LoadU(d16, at), rows.unit); };
    const auto left = differs(rows.disparity[1] + n - step);
    const auto right = differs(rows.disparity[1] + n + step);
    const auto above = differs(rows.disparity[0] + n);
    const auto below = differs(rows.disparity[2] + n);
    for (size_t c = 0; c < 3; ++c) {
      const int16_t* at = rows.rgb[1] + c * rows.plane + n;
      const auto here = hn::LoadU(d16, at);
      const auto across = mean(hn::IfThenElse(left, here, hn::LoadU(d16, at - step)),
                               hn::IfThenElse(right, here, hn::LoadU(d16, at + step)));
      const auto upper = hn::LoadU(d16, rows.rgb[0] + c * rows.plane + n);
      const auto lower = hn::LoadU(d16, rows.rgb[2] + c * rows.plane + n);
      const auto down =
          mean(hn::IfThenElse(above, here, upper), hn::IfThenElse(below, here, lower));
      const auto smooth = mean(here, mean(across, down));
      int16_t* const to = out + c * rows.plane + n;
      hn::StoreU(hn::IfThenElse(takes, smooth, hn::LoadU(d16, to)), d16, to);
    }
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace starfocus::simd
HWY_AFTER_NAMESPACE();
