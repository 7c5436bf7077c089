// SPDX-License-Identifier: Apache-2.0
// Defines vectors of at most kSliceLanes samples, and converts their masks to bits. This file is
// included once per SIMD target.
#if defined(STARFOCUS_SIMD_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STARFOCUS_SIMD_LANES_INL_H_
#undef STARFOCUS_SIMD_LANES_INL_H_
#else
#define STARFOCUS_SIMD_LANES_INL_H_
#endif

#include "simd/compat-inl.h"
#include "simd/padding.h"

HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

// A vector holds at most one group, because rows are padded to whole groups only, and because the
// bits of a mask belong to one group.
using LanesTag = hn::CappedTag<int16_t, kSliceLanes>;
using LanesVec = hn::Vec<LanesTag>;

// Returns the mask of a full vector as an integer. Bit k is set if lane k of the mask is true.
template <class D>
HWY_INLINE uint32_t BitsOf(D d, hn::Mask<D> mask) {
#if HWY_ARCH_WASM && HWY_TARGET != HWY_SCALAR
  // Highway 1.0.3 computes the bits with scalar code.
  (void)d;
  return static_cast<uint32_t>(sizeof(hn::TFromD<D>) == 1 ? wasm_i8x16_bitmask(mask.raw)
                                                          : wasm_i16x8_bitmask(mask.raw));
#else
  uint8_t bytes[8] = {};
  hn::StoreMaskBits(d, mask, bytes);
  return uint32_t{bytes[0]} | uint32_t{bytes[1]} << 8;
#endif
}

}  // namespace HWY_NAMESPACE
}  // namespace starfocus::simd
HWY_AFTER_NAMESPACE();

#endif
