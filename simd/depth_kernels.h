// SPDX-License-Identifier: Apache-2.0
// The table of SIMD kernels that make disparity maps. It is apart from that of the engine, so that
// a program which only refocuses doesn't hold them.
#ifndef STARFOCUS_SIMD_DEPTH_KERNELS_H_
#define STARFOCUS_SIMD_DEPTH_KERNELS_H_

#include <cstddef>

#include "simd/colours.h"
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

// Pointers to the kernels of one SIMD target, by their names.
struct DepthKernels {
  const char* name;  // of the target
#define STARFOCUS_MEMBER(Kernel) decltype(&reference::Kernel) Kernel;
  STARFOCUS_DEPTH_KERNELS(STARFOCUS_MEMBER)
#undef STARFOCUS_MEMBER
};

// The best target of this machine, chosen once by Highway.
const DepthKernels& BestDepthKernels();
// The references.
const DepthKernels& ReferenceDepthKernels();
// As KernelsOfTarget, for tests and the bench.
const DepthKernels* DepthKernelsOfTarget(size_t index);

}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_DEPTH_KERNELS_H_
