// SPDX-License-Identifier: Apache-2.0
// Table of the engine's SIMD kernels. Each family has three files. `x.h` holds the contracts,
// `x_ref.cc` the plain C++ that defines every result, and `x-inl.h` the vector code, which gives
// the same bits on each target. Pointers need only the alignment of their type. Vector types never
// appear in a header.
#ifndef STARFOCUS_SIMD_KERNELS_H_
#define STARFOCUS_SIMD_KERNELS_H_

#include "simd/cells.h"
#include "simd/coverage.h"
#include "simd/disc.h"
#include "simd/disparities.h"
#include "simd/finish_composite.h"
#include "simd/hidden_fill.h"
#include "simd/kernel_table.h"
#include "simd/layered_depth.h"
#include "simd/light.h"
#include "simd/neighbourhood.h"
#include "simd/padding.h"
#include "simd/resample.h"
#include "simd/runs.h"
#include "simd/slices.h"
#include "simd/slope.h"
#include "simd/spans.h"
#include "simd/strips.h"

// List of all kernels. A kernel has the same name in the table, its reference, its vector code and
// its test case. Each name in this list must exist in all of them, or the build fails.
#define STARFOCUS_KERNELS(KERNEL) \
  KERNEL(Accumulate)              \
  KERNEL(Blend)                   \
  KERNEL(Decode)                  \
  KERNEL(Encode)                  \
  KERNEL(Finish)                  \
  KERNEL(FilterDisc)              \
  KERNEL(FilterDiscLayer)         \
  KERNEL(FilterTwoDiscs)          \
  KERNEL(MixSamples)              \
  KERNEL(MoveSamples)             \
  KERNEL(ConvertDisparity)        \
  KERNEL(FindRanges)              \
  KERNEL(FindWithin)              \
  KERNEL(Split)                   \
  KERNEL(FindEdges)               \
  KERNEL(FindSteps)               \
  KERNEL(BesideSteps)             \
  KERNEL(FindCopies)              \
  KERNEL(LookBehind)              \
  KERNEL(CoverPlaces)             \
  KERNEL(SumNear)                 \
  KERNEL(TakeFarthest)            \
  KERNEL(SmoothFar)               \
  KERNEL(PutFarthest)             \
  KERNEL(SelectSlice)             \
  KERNEL(SpreadSlice)             \
  KERNEL(ShiftSlice)              \
  KERNEL(Composite)               \
  KERNEL(FinishComposite)         \
  KERNEL(FindRuns)                \
  KERNEL(MeasureCell)             \
  KERNEL(ReachBlock)              \
  KERNEL(SurroundCells)           \
  KERNEL(WidenPhases)             \
  KERNEL(SplitPhases)             \
  KERNEL(Narrow)                  \
  KERNEL(FinishLayer)             \
  KERNEL(FilterHalfBand)          \
  KERNEL(Halve)                   \
  KERNEL(Between)

namespace starfocus::simd {

STARFOCUS_DECLARE_TABLE(Kernels, STARFOCUS_KERNELS)

// Returns the table of the target with this name, like KernelsOfTarget. Null if no target has it.
const Kernels* FindKernels(const char* name);

}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_KERNELS_H_
