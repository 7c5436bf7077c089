// SPDX-License-Identifier: Apache-2.0
// One table of kernels for pictures and depth maps per SIMD target; Highway picks the best one of
// the machine.
#include "simd/image_kernels.h"

// As for kernels.cc, which says why.
#ifndef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS HWY_AVX3_DL
#endif
#ifndef HWY_BROKEN_EMU128
#define HWY_BROKEN_EMU128 1
#endif

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/image_kernels.cc"
#include "hwy/foreach_target.h"  // must precede highway.h
#include "hwy/highway.h"
#include "simd/depth_values-inl.h"
#include "simd/pixels-inl.h"
#include "simd/yuv-inl.h"

HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

// HWY_NAMESPACE is N_ and the target's name.
#undef STARFOCUS_TEXT
#undef STARFOCUS_TEXT_OF
#define STARFOCUS_TEXT(name) #name
#define STARFOCUS_TEXT_OF(name) STARFOCUS_TEXT(name)
#undef STARFOCUS_IMAGE_ENTRY
#define STARFOCUS_IMAGE_ENTRY(Kernel) Kernel,

const ImageKernels* ImageTable() {
  static constexpr ImageKernels kernels = {&STARFOCUS_TEXT_OF(HWY_NAMESPACE)[2],
                                           STARFOCUS_IMAGE_KERNELS(STARFOCUS_IMAGE_ENTRY)};
  return &kernels;
}

}  // namespace HWY_NAMESPACE
}  // namespace starfocus::simd
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace starfocus::simd {

HWY_EXPORT(ImageTable);

const ImageKernels& BestImageKernels() { return *HWY_DYNAMIC_DISPATCH(ImageTable)(); }

const ImageKernels& ReferenceImageKernels() {
  using namespace reference;
  static constexpr ImageKernels kernels = {"reference",
                                           STARFOCUS_IMAGE_KERNELS(STARFOCUS_IMAGE_ENTRY)};
  return kernels;
}

}  // namespace starfocus::simd
#endif
