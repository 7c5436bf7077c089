// SPDX-License-Identifier: Apache-2.0
// The given map of a repair: which of its pixels are trusted, and which of them are changed.
#ifndef STARFOCUS_LIB_DEPTH_REPAIR_MAP_H_
#define STARFOCUS_LIB_DEPTH_REPAIR_MAP_H_

#include <cstdint>

#include "lib/base/geometry.h"
#include "lib/depth/estimate.h"

namespace starfocus {

// Converts the given disparities of a tile to kDisparityBits; kNoSurface where they are not finite.
// Both maps of the sweeps begin with them.
void ReadGiven(const EstimatePlan& plan, const starfocus_light_field& light_field, const Rect& tile,
               EstimateMemory* memory);

// Pixels are trusted whose 3x3 neighbours are known and of one surface: what blurs or scales a map
// makes slopes of its edges, and noise is no surface. Others become kNoSurface.
void FindTrusted(const EstimatePlan& plan, const Rect& tile, const int16_t* given,
                 int16_t* trusted);

// Writes the disparity of each pixel of a tile: the given one where memory.second agrees; otherwise
// the mean of trusted ones around it of the same surface, or that of memory.second there, of which
// strays are left out by the colours of the centre view.
void EvenOut(const EstimatePlan& plan, const Plane<const uint8_t>& centre, const Rect& tile,
             const EstimateMemory& memory, int16_t* evened);

// Whether memory.first is another surface than the given one at pixel `at`, or that is unknown.
bool Differs(const EstimateMemory& memory, size_t at);

// Counts the pixels of a tile whose evened map is finished.
TileCount CountTile(const EstimatePlan& plan, const Rect& tile, const EstimateMemory& memory);

// Costs (simd::kCostScale times gray levels) that the pixels around a change must have together: as
// much as eight pixels that fit 7.5 gray levels worse. Much more, and nothing for less than another
// surface, where a map is right but for what is hard to see.
inline constexpr EvidenceScale kSweepEvidence = {18, 22, 1600, 240};

// Returns the disparity of pixel (x, y): that of memory.first where it differs little, and where
// the evidence of all pixels around that differ is strong enough; otherwise the given one. Single
// pixels that differ are more often mistaken than right.
int16_t RepairedAt(const EstimatePlan& plan, const EstimateMemory& memory, int32_t x, int32_t y);

// Fills `nearest` with the largest trusted disparity near each pixel of row y of a cell, which
// hair stands out from; kNoSurface where there is none.
void FindNearest(const EstimatePlan& plan, const int16_t* trusted, const Rect& cell, int32_t y,
                 int16_t* nearest);

// Returns the disparity of pixel `at` of thin structure that the given map does not have: that of
// the nearer surface, but for a farther one that the views show clearly. What they do not is
// a mixture more often than not, which colours part better than any search does.
int16_t PartedAt(const EstimateMemory& memory, size_t at, int16_t nearest);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_REPAIR_MAP_H_
