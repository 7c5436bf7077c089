// SPDX-License-Identifier: Apache-2.0
// Finds how much of each pixel near a depth edge the nearer surface covers, by colours. The far
// colour is the mean of pure far pixels around, the near colour that of pure near ones, and a pixel
// between them is a mixture. Where colours do not decide, the pixels around do, and then the map.
#ifndef STARFOCUS_LIB_DEPTH_COVERAGE_H_
#define STARFOCUS_LIB_DEPTH_COVERAGE_H_

#include <cstdint>

#include "lib/depth/colour_sums.h"
#include "lib/depth/map_levels.h"

namespace starfocus {

// Pixels around a tile that decide on its coverage.
inline constexpr int32_t kCoverageMargin = 2 * kMostWindow + 4;

inline constexpr int32_t kCovered = 255;

// Which pixels may be mixtures: up to this far from a ramp, on its near and on its far side, of
// surfaces more than `step` apart (kDisparityBits).
struct Band {
  int32_t inside, outside, step;
  int32_t window;  // half of the side of the largest window of a mean
  // The near colour is that of the pixels that differ most from the far one: what lies inside of
  // the outline is far in part, too.
  bool by_contrast;
  // Single pixels around decide where the colours of a surface vary. One pass is enough then.
  bool by_votes;
};
// The wide band holds what a map's outline encloses with thin structure.
inline constexpr Band kWideBand = {40, 16, 5 << kDisparityBits, kMostWindow, true, false};
// The narrow one holds displaced outlines.
inline constexpr Band kNarrowBand = {4, 4, kSurfaceStep, kMostWindow / 2, false, true};

// Planes of the picture's size.
struct CoveragePlanes {
  const uint8_t* before;  // coverage of the pass before; null in the first one
  uint8_t* coverage;
  uint8_t* trust;  // of the colours, up to 255
  // Disparities of the far and the near pixel around that are most alike; of a band by votes.
  int16_t* const* alike;
};

// Memory of a worker, for the largest tile with kCoverageMargin around it.
struct CoverageScratch {
  ColourSum* far_sums;
  ColourSum* near_sums;
  MeanColour* far_means;
  uint8_t *weights, *mixture, *trust;
  int8_t* votes;
};

CoverageScratch TakeCoverageScratch(size_t width, size_t height, Carver* carver);

// Returns whether a pixel of this place belongs to a band.
inline bool IsInBand(const MapLevels& levels, const Band& band, size_t at) {
  const int32_t distance = levels.place[at] & kDistanceMask;
  if (distance == kNoEdge) return false;
  const bool near_side = (levels.place[at] & kNearSide) != 0;
  return distance <= (near_side ? band.inside : band.outside) &&
         levels.near_level[at] - levels.far_level[at] > band.step;
}

// Fills the coverage of a tile's pixels in the band; others get that of the map.
void FindCoverage(const ColourMap& map, const MapLevels& levels, const Band& band, const Rect& tile,
                  const CoverageScratch& scratch, const CoveragePlanes& planes);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_COVERAGE_H_
