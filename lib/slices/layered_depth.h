// SPDX-License-Identifier: Apache-2.0
// The layered depth image of a field. Surface 0 is what the centre view sees; up to two surfaces
// behind it at depth edges come from the captured views that see them. The compositor cuts its
// slices from these surfaces.
#ifndef STARFOCUS_LIB_SLICES_LAYERED_DEPTH_H_
#define STARFOCUS_LIB_SLICES_LAYERED_DEPTH_H_

#include <cstddef>
#include <cstdint>

#include "lib/input/block_pixels.h"
#include "lib/input/window.h"
#include "simd/kernels.h"

namespace starfocus {

using simd::kNoSurface;

// A larger step of disparity between neighbouring pixels at layer 0 is a depth edge,
// kDisparityBits.
inline constexpr int16_t kDepthEdge = (3 << kDisparityBits) / 4;

// Range of the steps of disparity between neighbouring pixels of one surface, at layer 0. The
// slices on both sides of such a step move apart. The surface is continued behind the step so that
// no background shows in the gap (docs/constants.md).
inline constexpr int16_t kLeastCopy = 2, kMostCopy = 1 << (kDisparityBits - 1);

// Largest width of surfaces, in strips of kSliceLanes columns.
inline constexpr int32_t kMaxStrips = 64;

// Surface 0 is the field itself, the nearest surface. Each surface is rows of `stride` pixels,
// followed by kSliceLanes more pixels. Colours are in three planes, `plane` samples apart.
struct LayeredDepth {
  int32_t width = 0, height = 0, stride = 0;
  size_t plane = 0;
  int16_t* disparity[simd::kSurfaces] = {};  // kDisparityBits
  int16_t* rgb[simd::kSurfaces] = {};        // light
  uint8_t* share = nullptr;   // share of the pixel that surface 0 covers, kSliceBits, or kSliceEnd
  int16_t low = 0, high = 0;  // range of the disparities of the field
  // Distance in pixels to the far side of the depth edge to the right, left, bottom and top that a
  // pixel hides; 0: it hides none.
  uint8_t* edges[4] = {};
  int16_t *moved = nullptr, *behind = nullptr;  // of FindEdges: one row each
  simd::StepBits* steps = nullptr;              // of FindSteps: one row
  // Source of the colour of each pixel of the hidden surfaces, in the format of LookBehind. Valid
  // only for groups whose bit in `hiding` is set.
  uint16_t* sources[simd::kSurfaces - 1] = {};
  bool repeats = false;        // true if the colour of any pixel is repeated
  uint64_t* hiding = nullptr;  // of each row: bit k is set if strip k has more than surface 0

  size_t At(int32_t x, int32_t y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(stride) + static_cast<size_t>(x);
  }
};

// Rows in a band: SurfaceBands holds one range of disparities for each band.
inline constexpr int32_t kBandRows = 8;

// Range of the disparities of all surfaces in each band around a tile.
struct SurfaceBands {
  static constexpr int32_t kMost = kMaxStrips * static_cast<int32_t>(simd::kSliceLanes) / kBandRows;
  simd::DisparityRange ranges[kMost];

  const simd::DisparityRange& At(int32_t row) const { return ranges[row / kBandRows]; }
  simd::DisparityRange& At(int32_t row) { return ranges[row / kBandRows]; }
};

// Finds the surfaces of a field. Surface 0 becomes a copy of the field. The memory of `surfaces`
// must be set.
//
// The surfaces behind a pixel are found along its row and its column. They lie beyond the next
// depth edge on each side and beyond the edge after that, as far as a view at distance 1 can see.
// At most two surfaces are kept; that of the nearest edge comes first.
//
// Their colours are read from a captured view that looks behind that edge (OcclusionViews) and in
// which nothing covers them. Without such a view the background is repeated. Sides with the same
// distance and disparity are averaged. Pixels within a surface hide copies of themselves
// (kLeastCopy).
void FindLayeredDepth(const simd::Kernels& kernels, const Window& window, const BlockPixels& field,
                      LayeredDepth* surfaces);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_SLICES_LAYERED_DEPTH_H_
