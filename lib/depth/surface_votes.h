// SPDX-License-Identifier: Apache-2.0
// Decides which of two surfaces a pixel near an edge shows, where their colours are too mixed for
// means: by the single pixel around of each surface whose colour is most alike. Votes of pixels of
// one colour are averaged.
#ifndef STARFOCUS_LIB_DEPTH_SURFACE_VOTES_H_
#define STARFOCUS_LIB_DEPTH_SURFACE_VOTES_H_

#include <cstdint>

#include "lib/depth/map_levels.h"

namespace starfocus {

// Votes are averaged over this radius, of every second pixel.
inline constexpr int32_t kVoteRadius = 4;

// The pixels most alike of the far (0) and the near surface (1): what they cost, up to 100, and
// their disparities.
struct Likeness {
  int32_t costs[2];
  int32_t disparities[2];

  // Positive for the near surface.
  int32_t Vote() const { return costs[0] - costs[1]; }
};

// Compares a pixel that has levels with those around it.
Likeness CompareAround(const ColourMap& map, const MapLevels& levels, int32_t x, int32_t y);

// Returns the coverage of a pixel by the votes of `rect` around, within [0, 255].
int32_t CoverageByVotes(const ColourMap& map, const Rect& rect, const int8_t* votes, int32_t x,
                        int32_t y);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_SURFACE_VOTES_H_
