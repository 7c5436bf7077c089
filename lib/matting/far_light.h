// SPDX-License-Identifier: Apache-2.0
// Estimates the light of the far surface in areas in which few pixels show the far surface. Means
// over cells of increasing size collect the known light and extend it smoothly to pixels without
// known light (the pull-push algorithm).
#ifndef STARFOCUS_LIB_MATTING_FAR_LIGHT_H_
#define STARFOCUS_LIB_MATTING_FAR_LIGHT_H_

#include "lib/matting/coverage_map.h"

namespace starfocus {

// Computes the light of the far surface in the cells of levels 1 to 4 of a tile, from the cells of
// level 0. Each cell gets the light of the farthest surface in the cell.
void PullTile(int32_t column, int32_t row, const CoverageMap& map);

// Light of the far surface at each pixel of a tile. The weight of a pixel is 0 if the light of the
// far surface is not known nearby.
struct FarTile {
  FarCell cells[kCoverageTile * kCoverageTile];
};

// Fills in unknown light of the far surface at the tile's pixels, from levels 1 to 4 of this tile
// and of the neighbouring tiles.
void PushTile(int32_t column, int32_t row, const CoverageMap& map, FarTile* far);

// Returns the eighth power of `a`. The argument has kAlphaBits fractional bits, and the result has
// kFarKnownBits fractional bits.
constexpr int32_t EighthPower(int32_t a) {
  const int32_t square = a * a >> kAlphaBits, fourth = square * square >> kAlphaBits;
  return fourth * fourth >> (2 * kAlphaBits - kFarKnownBits);
}

// Returns the weight of a pixel in a mean of the far surface's light. `alpha` is the coverage of
// the pixel by a nearer surface.
constexpr int32_t FarWeight(int32_t alpha) { return EighthPower(kWhole - alpha); }

}  // namespace starfocus

#endif  // STARFOCUS_LIB_MATTING_FAR_LIGHT_H_
