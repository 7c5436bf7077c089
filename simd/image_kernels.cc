// SPDX-License-Identifier: Apache-2.0
// One table of kernels for pictures and depth maps per SIMD target; Highway picks the best one of
// the machine.
#include "simd/image_kernels.h"

#include "simd/targets.h"  // before those of Highway

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/image_kernels.cc"
#include "hwy/foreach_target.h"  // must precede highway.h
#include "hwy/highway.h"
#include "simd/depth_values-inl.h"
#include "simd/pixels-inl.h"
#include "simd/yuv-inl.h"

#ifndef STARFOCUS_TABLE
#define STARFOCUS_TABLE ImageKernels
#define STARFOCUS_LIST STARFOCUS_IMAGE_KERNELS
#define STARFOCUS_BEST BestImageKernels
#endif
#include "simd/table-inl.h"

#if HWY_ONCE
namespace starfocus::simd {

const ImageKernels& ReferenceImageKernels() {
  using namespace reference;
  static constexpr ImageKernels kernels = {"reference", STARFOCUS_IMAGE_KERNELS(STARFOCUS_ENTRY)};
  return kernels;
}

}  // namespace starfocus::simd
#endif
