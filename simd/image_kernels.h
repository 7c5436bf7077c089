// SPDX-License-Identifier: Apache-2.0
// The table of SIMD kernels that convert pictures and depth maps. It is apart from that of the
// engine, so that a program which refocuses R, G, B alone doesn't hold them.
#ifndef STARFOCUS_SIMD_IMAGE_KERNELS_H_
#define STARFOCUS_SIMD_IMAGE_KERNELS_H_

#include <cstddef>

#include "simd/depth_values.h"
#include "simd/pixels.h"
#include "simd/yuv.h"

// All of them, as STARFOCUS_KERNELS (simd/kernels.h).
#define STARFOCUS_IMAGE_KERNELS(KERNEL) \
  KERNEL(YuvToRgb)                      \
  KERNEL(RgbToLuma)                     \
  KERNEL(RgbToChroma)                   \
  KERNEL(SplitPairs)                    \
  KERNEL(JoinPairs)                     \
  KERNEL(PixelsToRgb)                   \
  KERNEL(RgbToPixels)                   \
  KERNEL(BytesToDepth)                  \
  KERNEL(WordsToDepth)                  \
  KERNEL(HalvesToDepth)                 \
  KERNEL(DepthToDisparity)              \
  KERNEL(BlendRows)                     \
  KERNEL(SpreadRow)

namespace starfocus::simd {

// Pointers to the kernels of one SIMD target, by their names.
struct ImageKernels {
  const char* name;  // of the target
#define STARFOCUS_MEMBER(Kernel) decltype(&reference::Kernel) Kernel;
  STARFOCUS_IMAGE_KERNELS(STARFOCUS_MEMBER)
#undef STARFOCUS_MEMBER
};

// The best target of this machine, chosen once by Highway.
const ImageKernels& BestImageKernels();
// The references.
const ImageKernels& ReferenceImageKernels();
// As KernelsOfTarget, for tests and the bench.
const ImageKernels* ImageKernelsOfTarget(size_t index);

}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_IMAGE_KERNELS_H_
