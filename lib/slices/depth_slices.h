// SPDX-License-Identifier: Apache-2.0
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

// Ranges of disparity that are told apart: single ones up to a blur of 64 pixels at full aperture.
inline constexpr int32_t kSliceBins = 2 * (64 << kDisparityBits) + 1;

struct SliceJob {
  const simd::Kernels* kernels;
  const LayeredDepth* surfaces;
  const ViewGrid* grid;
  SliceRule rule;
  Rect tile;            // in pixels of the surfaces
  uint8_t* bins;        // kSliceBins
  int32_t* least_blur;  // largest side of surfaces: scratch
};

// Finds the slices, the nearest first, that hold all pixels of the surfaces that may splat into a
// tile, and the disparities of the bands of the surfaces that FillSlice reads for it. Returns how
// many slices, at most job.rule.most.
int32_t FindSlices(const SliceJob& job, Slice* slices, SurfaceBands* bands);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_SLICES_DEPTH_SLICES_H_
