// SPDX-License-Identifier: Apache-2.0
// Vector code of prefilter.h. Included once per target.
#if defined(STARFOCUS_SIMD_PREFILTER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STARFOCUS_SIMD_PREFILTER_INL_H_
#undef STARFOCUS_SIMD_PREFILTER_INL_H_
#else
#define STARFOCUS_SIMD_PREFILTER_INL_H_
#endif

#include <cstring>

#include "simd/compat-inl.h"
#include "simd/prefilter.h"

HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

// Returns what is filtered of five samples in a line, with an offset that keeps it positive.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V FilterLine(D du16, const uint16_t* middle, ptrdiff_t step, V offset) {
  const hn::RebindToSigned<D> di16;
  const auto at = [&](ptrdiff_t k) HWY_ATTR { return hn::LoadU(du16, middle + k * step); };
  const auto mean = [](V a, V b) HWY_ATTR { return hn::AverageRound(a, b); };
  const V centre = at(0), far = mean(at(-2), at(2));
  const V sum = hn::Add(mean(centre, mean(at(-1), at(1))), offset);
  const auto rest = hn::ShiftRight<3>(hn::BitCast(di16, hn::Sub(centre, far)));
  return hn::Add(sum, hn::BitCast(du16, rest));
}

inline void Prefilter(int16_t* samples, size_t stride, size_t rows, size_t count) {
  constexpr size_t kChunk = 192, kAround = 2 * kPrefilterReach, kPixels = 3 * kAround;
  constexpr uint16_t kHalved = 2048;
  const hn::ScalableTag<uint16_t> d16;
  const size_t lanes = hn::Lanes(d16);
  const auto before = hn::Set(d16, uint16_t{2 * kHalved});
  const auto after = hn::Set(d16, uint16_t{kPrefilterOffset - kHalved});
  uint16_t halved[kChunk + kPixels + HWY_MAX_BYTES], filtered[kChunk + HWY_MAX_BYTES];
  if (count <= kPixels) return;
  for (size_t y = 0; y + kAround < rows; ++y, samples += stride) {
    for (size_t begin = 0; begin < count - kPixels; begin += kChunk) {
      const size_t rest = count - kPixels - begin, chunk = rest < kChunk ? rest : kChunk;
      const auto* from = reinterpret_cast<const uint16_t*>(samples + begin);
      const auto* middle = from + kPrefilterReach * stride;
      for (size_t n = 0; n < chunk + kPixels; n += lanes) {
        const auto sum = FilterLine(d16, middle + n, static_cast<ptrdiff_t>(stride), before);
        hn::StoreU(hn::AverageRound(sum, hn::Zero(d16)), d16, halved + n);
      }
      for (size_t n = 0; n < chunk; n += lanes) {
        hn::StoreU(FilterLine(d16, halved + 3 * kPrefilterReach + n, 3, after), d16, filtered + n);
      }
      std::memcpy(samples + begin, filtered, chunk * sizeof(*filtered));
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace starfocus::simd
HWY_AFTER_NAMESPACE();

#endif
