// SPDX-License-Identifier: Apache-2.0
// One table of depth kernels per SIMD target; Highway picks the best one of the machine.
#include "simd/depth_kernels.h"

// As for kernels.cc, which says why.
#ifndef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS HWY_AVX3_DL
#endif
#ifndef HWY_BROKEN_EMU128
#define HWY_BROKEN_EMU128 1
#endif

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/depth_kernels.cc"
#include "hwy/foreach_target.h"  // must precede highway.h
#include "hwy/highway.h"
#include "simd/label_costs-inl.h"
#include "simd/paths-inl.h"
#include "simd/planes-inl.h"
#include "simd/prior-inl.h"

HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

// HWY_NAMESPACE is N_ and the target's name.
#undef STARFOCUS_TEXT
#undef STARFOCUS_TEXT_OF
#define STARFOCUS_TEXT(name) #name
#define STARFOCUS_TEXT_OF(name) STARFOCUS_TEXT(name)
#undef STARFOCUS_DEPTH_ENTRY
#define STARFOCUS_DEPTH_ENTRY(Kernel) Kernel,

const DepthKernels* DepthTable() {
  static constexpr DepthKernels kernels = {&STARFOCUS_TEXT_OF(HWY_NAMESPACE)[2],
                                           STARFOCUS_DEPTH_KERNELS(STARFOCUS_DEPTH_ENTRY)};
  return &kernels;
}

}  // namespace HWY_NAMESPACE
}  // namespace starfocus::simd
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace starfocus::simd {

HWY_EXPORT(DepthTable);

const DepthKernels& BestDepthKernels() { return *HWY_DYNAMIC_DISPATCH(DepthTable)(); }

const DepthKernels& ReferenceDepthKernels() {
  using namespace reference;
  static constexpr DepthKernels kernels = {"reference",
                                           STARFOCUS_DEPTH_KERNELS(STARFOCUS_DEPTH_ENTRY)};
  return kernels;
}

}  // namespace starfocus::simd
#endif
