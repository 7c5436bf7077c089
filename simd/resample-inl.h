// The kernels of the layers: widen, narrow, finish_layer, half_band, between. Included once per
// target.
#if defined(STARFOCUS_SIMD_RESAMPLE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STARFOCUS_SIMD_RESAMPLE_INL_H_
#undef STARFOCUS_SIMD_RESAMPLE_INL_H_
#else
#define STARFOCUS_SIMD_RESAMPLE_INL_H_
#endif

#include "simd/compat-inl.h"
#include "simd/kernels.h"

HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

HWY_INLINE void WidenSamples(const uint8_t* HWY_RESTRICT in, size_t count,
                             int16_t* HWY_RESTRICT out) {
  const hn::ScalableTag<int16_t> d16;
  const hn::Rebind<uint8_t, decltype(d16)> d8;
  const size_t lanes = hn::Lanes(d16);
  size_t n = 0;
  for (; n + lanes <= count; n += lanes) {
    const auto value = hn::PromoteTo(d16, hn::LoadU(d8, in + n));
    hn::StoreU(hn::ShiftLeft<kLayerBits>(value), d16, out + n);
  }
  ReferenceKernels().widen(in + n, count - n, out + n);
}

HWY_INLINE void NarrowSamples(const int16_t* HWY_RESTRICT in, size_t count,
                              uint8_t* HWY_RESTRICT out) {
  const hn::ScalableTag<int16_t> d16;
  const hn::Rebind<uint8_t, decltype(d16)> d8;
  const size_t lanes = hn::Lanes(d16);
  const auto below_half = hn::Set(d16, int16_t{(1 << (kLayerBits - 1)) - 1});
  const auto one = hn::Set(d16, int16_t{1});
  size_t n = 0;
  for (; n + lanes <= count; n += lanes) {
    // Saturating: an int16 near its limit still rounds to 255.
    const auto value = hn::LoadU(d16, in + n);
    const auto odd = hn::And(hn::ShiftRight<kLayerBits>(value), one);
    const auto sum = hn::SaturatedAdd(value, hn::Add(below_half, odd));
    hn::StoreU(hn::DemoteTo(d8, hn::ShiftRight<kLayerBits>(sum)), d8, out + n);
  }
  ReferenceKernels().narrow(in + n, count - n, out + n);
}

HWY_INLINE void FinishLayerSamples(const uint32_t* HWY_RESTRICT accumulators, size_t count,
                                   int shift, int16_t* HWY_RESTRICT out) {
  const hn::ScalableTag<uint32_t> d32;
  const hn::RebindToSigned<decltype(d32)> di32;
  const hn::Rebind<int16_t, decltype(d32)> d16;
  const size_t lanes = hn::Lanes(d32);
  const auto half = hn::Set(d32, uint32_t{1} << (shift - kLayerBits - 1));
  size_t n = 0;
  for (; n + lanes <= count; n += lanes) {
    const auto sum = hn::Add(hn::LoadU(d32, accumulators + n), half);
    const auto value = hn::BitCast(di32, hn::ShiftRightSame(sum, shift - kLayerBits));
    hn::StoreU(hn::DemoteTo(d16, value), d16, out + n);
  }
  ReferenceKernels().finish_layer(accumulators + n, count - n, shift, out + n);
}

// Adds 2^13, drops kTapBits and clamps, by saturation to int16 first.
template <class D16, class V32, class V16>
HWY_INLINE V16 RoundSum(D16 d16, V32 sum, V32 half, V16 low, V16 high) {
  const auto value = hn::DemoteTo(d16, hn::ShiftRight<kTapBits>(hn::Add(sum, half)));
  return hn::Min(hn::Max(value, low), high);
}

HWY_INLINE void HalfBandSamples(const int16_t* in, ptrdiff_t step, const HalfBand& taps,
                                size_t count, int16_t low, int16_t high, int16_t* out) {
  const hn::ScalableTag<int32_t> d32;
  const hn::Rebind<int16_t, decltype(d32)> d16;
  const size_t lanes = hn::Lanes(d32);
  const auto centre = hn::Set(d32, taps.centre), near = hn::Set(d32, taps.near),
             far = hn::Set(d32, taps.far), half = hn::Set(d32, 1 << (kTapBits - 1));
  const auto vlow = hn::Set(d16, low), vhigh = hn::Set(d16, high);
  const auto load = [&](const int16_t* at)
                        HWY_ATTR { return hn::PromoteTo(d32, hn::LoadU(d16, at)); };
  size_t n = 0;
  for (; n + lanes <= count; n += lanes) {
    const int16_t* at = in + n;
    const auto beside = hn::Mul(near, hn::Add(load(at - step), load(at + step)));
    const auto beyond = hn::Mul(far, hn::Add(load(at - 3 * step), load(at + 3 * step)));
    const auto sum = hn::Add(hn::Mul(centre, load(at)), hn::Add(beside, beyond));
    hn::StoreU(RoundSum(d16, sum, half, vlow, vhigh), d16, out + n);
  }
  ReferenceKernels().half_band(in + n, step, taps, count - n, low, high, out + n);
}

HWY_INLINE void BetweenSamples(const int16_t* in, ptrdiff_t step, const HalfBand& taps,
                               size_t count, int16_t low, int16_t high, int16_t* out) {
  const hn::ScalableTag<int32_t> d32;
  const hn::Rebind<int16_t, decltype(d32)> d16;
  const size_t lanes = hn::Lanes(d32);
  const auto near = hn::Set(d32, taps.near), far = hn::Set(d32, taps.far),
             half = hn::Set(d32, 1 << (kTapBits - 1));
  const auto vlow = hn::Set(d16, low), vhigh = hn::Set(d16, high);
  const auto load = [&](const int16_t* at)
                        HWY_ATTR { return hn::PromoteTo(d32, hn::LoadU(d16, at)); };
  size_t n = 0;
  for (; n + lanes <= count; n += lanes) {
    const int16_t* at = in + n;
    const auto beside = hn::Mul(near, hn::Add(load(at), load(at + step)));
    const auto beyond = hn::Mul(far, hn::Add(load(at - step), load(at + 2 * step)));
    hn::StoreU(RoundSum(d16, hn::Add(beside, beyond), half, vlow, vhigh), d16, out + n);
  }
  ReferenceKernels().between(in + n, step, taps, count - n, low, high, out + n);
}

}  // namespace HWY_NAMESPACE
}  // namespace starfocus::simd
HWY_AFTER_NAMESPACE();

#endif
