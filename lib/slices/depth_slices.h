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

// What all slices of a cut together may take; beyond it they get coarser. More would cost more
// than they add. `samples` are those of kLargeSlices of a cut of kCutSide, `rows` those of
// kLargeTiles in tiles, so that a narrow cut may have more slices than a wide one; `bytes` are
// those of the least section, since slices are in memory for a section of a cut at a time.
// docs/constants.md has what half and twice of them cost and gain.
struct SliceLimits {
  size_t samples, rows, bytes;
};
inline constexpr size_t kLargeSlices = 6;
inline constexpr size_t kLargeTiles = 12;
inline constexpr size_t kLeastSlices = 5;

// The limits of a lens with blur radii up to `blur` pixels, with blocks up to `side`. They decide
// how finely a picture is cut, and so its bytes: they are made of numbers alone that the caller
// gives, neither of the memory there is nor of what it is made for. With d = max(blur, 32), rounded
// up, slices that reach d + 4 pixels beyond their cut, and s = min(side, kCutSide):
//
//   samples  SliceSize of kLargeSlices slices of a cut of s by s pixels
//   rows     ShiftedRows of kLargeTiles of them
//   bytes    the most of 442368, 119 s^2, and kLeastSlices of the least section's slices
//            (SliceBytes and TileBytes of 16 by 8 pixels)
//
// With less for blurs below 32 pixels, slices of narrow cuts would get coarser: 0.1 to 0.5 dB. The
// bytes are what a worker has for slices at 32.
SliceLimits LimitsOfSlices(int32_t side, double blur);

// Ranges of disparity that are told apart: single ones up to a blur of 64 pixels at full aperture.
inline constexpr int32_t kSliceBins = 2 * (64 << kDisparityBits) + 1;

struct SliceJob {
  const simd::Kernels* kernels;
  const LayeredDepth* surfaces;
  const ViewGrid* grid;
  SliceRule rule;
  Rect cut;             // in pixels of the surfaces
  uint8_t* bins;        // kSliceBins
  int32_t* least_blur;  // largest side of surfaces: scratch
  SliceLimits limits;
};

// Finds the slices, the nearest first, that hold all pixels of the surfaces that may splat into a
// cut, and the disparities of the bands of the surfaces that FillSlice reads for it. Returns how
// many slices, at most job.rule.most.
int32_t FindSlices(const SliceJob& job, Slice* slices, SurfaceBands* bands);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_SLICES_DEPTH_SLICES_H_
