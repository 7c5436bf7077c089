// SPDX-License-Identifier: Apache-2.0
// Defines the slice: the part of a scene within a range of disparities so narrow that all pixels
// move together from view to view. Also defines the limits on the size of tiles and on the number
// of slices in a tile.
#ifndef STARFOCUS_LIB_SLICES_SLICE_H_
#define STARFOCUS_LIB_SLICES_SLICE_H_

#include <cstdint>

#include "lib/base/fixed.h"
#include "simd/kernels.h"

namespace starfocus {

// Limits on the number and thickness of the slices of a tile. The compositor makes the slices
// coarser until all limits hold.
struct SliceRule {
  int32_t most;  // largest number of slices
  // Range of the disparities of a slice. The range is stated as the distance by which the nearest
  // and farthest disparity move apart at the rim of the aperture, in pixels of the layer
  // (kShiftBits). For blur radii above twice kSliceSharp, the range is proportional to the blur
  // radius minus kSliceSharp.
  int32_t range;
  int32_t area = 0;  // largest sum of SliceArea over all slices: MostSliceArea for the lens
};
inline constexpr int32_t kSliceSharp = 4 * kShiftOne;
inline constexpr SliceRule kSlices = {16, 3 * kShiftOne / 8};
inline constexpr SliceRule kFineSlices = {32, kShiftOne / 8};  // limits for mode `benchmark`
inline constexpr int32_t kMaxSlices = simd::kMaxSeen;

// A tile is a part of a rectangle of the picture, and has its own slices. Large blocks are divided
// into tiles, because a large block may have more disparities than SliceRule::most thin slices can
// hold. Tiles are kSliceTile pixels wide and high, except that the last tile may have up to
// kMostSliceTile pixels. A block that measures 68 pixels with its margin is therefore one tile, not
// two tiles of 64 and 4 pixels.
inline constexpr int32_t kSliceTile = 64;
inline constexpr int32_t kMostSliceTile = 80;

// Returns the side of the next tile of a rectangle, of which `rest` pixels are not yet in a tile.
constexpr int32_t SideOfTile(int32_t rest) { return rest <= kMostSliceTile ? rest : kSliceTile; }

// Returns the side of the largest tile of rectangles whose sides are at most `side` pixels.
constexpr int32_t LargestTile(int32_t side) {
  return side < kMostSliceTile ? side : kMostSliceTile;
}

// Size in pixels of the smallest part of a tile for which slices are made.
inline constexpr int32_t kLeastColumns = static_cast<int32_t>(simd::kSliceLanes);
inline constexpr int32_t kLeastRows = 8;

// A slice contains the disparities [low, high] (kDisparityBits); all pixels of the slice move like
// `disparity`. Slightly nearer disparities, up to `overlap`, belong to two slices: to this slice
// and to the next nearer slice. The overlap prevents gaps between the two slices.
struct Slice {
  int16_t low, high, overlap, disparity;
};

}  // namespace starfocus

#endif  // STARFOCUS_LIB_SLICES_SLICE_H_
