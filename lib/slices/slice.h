// SPDX-License-Identifier: Apache-2.0
// A slice: the part of a scene within a range of disparity so narrow that its pixels move together
// from view to view. Also the rules for the size of tiles and the number of their slices.
#ifndef STARFOCUS_LIB_SLICES_SLICE_H_
#define STARFOCUS_LIB_SLICES_SLICE_H_

#include <cstdint>

#include "lib/base/fixed.h"
#include "simd/kernels.h"

namespace starfocus {

// Limits on the number and thickness of the slices of a tile. Slices are made coarser until both
// limits hold.
struct SliceRule {
  int32_t most;  // largest number of slices
  // Range of the disparities of a slice, as the pixels of the layer that they move apart at the rim
  // of the aperture, kShiftBits. Beyond a blur of twice kSliceSharp the range grows in proportion
  // to the blur less kSliceSharp.
  int32_t range;
  int32_t area = 0;  // largest sum of SliceArea over all slices: MostSliceArea of the lens
};
inline constexpr int32_t kSliceSharp = 4 * kShiftOne;
inline constexpr SliceRule kSlices = {16, 3 * kShiftOne / 8};
inline constexpr SliceRule kFineSlices = {32, kShiftOne / 8};  // for the benchmark mode
inline constexpr int32_t kMaxSlices = simd::kMaxSeen;

// A tile is a part of a rectangle with its own slices. A large block as a whole has more
// disparities than SliceRule::most thin slices can hold. Tiles are kSliceTile wide and high. The
// last tile takes the rest up to kMostSliceTile. A block of 68 pixels at its layer, with its
// margin, is therefore one tile rather than two of 64 and 4 pixels.
inline constexpr int32_t kSliceTile = 64;
inline constexpr int32_t kMostSliceTile = 80;

// Returns the side of the next tile of a rectangle with `rest` pixels left.
constexpr int32_t SideOfTile(int32_t rest) { return rest <= kMostSliceTile ? rest : kSliceTile; }

// Returns the side of the largest tile of rectangles up to `side`.
constexpr int32_t LargestTile(int32_t side) {
  return side < kMostSliceTile ? side : kMostSliceTile;
}

// Size of the smallest part of a tile for which slices are made.
inline constexpr int32_t kLeastColumns = static_cast<int32_t>(simd::kSliceLanes);
inline constexpr int32_t kLeastRows = 8;

// Disparities [low, high] (kDisparityBits), which all move like `disparity`. Slightly nearer
// disparities, up to `overlap`, belong to this slice as well as to the nearer one, so that no gap
// opens between the two.
struct Slice {
  int16_t low, high, overlap, disparity;
};

}  // namespace starfocus

#endif  // STARFOCUS_LIB_SLICES_SLICE_H_
