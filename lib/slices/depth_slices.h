// Slices: the parts of a scene within ranges of disparity so small that each moves as one from view
// to view.
#ifndef STARFOCUS_LIB_SLICES_DEPTH_SLICES_H_
#define STARFOCUS_LIB_SLICES_DEPTH_SLICES_H_

#include <cstdint>

#include "lib/base/view_grid.h"
#include "lib/input/field.h"
#include "lib/slices/layered_depth.h"

namespace starfocus {

// How finely a scene is cut.
struct SliceRule {
  int32_t most;  // beyond this many, slices get coarser
  // Pixels of the layer that a slice's disparities may lie apart at the aperture's rim, kShiftBits;
  // where they are more blurred than twice kSliceSharp, as much more as what is beyond it.
  int32_t range;
};
inline constexpr int32_t kSliceSharp = 4 * kShiftOne;
inline constexpr SliceRule kSlices = {16, 3 * kShiftOne / 8};
inline constexpr SliceRule kFineSlices = {32, kShiftOne / 8};  // of the benchmark mode
inline constexpr int32_t kMaxSlices = simd::kMaxSeen;

// What all slices together may take; beyond it they get coarser. Those of a rectangle would cost
// more than they add: samples of kLargeSlices of the largest reach, rows of kLargeTiles in tiles,
// so that a narrow rectangle may have more slices than a wide one. And bytes of its least section:
// slices are in memory for a section of a rectangle at a time.
struct SliceLimits {
  size_t samples, rows, bytes;
};
inline constexpr size_t kLargeSlices = 6;
inline constexpr size_t kLargeTiles = 12;
inline constexpr int32_t kLeastColumns = static_cast<int32_t>(simd::kSliceLanes);
inline constexpr int32_t kLeastRows = 8;

// Ranges of disparity that are told apart: single ones up to a blur of 64 pixels at full aperture.
inline constexpr int32_t kSliceBins = 2 * (64 << kDisparityBits) + 1;

// Disparities [low, high] (kDisparityBits), which move as `disparity` does. Those up to `overlap`,
// a little nearer, are part of this slice as well as of the nearer one, so that no gap opens
// between both.
struct Slice {
  int16_t low, high, overlap, disparity;
};

struct SliceJob {
  const simd::Kernels* kernels;
  const LayeredDepth* surfaces;
  const ViewGrid* grid;
  SliceRule rule;
  Rect rect;            // in pixels of the surfaces
  uint8_t* bins;        // kSliceBins
  int32_t* least_blur;  // largest side of surfaces: scratch
  SliceLimits limits;
};

// Finds the slices, the nearest first, that hold all pixels of the surfaces that may splat into a
// rectangle. Returns how many, at most job.rule.most.
int32_t FindSlices(const SliceJob& job, Slice* slices);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_SLICES_DEPTH_SLICES_H_
