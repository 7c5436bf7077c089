// SPDX-License-Identifier: Apache-2.0
// How kernels handle samples that do not fill a vector. Included once per target.
//
// - Rows that the contract pads to whole groups of kSliceLanes have no remainder.
// - All other kernels store with ForVectors, whose last vector overlaps the one before it and
// stores
//   the same values again. If there are fewer samples than lanes, they call their reference. Blend
//   alone stores a part of a vector: most of its spans are short.
// - Kernels that add to accumulators must add each sample once. They mask the last vector
//   (`AddSpan` in spans-inl.h).
#if defined(STARFOCUS_SIMD_VECTORS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STARFOCUS_SIMD_VECTORS_INL_H_
#undef STARFOCUS_SIMD_VECTORS_INL_H_
#else
#define STARFOCUS_SIMD_VECTORS_INL_H_
#endif

#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

// Runs step(n) for each vector of `count` samples. The last vector ends with the samples. Returns
// false, without a step, if there are fewer samples than lanes.
template <class Step>
HWY_INLINE bool ForVectors(size_t count, size_t lanes, const Step& step) {
  if (count < lanes) return false;
  for (size_t n = 0; n < count - lanes; n += lanes) step(n);
  step(count - lanes);
  return true;
}

}  // namespace HWY_NAMESPACE
}  // namespace starfocus::simd
HWY_AFTER_NAMESPACE();

#endif
