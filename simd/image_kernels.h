// SPDX-License-Identifier: Apache-2.0
// Table of the SIMD kernels that convert pictures and depth maps. The table is separate from the
// engine's table, so that a program that only refocuses packed RGB does not link these kernels.
#ifndef STARFOCUS_SIMD_IMAGE_KERNELS_H_
#define STARFOCUS_SIMD_IMAGE_KERNELS_H_

#include "simd/depth_values.h"
#include "simd/kernel_table.h"
#include "simd/pixels.h"

// List of the conversion kernels, in the format of STARFOCUS_KERNELS (simd/kernels.h).
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
  KERNEL(Depth16ToDepth)                \
  KERNEL(HalvesToDepth)                 \
  KERNEL(DepthToDisparity)              \
  KERNEL(BlendRows)                     \
  KERNEL(SpreadRow)

namespace starfocus::simd {

STARFOCUS_DECLARE_TABLE(ImageKernels, STARFOCUS_IMAGE_KERNELS)

}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_IMAGE_KERNELS_H_
