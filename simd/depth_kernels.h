// SPDX-License-Identifier: Apache-2.0
// Table of the SIMD kernels for disparity maps. The table is separate from the engine's table, so
// that a program that only refocuses does not link these kernels.
#ifndef STARFOCUS_SIMD_DEPTH_KERNELS_H_
#define STARFOCUS_SIMD_DEPTH_KERNELS_H_

#include "simd/kernel_table.h"
#include "simd/match.h"
#include "simd/matting.h"
#include "simd/paths.h"
#include "simd/planes.h"

// List of the kernels for disparity maps, in the format of STARFOCUS_KERNELS (simd/kernels.h).
#define STARFOCUS_DEPTH_KERNELS(KERNEL) \
  KERNEL(SplitRow)                      \
  KERNEL(InterpolateRow)                \
  KERNEL(CostLabels)                    \
  KERNEL(AddPaths)                      \
  KERNEL(FindJumps)                     \
  KERNEL(ChooseLabels)                  \
  KERNEL(SpreadPrior)                   \
  KERNEL(AddPrior)                      \
  KERNEL(SumVotes)                      \
  KERNEL(SmoothDisparity)

namespace starfocus::simd {

STARFOCUS_DECLARE_TABLE(DepthKernels, STARFOCUS_DEPTH_KERNELS)

}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_DEPTH_KERNELS_H_
