// SPDX-License-Identifier: Apache-2.0
// Defines loops over samples that do not fill a whole number of vectors. This file is included once
// per target.
//
// - Rows that are padded to whole groups of kSliceLanes by contract have no remainder.
// - All other kernels store with ForVectors. The last vector overlaps the previous vector and
// stores
//   equal values again. If there are fewer samples than lanes, the kernel calls its reference. Only
//   Blend stores a part of a vector, because most spans of Blend are short.
// - Kernels that add to accumulators must add each sample once. These kernels mask the last vector
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

// Calls step(n) for each vector of `count` samples. The last vector ends at the last sample and may
// overlap the previous vector. If there are fewer samples than lanes, returns false without calling
// step.
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
