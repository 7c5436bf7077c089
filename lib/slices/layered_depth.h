// SPDX-License-Identifier: Apache-2.0
// The surfaces of a field, one behind the other: what the centre view sees, and behind it at depth
// edges what captured views see there.
#ifndef STARFOCUS_LIB_SLICES_LAYERED_DEPTH_H_
#define STARFOCUS_LIB_SLICES_LAYERED_DEPTH_H_

#include <cstddef>
#include <cstdint>

#include "lib/input/block_pixels.h"
#include "lib/input/window.h"
#include "simd/kernels.h"

namespace starfocus {

using simd::kNoSurface;

// A larger step of disparity from pixel to pixel, at layer 0, may hide something: kDisparityBits.
inline constexpr int16_t kDepthEdge = (3 << kDisparityBits) / 4;

// Steps of disparity from pixel to pixel within a surface, at layer 0, behind which the surface
// goes on: its slices move apart, and what lies behind must not show between them
// (docs/constants.md).
inline constexpr int16_t kLeastCopy = 2, kMostCopy = 1 << (kDisparityBits - 1);

// The widest surfaces, by kSliceLanes columns.
inline constexpr int32_t kMaxStrips = 64;

// Surface 0 is the field itself, the nearest one. Rows of `stride` pixels, then kSliceLanes more;
// colours in three planes, `plane` apart.
struct LayeredDepth {
  int32_t width = 0, height = 0, stride = 0;
  size_t plane = 0;
  int16_t* disparity[simd::kSurfaces] = {};  // kDisparityBits
  int16_t* rgb[simd::kSurfaces] = {};        // light
  uint8_t* share = nullptr;   // of the pixel that surface 0 covers, kSliceBits, or kSliceEnd
  int16_t low = 0, high = 0;  // disparities of the field
  // Pixels to the far side of the depth edge to the right, left, bottom and top that a pixel hides;
  // 0: it hides none.
  uint8_t* edges[4] = {};
  int16_t *moved = nullptr, *behind = nullptr;  // of FindEdges: a row
  simd::StepBits* steps = nullptr;              // of FindSteps: a row
  // Where the colour of each pixel of the hidden surfaces was found, as LookBehind tells it; only
  // where `hiding` has them.
  uint16_t* sources[simd::kSurfaces - 1] = {};
  bool repeats = false;        // whether the colour of any pixel is one that is repeated
  uint64_t* hiding = nullptr;  // of each row: in which kSliceLanes there is more than surface 0

  size_t At(int32_t x, int32_t y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(stride) + static_cast<size_t>(x);
  }
};

// Rows of surfaces whose disparities are looked at together.
inline constexpr int32_t kBandRows = 8;

// The disparities of all surfaces of each band, around a tile.
struct SurfaceBands {
  static constexpr int32_t kMost = kMaxStrips * static_cast<int32_t>(simd::kSliceLanes) / kBandRows;
  simd::DisparityRange ranges[kMost];

  const simd::DisparityRange& At(int32_t row) const { return ranges[row / kBandRows]; }
  simd::DisparityRange& At(int32_t row) { return ranges[row / kBandRows]; }
};

// Finds them for a field, which surface 0 is a copy of and covers all of. Behind a pixel lies what
// its row and its column show behind the next depth edge on either side and behind the one after
// it, as far as a view at distance 1 can look there: at most two surfaces, the nearest edge's
// first. Their colours are read from a captured view that looks round that edge
// (OcclusionViews) and in which nothing covers them; without one the background goes on. Sides with
// the same distance and disparity give their mean. Pixels within a surface hide copies of
// themselves (kLeastCopy). The memory of `surfaces` must be set.
void FindLayeredDepth(const simd::Kernels& kernels, const Window& window, const BlockPixels& field,
                      LayeredDepth* surfaces);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_SLICES_LAYERED_DEPTH_H_
