// SPDX-License-Identifier: Apache-2.0
// Estimates the light of the far surface where few pixels show it. Means over growing cells collect
// the known light, and continue it smoothly to pixels without any (pull and push).
#ifndef STARFOCUS_LIB_COVERAGE_FAR_LIGHT_H_
#define STARFOCUS_LIB_COVERAGE_FAR_LIGHT_H_

#include "lib/coverage/coverage_map.h"

namespace starfocus {

// Computes levels 1 to 4 of a tile from level 0. A cell has the light of the farthest surface in
// it.
void PullTile(int32_t column, int32_t row, const CoverageMap& map);

// Far light of the pixels of a tile; weight 0 where none is known nearby.
struct FarTile {
  FarCell cells[kCoverageTile * kCoverageTile];
};

// Fills the unknown light at level 0 from the levels above, of this tile and of those around it.
void PushTile(int32_t column, int32_t row, const CoverageMap& map, FarTile* far);

// Returns the eighth power of `a`: kAlphaBits to kFarKnownBits.
constexpr int32_t EighthPower(int32_t a) {
  const int32_t square = a * a >> kAlphaBits, fourth = square * square >> kAlphaBits;
  return fourth * fourth >> (2 * kAlphaBits - kFarKnownBits);
}

// Returns the weight of the far surface's light in a pixel of which a nearer surface covers alpha.
constexpr int32_t FarWeight(int32_t alpha) { return EighthPower(kWhole - alpha); }

}  // namespace starfocus

#endif  // STARFOCUS_LIB_COVERAGE_FAR_LIGHT_H_
