// Slices: the parts of a scene within ranges of disparity so small that each moves as one from view
// to view.
#ifndef STARFOCUS_LIB_SLICES_DEPTH_SLICES_H_
#define STARFOCUS_LIB_SLICES_DEPTH_SLICES_H_

#include <cstdint>

#include "lib/base/geometry.h"
#include "lib/base/view_grid.h"
#include "lib/slices/layered_depth.h"
#include "lib/slices/slice.h"

namespace starfocus {

// What all slices together may take; beyond it they get coarser. Those of a rectangle would cost
// more than they add: samples of kLargeSlices of the largest reach, rows of kLargeTiles in tiles,
// so that a narrow rectangle may have more slices than a wide one. And bytes of its least section:
// slices are in memory for a section of a rectangle at a time.
struct SliceLimits {
  size_t samples, rows, bytes;
};
inline constexpr size_t kLargeSlices = 6;
inline constexpr size_t kLargeTiles = 12;

// Ranges of disparity that are told apart: single ones up to a blur of 64 pixels at full aperture.
inline constexpr int32_t kSliceBins = 2 * (64 << kDisparityBits) + 1;

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
