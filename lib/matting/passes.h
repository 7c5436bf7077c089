// SPDX-License-Identifier: Apache-2.0
// Runs the passes that compute a coverage map, tile by tile. Defines how many rows of tiles each
// pass must be ahead of the last pass (TilesAhead).
#ifndef STARFOCUS_LIB_MATTING_PASSES_H_
#define STARFOCUS_LIB_MATTING_PASSES_H_

#include "lib/base/features.h"
#include "lib/base/fixed.h"
#include "lib/matting/coverage_map.h"
#include "starfocus/starfocus.h"

namespace starfocus {

enum CoveragePass { kFindRagged, kStart, kUnmixFirst, kLook, kUnmixAgain, kCoveragePasses };

// Runs a pass on the tiles [first, last) of a row. All earlier passes must already be as many rows
// of tiles ahead as TilesAhead requires.
void RunPass(const CoverageInput& in, int pass, int32_t first, int32_t last, int32_t row);

// Value of CoverageMap::around if the light field has coverage, because edges are then searched up
// to two tiles away.
inline constexpr int32_t kAroundGiven = 2;

// Returns the largest movement in pixels of a nearer surface relative to a farther surface, in any
// view that is read.
inline int32_t LargestMoveBefore(const starfocus_config& config) {
  if (config.views == 1) return 0;
  const float range = MaxDisparity(config) - MinDisparity(config);
  return Min(static_cast<int32_t>(range) + 3, kMostMove + 1);
}

// Returns the number of rows of tiles by which a pass must be ahead of the last pass.
inline int32_t TilesAhead(const starfocus_config& config, int pass) {
  const int32_t moved = (LargestMoveBefore(config) + kCoverageTile - 1) / kCoverageTile;
  switch (pass) {
    case kUnmixAgain:
      return 0;
    case kLook:
      // UnmixAgain fills in unknown light of the far surface from the surrounding tiles, so it
      // requires this light in the next row of tiles.
      return 1;
    case kUnmixFirst:
      // A tile next to a mixed tile is thin, so the Look pass requires `mixed` one row ahead.
      return 1 + Max(1, moved);
    case kStart:
      return TilesAhead(config, kUnmixFirst) + 1;
    default:
      return TilesAhead(config, kStart) + 1;
  }
}

// Returns the distance in pixels from a split pixel to the farthest pixels that the passes read.
// Returns 0 if the engine has no memory for coverage.
inline int32_t CoverageBorder(const starfocus_config& config) {
  if (!Has(config, STARFOCUS_FEATURE_COVERAGE)) return 0;
  return (TilesAhead(config, kFindRagged) + 1) * kCoverageTile + kBandReach + 2;
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_MATTING_PASSES_H_
