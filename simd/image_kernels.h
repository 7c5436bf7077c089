// SPDX-License-Identifier: Apache-2.0
// The table of SIMD kernels that convert pictures and depth maps. It is apart from that of the
// engine, so that a program which refocuses R, G, B alone doesn't hold them.
#ifndef STARFOCUS_SIMD_IMAGE_KERNELS_H_
#define STARFOCUS_SIMD_IMAGE_KERNELS_H_

#include "simd/depth_values.h"
#include "simd/kernel_table.h"
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

STARFOCUS_DECLARE_TABLE(ImageKernels, STARFOCUS_IMAGE_KERNELS)

}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_IMAGE_KERNELS_H_
