// SPDX-License-Identifier: Apache-2.0
// Tables of SIMD kernels. A table holds one pointer per kernel of a list, for one SIMD target.
// There are six tables, in units of their own, and a program links only the tables that it uses.
// `simd/table-inl.h` compiles a table for every target of `simd/targets.h`.
//
// Each kernel family x has two files. `x.h` contains the contracts, and beside each contract the
// reference, which is the plain C++ code that defines the result. `x-inl.h` contains the vector
// code, which produces bit-identical results on every target. Pointers require only the alignment
// of their type. Vector types never appear in `x.h`.
#ifndef STARFOCUS_SIMD_KERNELS_H_
#define STARFOCUS_SIMD_KERNELS_H_

#include <cstddef>

#include "simd/cells.h"
#include "simd/composite.h"
#include "simd/depth_values.h"
#include "simd/disparities.h"
#include "simd/gather.h"
#include "simd/hidden_fill.h"
#include "simd/layered_depth.h"
#include "simd/light.h"
#include "simd/line_scan.h"
#include "simd/match.h"
#include "simd/matting.h"
#include "simd/motion.h"
#include "simd/paths.h"
#include "simd/pixels.h"
#include "simd/resample.h"
#include "simd/samples.h"
#include "simd/slices.h"
#include "simd/words.h"

// STARFOCUS_MEMBER declares one member of a table. STARFOCUS_ENTRY is one entry of a table's
// initialiser and refers to the kernel of this name in scope.
#define STARFOCUS_MEMBER(Kernel) decltype(&reference::Kernel) Kernel;
#define STARFOCUS_ENTRY(Kernel) Kernel,

// Declares a table of the kernels of LIST, and three functions that return tables:
// - Best##Table returns the table of the best target of this machine. Highway chooses the target
//   once.
// - Reference##Table returns the table of the references.
// - Table##OfTarget returns the table of target `index`, or null if there are at most `index`
//   targets. `index` counts the targets that are compiled in and supported by this machine, from
//   the best to the worst. The function is slow, and temporarily changes Highway's choice of a
//   target for all threads.
// Reference##Table and Table##OfTarget are only for tests and the bench (targets.cc).
#define STARFOCUS_DECLARE_TABLE(Table, LIST) \
  struct Table {                             \
    const char* name; /* of the target */    \
    LIST(STARFOCUS_MEMBER)                   \
  };                                         \
  const Table& Best##Table();                \
  const Table& Reference##Table();           \
  const Table* Table##OfTarget(size_t index);

// List of the engine's kernels. The table, the reference, the vector code and the test case use one
// name for a kernel. The build fails if the table, the references, the vector code or the test
// cases lack a kernel of this list.
#define STARFOCUS_KERNELS(KERNEL) \
  KERNEL(Accumulate)              \
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
  KERNEL(Deinterleave)            \
  KERNEL(FindEdges)               \
  KERNEL(FindSteps)               \
  KERNEL(BesideSteps)             \
  KERNEL(FindCopies)              \
  KERNEL(InsertCopies)            \
  KERNEL(FindHidden)              \
  KERNEL(FindBeyond)              \
  KERNEL(CoverPlaces)             \
  KERNEL(SumNear)                 \
  KERNEL(CopyFarthest)            \
  KERNEL(LimitFar)                \
  KERNEL(SmoothFar)               \
  KERNEL(PutFarthest)             \
  KERNEL(SelectSlice)             \
  KERNEL(SpreadSlice)             \
  KERNEL(ShiftSlice)              \
  KERNEL(Composite)               \
  KERNEL(FinishComposite)         \
  KERNEL(MeasureCell)             \
  KERNEL(MeasureLines)            \
  KERNEL(ReachBlock)              \
  KERNEL(SurroundCells)           \
  KERNEL(WidenPhases)             \
  KERNEL(DeinterleavePhases)      \
  KERNEL(Narrow)                  \
  KERNEL(FinishLayer)             \
  KERNEL(FilterHalfBand)          \
  KERNEL(Halve)                   \
  KERNEL(Between)

// List of the kernels for disparity maps, which a program that only refocuses does not link.
#define STARFOCUS_DEPTH_KERNELS(KERNEL) \
  KERNEL(DeinterleaveRow)               \
  KERNEL(InterpolateRow)                \
  KERNEL(CostLabels)                    \
  KERNEL(AddPaths)                      \
  KERNEL(FindJumps)                     \
  KERNEL(ChooseLabels)                  \
  KERNEL(PropagatePrior)                \
  KERNEL(AddPrior)                      \
  KERNEL(SumVotes)                      \
  KERNEL(SmoothDisparity)

// List of the kernels that convert pictures and depth maps, which a program that only refocuses
// packed RGB does not link.
#define STARFOCUS_IMAGE_KERNELS(KERNEL) \
  KERNEL(YuvToRgb)                      \
  KERNEL(RgbToLuma)                     \
  KERNEL(RgbToChroma)                   \
  KERNEL(DeinterleavePairs)             \
  KERNEL(JoinPairs)                     \
  KERNEL(PixelsToRgb)                   \
  KERNEL(RgbToPixels)                   \
  KERNEL(BytesToDepth)                  \
  KERNEL(WordsToDepth)                  \
  KERNEL(Depth16ToDepth)                \
  KERNEL(HalvesToDepth)                 \
  KERNEL(DepthToDisparity)              \
  KERNEL(BlendRows)                     \
  KERNEL(UpsampleRow)

// List of the kernels of the line scan, which a program without the renderer of the paper does not
// link.
#define STARFOCUS_LINE_SCAN_KERNELS(KERNEL) \
  KERNEL(FindRuns)                          \
  KERNEL(Blend)

// List of the kernels that convert pictures of more than 8 bits, which a program without
// STARFOCUS_DEEP does not link.
#define STARFOCUS_WORD_KERNELS(KERNEL) \
  KERNEL(DitherWords)                  \
  KERNEL(YuvWordsToRgb)                \
  KERNEL(RgbToLumaWords)               \
  KERNEL(RgbToChromaWords)

// List of the kernels for videos, which a program without a stabiliser does not link.
#define STARFOCUS_VIDEO_KERNELS(KERNEL) \
  KERNEL(CompareSquares)                \
  KERNEL(LimitBlock)                    \
  KERNEL(FollowBlock)

namespace starfocus::simd {

STARFOCUS_DECLARE_TABLE(Kernels, STARFOCUS_KERNELS)
STARFOCUS_DECLARE_TABLE(DepthKernels, STARFOCUS_DEPTH_KERNELS)
STARFOCUS_DECLARE_TABLE(ImageKernels, STARFOCUS_IMAGE_KERNELS)
STARFOCUS_DECLARE_TABLE(LineScanKernels, STARFOCUS_LINE_SCAN_KERNELS)
STARFOCUS_DECLARE_TABLE(WordKernels, STARFOCUS_WORD_KERNELS)
STARFOCUS_DECLARE_TABLE(VideoKernels, STARFOCUS_VIDEO_KERNELS)

// Returns the table of the target with this name, or null if there is no such target. The
// restrictions of KernelsOfTarget apply to FindKernels as well.
const Kernels* FindKernels(const char* name);

}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_KERNELS_H_
