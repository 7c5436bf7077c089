// SPDX-License-Identifier: Apache-2.0
// The table of SIMD kernels that make disparity maps. It is apart from that of the engine, so that
// a program which only refocuses doesn't hold them.
#ifndef STARFOCUS_SIMD_DEPTH_KERNELS_H_
#define STARFOCUS_SIMD_DEPTH_KERNELS_H_

#include "simd/colours.h"
#include "simd/kernel_table.h"
#include "simd/label_costs.h"
#include "simd/paths.h"
#include "simd/planes.h"
#include "simd/prior.h"
#include "simd/smooth.h"

// All of them, as STARFOCUS_KERNELS (simd/kernels.h).
#define STARFOCUS_DEPTH_KERNELS(KERNEL) \
  KERNEL(SplitRow)                      \
  KERNEL(InterpolateRow)                \
  KERNEL(CostLabels)                    \
  KERNEL(AddPaths)                      \
  KERNEL(FindJumps)                     \
  KERNEL(ChooseLabels)                  \
  KERNEL(SpreadPrior)                   \
  KERNEL(AddPrior)                      \
  KERNEL(CompareColours)                \
  KERNEL(SmoothDisparity)

namespace starfocus::simd {

STARFOCUS_DECLARE_TABLE(DepthKernels, STARFOCUS_DEPTH_KERNELS)

}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_DEPTH_KERNELS_H_
