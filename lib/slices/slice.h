// SPDX-License-Identifier: Apache-2.0
// What a slice is: a part of the scene within a range of disparity so small that it moves as one
// from view to view.
#ifndef STARFOCUS_LIB_SLICES_SLICE_H_
#define STARFOCUS_LIB_SLICES_SLICE_H_

#include <cstdint>

#include "lib/base/fixed.h"
#include "simd/kernels.h"

namespace starfocus {

// Number and thickness of the slices of a tile. Slices get coarser until both limits hold.
struct SliceRule {
  int32_t most;  // number of slices
  // Pixels of the layer that a slice's disparities may lie apart at the aperture's rim, kShiftBits;
  // where they are more blurred than twice kSliceSharp, as much more as what is beyond it.
  int32_t range;
  int32_t area = 0;  // sum of SliceArea over all slices, MostSliceArea of the lens
};
inline constexpr int32_t kSliceSharp = 4 * kShiftOne;
inline constexpr SliceRule kSlices = {16, 3 * kShiftOne / 8};
inline constexpr SliceRule kFineSlices = {32, kShiftOne / 8};  // of the benchmark mode
inline constexpr int32_t kMaxSlices = simd::kMaxSeen;

// A tile is a part of a rectangle that has slices of its own. A whole large block has more
// disparities than SliceRule::most slices are thin enough for. Tiles are kSliceTile wide and high,
// but the last one takes what is left up to kMostSliceTile: the 68 pixels that a layer has of a
// block, with its margin, are one tile and not 64 and 4 pixels.
inline constexpr int32_t kSliceTile = 64;
inline constexpr int32_t kMostSliceTile = 80;

// The side of the next tile of a rectangle of which `rest` pixels are left.
constexpr int32_t SideOfTile(int32_t rest) { return rest <= kMostSliceTile ? rest : kSliceTile; }

// The side of the largest tile of rectangles up to `side`.
constexpr int32_t LargestTile(int32_t side) {
  return side < kMostSliceTile ? side : kMostSliceTile;
}

// The least part of a tile that slices are made of.
inline constexpr int32_t kLeastColumns = static_cast<int32_t>(simd::kSliceLanes);
inline constexpr int32_t kLeastRows = 8;

// Disparities [low, high] (kDisparityBits), which move as `disparity` does. Those up to `overlap`,
// a little nearer, are part of this slice as well as of the nearer one, so that no gap opens
// between both.
struct Slice {
  int16_t low, high, overlap, disparity;
};

}  // namespace starfocus

#endif  // STARFOCUS_LIB_SLICES_SLICE_H_
