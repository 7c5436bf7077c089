// SPDX-License-Identifier: Apache-2.0
// One table of depth kernels per SIMD target; Highway picks the best one of the machine.
#include "simd/depth_kernels.h"

#include "simd/targets.h"  // before those of Highway

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/depth_kernels.cc"
#include "hwy/foreach_target.h"  // must precede highway.h
#include "hwy/highway.h"
#include "simd/colours-inl.h"
#include "simd/label_costs-inl.h"
#include "simd/paths-inl.h"
#include "simd/planes-inl.h"
#include "simd/prior-inl.h"
#include "simd/smooth-inl.h"

#ifndef STARFOCUS_TABLE
#define STARFOCUS_TABLE DepthKernels
#define STARFOCUS_LIST STARFOCUS_DEPTH_KERNELS
#define STARFOCUS_BEST BestDepthKernels
#endif
#include "simd/table-inl.h"

#if HWY_ONCE
namespace starfocus::simd {

const DepthKernels& ReferenceDepthKernels() {
  using namespace reference;
  static constexpr DepthKernels kernels = {"reference", STARFOCUS_DEPTH_KERNELS(STARFOCUS_ENTRY)};
  return kernels;
}

}  // namespace starfocus::simd
#endif
