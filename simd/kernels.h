// SPDX-License-Identifier: Apache-2.0
// Table of the engine's SIMD kernels. Each kernel family x has two files. `x.h` contains the
// contracts, and beside each contract the reference, which is the plain C++ code that defines the
// result. `x-inl.h` contains the vector code, which produces bit-identical results on every target.
// Pointers require only the alignment of their type. Vector types never appear in `x.h`.
#ifndef STARFOCUS_SIMD_KERNELS_H_
#define STARFOCUS_SIMD_KERNELS_H_

#include "simd/cells.h"
#include "simd/composite.h"
#include "simd/disparities.h"
#include "simd/gather.h"
#include "simd/hidden_fill.h"
#include "simd/kernel_table.h"
#include "simd/layered_depth.h"
#include "simd/light.h"
#include "simd/matting.h"
#include "simd/resample.h"
#include "simd/runs.h"
#include "simd/samples.h"
#include "simd/slices.h"
#include "simd/spans.h"

// List of all kernels. The table, the reference, the vector code and the test case use one name for
// a kernel. The build fails if the table, the references, the vector code or the test cases lack a
// kernel of this list.
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
  KERNEL(ColourCopies)            \
  KERNEL(LookBehind)              \
  KERNEL(FindBeyond)              \
  KERNEL(CoverPlaces)             \
  KERNEL(SumNear)                 \
  KERNEL(TakeFarthest)            \
  KERNEL(LimitFar)                \
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

// Returns the table of the target with this name, or null if there is no such target. The
// restrictions of KernelsOfTarget (kernel_table.h) apply to FindKernels as well.
const Kernels* FindKernels(const char* name);

}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_KERNELS_H_
