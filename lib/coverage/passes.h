// SPDX-License-Identifier: Apache-2.0
// The passes that find a coverage map, tile by tile, and how far each is ahead of the next one.
#ifndef STARFOCUS_LIB_COVERAGE_PASSES_H_
#define STARFOCUS_LIB_COVERAGE_PASSES_H_

#include "lib/base/features.h"
#include "lib/base/fixed.h"
#include "lib/coverage/coverage_input.h"
#include "starfocus/starfocus.h"

namespace starfocus {

enum CoveragePass { kFindRagged, kStart, kUnmixFirst, kLook, kUnmixAgain, kCoveragePasses };

// Does a pass in the tiles [first, last) of a row. The passes before it have been done as far ahead
// as TilesAhead says.
void RunPass(const CoverageInput& in, int pass, int32_t first, int32_t last, int32_t row);

// Whether the engine has memory for coverage.
inline bool HasCoverage(const starfocus_config& config) {
  return Has(config.features, STARFOCUS_FEATURE_COVERAGE);
}

// CoverageMap::around where coverage is given: pixels look two tiles far for edges.
inline constexpr int32_t kAroundGiven = 2;

// The farthest that a nearer surface moves before a farther one in any view that is looked into.
inline int32_t LargestMoveBefore(const starfocus_config& config) {
  if (config.views == 1) return 0;
  const DisparityRange range = RangeOf(config);
  return Min(static_cast<int32_t>(range.max - range.min) + 3, kMostMove + 1);
}

// Rows of tiles that a pass is ahead of the last one.
inline int32_t TilesAhead(const starfocus_config& config, int pass) {
  const int32_t moved = (LargestMoveBefore(config) + kCoverageTile - 1) / kCoverageTile;
  switch (pass) {
    case kUnmixAgain:
      return 0;
    case kLook:
      return 1;  // what is not known of a pixel is taken from the tiles around
    case kUnmixFirst:
      return 1 + Max(1, moved);  // a tile beside a mixed one is thin
    case kStart:
      return TilesAhead(config, kUnmixFirst) + 1;
    default:
      return TilesAhead(config, kStart) + 1;
  }
}

// Pixels beyond what is parted that the passes read.
inline int32_t CoverageBorder(const starfocus_config& config) {
  if (!HasCoverage(config)) return 0;
  return (TilesAhead(config, kFindRagged) + 1) * kCoverageTile + kBandReach + 2;
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_COVERAGE_PASSES_H_
