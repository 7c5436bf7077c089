// SPDX-License-Identifier: Apache-2.0
// The far surface's light where few pixels show it: means over growing cells, each of what is known
// of it, continued smoothly to where nothing is.
#ifndef STARFOCUS_LIB_COVERAGE_FAR_LIGHT_H_
#define STARFOCUS_LIB_COVERAGE_FAR_LIGHT_H_

#include "lib/coverage/coverage_map.h"

namespace starfocus {

// Makes the cells of levels 1 to 4 of a tile from those of level 0. A cell has the light of the
// farthest surface in it.
void PullTile(int32_t column, int32_t row, const CoverageMap& map);

// The far light of a tile's pixels; weight 0 where none is known around.
struct FarTile {
  FarCell cells[kCoverageTile * kCoverageTile];
};

// Fills what is not known at level 0 from the levels above, of this tile and those around it.
void PushTile(int32_t column, int32_t row, const CoverageMap& map, FarTile* far);

// a to the power of 8; kAlphaBits to kFarKnownBits.
constexpr int32_t EighthPower(int32_t a) {
  const int32_t square = a * a >> kAlphaBits, fourth = square * square >> kAlphaBits;
  return fourth * fourth >> (2 * kAlphaBits - kFarKnownBits);
}

// How much of the far surface's light a pixel shows that a nearer one covers by alpha.
constexpr int32_t FarWeight(int32_t alpha) { return EighthPower(kWhole - alpha); }

}  // namespace starfocus

#endif  // STARFOCUS_LIB_COVERAGE_FAR_LIGHT_H_
