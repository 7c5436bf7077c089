// SPDX-License-Identifier: Apache-2.0
// This file hides what differs between Highway versions and targets. Included once per target.
#if defined(STARFOCUS_SIMD_COMPAT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STARFOCUS_SIMD_COMPAT_INL_H_
#undef STARFOCUS_SIMD_COMPAT_INL_H_
#else
#define STARFOCUS_SIMD_COMPAT_INL_H_
#endif

#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// WeighPair returns a * wa + b * wb in 32-bit lanes, for a, b, wa, wb <= 32767. It takes
// one multiply-add of 16-bit pairs on x86 and two multiplications elsewhere.
#undef STARFOCUS_HAVE_PAIR_MULTIPLY
#if HWY_ARCH_X86 && HWY_TARGET != HWY_SCALAR
#define STARFOCUS_HAVE_PAIR_MULTIPLY 1
#else
#define STARFOCUS_HAVE_PAIR_MULTIPLY 0
#endif

template <class D32, class V32 = hn::Vec<D32>>
HWY_INLINE V32 WeighPair(D32 d32, V32 a, V32 b, V32 wa, V32 wb) {
#if STARFOCUS_HAVE_PAIR_MULTIPLY
  const hn::RebindToSigned<D32> di32;
  const hn::Repartition<int16_t, decltype(di32)> di16;
  const auto pixels = hn::BitCast(di16, hn::Or(a, hn::ShiftLeft<16>(b)));
  const auto weights = hn::BitCast(di16, hn::Or(wa, hn::ShiftLeft<16>(wb)));
  auto unused = hn::Zero(di32);
  return hn::BitCast(d32,
                     hn::ReorderWidenMulAccumulate(di32, pixels, weights, hn::Zero(di32), unused));
#else
  (void)d32;
  return hn::Add(hn::Mul(a, wa), hn::Mul(b, wb));
#endif
}

}  // namespace HWY_NAMESPACE
}  // namespace starfocus::simd
HWY_AFTER_NAMESPACE();

#endif
