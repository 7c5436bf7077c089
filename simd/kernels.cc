// SPDX-License-Identifier: Apache-2.0
// One table of kernels per SIMD target; Highway picks the best one of the machine.
#include "simd/kernels.h"

// Highway 1.0.3 truncates 16-bit numbers wrongly on AVX3_DL, which -march=native can bring in; AVX3
// stands in for it.
#ifndef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS HWY_AVX3_DL
#endif

// Vectors emulated without SIMD, which clang has instead of single numbers, give other results.
#ifndef HWY_BROKEN_EMU128
#define HWY_BROKEN_EMU128 1
#endif

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/kernels.cc"
#include "hwy/foreach_target.h"  // must precede highway.h
#include "hwy/highway.h"
#include "simd/cells-inl.h"
#include "simd/disc-inl.h"
#include "simd/disparities-inl.h"
#include "simd/finish_composite-inl.h"
#include "simd/hidden_fill-inl.h"
#include "simd/layered_depth-inl.h"
#include "simd/light-inl.h"
#include "simd/neighbourhood-inl.h"
#include "simd/resample-inl.h"
#include "simd/runs-inl.h"
#include "simd/slices-inl.h"
#include "simd/slope-inl.h"
#include "simd/spans-inl.h"
#include "simd/tiles-inl.h"

HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

// HWY_NAMESPACE is N_ and the target's name.
#undef STARFOCUS_TEXT
#undef STARFOCUS_TEXT_OF
#define STARFOCUS_TEXT(name) #name
#define STARFOCUS_TEXT_OF(name) STARFOCUS_TEXT(name)

const Kernels* Table() {
  static constexpr Kernels kernels = {&STARFOCUS_TEXT_OF(HWY_NAMESPACE)[2],
                                      STARFOCUS_KERNELS(STARFOCUS_ENTRY)};
  return &kernels;
}

}  // namespace HWY_NAMESPACE
}  // namespace starfocus::simd
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace starfocus::simd {

HWY_EXPORT(Table);

const Kernels& BestKernels() { return *HWY_DYNAMIC_DISPATCH(Table)(); }

}  // namespace starfocus::simd
#endif
