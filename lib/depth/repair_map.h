// SPDX-License-Identifier: Apache-2.0
// Decides which pixels of the given map of a repair are trusted, and which of them are changed.
#ifndef STARFOCUS_LIB_DEPTH_REPAIR_MAP_H_
#define STARFOCUS_LIB_DEPTH_REPAIR_MAP_H_

#include <cstdint>

#include "lib/base/geometry.h"
#include "lib/depth/estimate.h"

namespace starfocus {

// Converts the given disparities of a tile to kDisparityBits; kNoSurface where they are not finite.
// Initializes both maps of the sweeps with them.
void ReadGiven(const EstimatePlan& plan, const starfocus_light_field& light_field, const Rect& tile,
               EstimateMemory* memory);

// Copies the pixels that are trusted, and sets all others to kNoSurface. A pixel is trusted if its
// 3x3 neighbourhood is known and belongs to one surface. Blurred or scaled maps have slopes instead
// of edges, and noise forms no surface.
void FindTrusted(const EstimatePlan& plan, const Rect& tile, const int16_t* given,
                 int16_t* trusted);

// Writes the disparity of each pixel of a tile. It is the given one where memory.second agrees.
// Elsewhere it is the mean of the surrounding trusted pixels of the same surface. If there are
// none, the mean of memory.second is used. Stray pixels are removed by the colours of the centre
// view.
void EvenOut(const EstimatePlan& plan, const Plane<const uint8_t>& centre, const Rect& tile,
             const EstimateMemory& memory, int16_t* evened);

// Returns true if memory.first is on another surface than the given map at pixel `at`, or if the
// given map is unknown there.
bool Differs(const EstimateMemory& memory, size_t at);

// Counts the pixels of a tile whose evened map is finished.
TileCount CountTile(const EstimatePlan& plan, const Rect& tile, const EstimateMemory& memory);

// Evidence that the pixels around a change must sum to, in costs (simd::kCostScale per gray level).
// In a wrong map it is 240, as if eight pixels fit 7.5 gray levels worse. Maps that are right
// except at details of low contrast need 1600. In these, pixels that stay on their surface are not
// changed.
inline constexpr EvidenceScale kSweepEvidence = {18, 22, 1600, 240};

// Returns the disparity of pixel (x, y). It is that of memory.first if the difference is small, or
// if the evidence of all differing pixels around is large enough. Otherwise it is the given one,
// since single differing pixels are more often wrong than right.
int16_t RepairedAt(const EstimatePlan& plan, const EstimateMemory& memory, int32_t x, int32_t y);

// Fills `nearest` with the largest trusted disparity near each pixel of row y of a cell, which is
// the surface that hair stands out from. It is kNoSurface if no trusted pixel is near.
void FindNearest(const EstimatePlan& plan, const int16_t* trusted, const Rect& cell, int32_t y,
                 int16_t* nearest);

// Returns the disparity of pixel `at` of thin structure that the given map lacks. It is that of the
// nearer surface, unless the views clearly show a farther one. Pixels that views do not show
// clearly are mostly mixtures, which colours separate better than any search does.
int16_t PartedAt(const EstimateMemory& memory, size_t at, int16_t nearest);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_REPAIR_MAP_H_
