// SPDX-License-Identifier: Apache-2.0
// Decides which pixels of a given map a repair trusts, and which pixels the repair changes.
#ifndef STARFOCUS_LIB_DEPTH_REPAIR_MAP_H_
#define STARFOCUS_LIB_DEPTH_REPAIR_MAP_H_

#include <cstdint>

#include "lib/base/geometry.h"
#include "lib/depth/estimate.h"

namespace starfocus {

// Converts the given disparities of a tile to fixed point (kDisparityBits). Disparities that are
// not finite become kNoSurface. Initialises the maps of both sweeps with the converted disparities.
void ReadGiven(const EstimatePlan& plan, const starfocus_light_field& light_field, const Rect& tile,
               EstimateMemory* memory);

// Copies the trusted pixels of a tile to `trusted`, and sets all other pixels to kNoSurface. A
// pixel is trusted if its 3x3 neighbourhood is known and belongs to one surface. The slopes of
// blurred or scaled maps and the pixels of noisy maps are therefore not trusted.
void FindTrusted(const EstimatePlan& plan, const Rect& tile, const int16_t* given,
                 int16_t* trusted);

// Writes the disparity of each pixel of a tile. If memory.second agrees with the given disparity,
// the given disparity is written. Otherwise, the mean of the surrounding trusted pixels that are on
// the surface of memory.second is written. If no trusted pixel is on this surface, the mean of
// memory.second over the surface is written. Stray pixels are removed with the help of the colours
// of the centre view.
void EvenOut(const EstimatePlan& plan, const Plane<const uint8_t>& centre, const Rect& tile,
             const EstimateMemory& memory, int16_t* evened);

// Returns true if memory.first and the given map are on different surfaces at pixel `at`, or if the
// given disparity of this pixel is unknown.
bool Differs(const EstimateMemory& memory, size_t at);

// Counts the edge pixels of a tile, and the pixels whose given disparity the repair contradicts.
// Requires the result of EvenOut for the tile.
TileCount CountTile(const EstimatePlan& plan, const Rect& tile, const EstimateMemory& memory);

// Smallest total evidence that a change of the map requires, in units of cost (simd::kCostScale per
// grey level). In a wrong map, a change requires a total of 240, which corresponds to eight pixels
// that fit 7.5 grey levels worse. In a map that is right except at details of low contrast, a
// change requires a total of 1600. If changes require a total of 1600, a pixel whose new disparity
// is on the surface of the given disparity is not changed.
inline constexpr EvidenceScale kSweepEvidence = {18, 22, 1600, 240};

// Returns the repaired disparity of pixel (x, y), which is the disparity in memory.first or the
// given disparity. A contradicted pixel changes only if the total evidence of the contradicted
// pixels around the pixel is large enough. Single contradicted pixels are more often right in the
// given map than in memory.first. In rough parts of the map, contradicted pixels always change to
// memory.first.
int16_t RepairedAt(const EstimatePlan& plan, const EstimateMemory& memory, int32_t x, int32_t y);

// Fills `nearest` with the largest trusted disparity near each pixel of row y of a cell. The
// largest trusted disparity belongs to the surface from which hair stands out. If no trusted pixel
// is near, the value is kNoSurface.
void FindNearest(const EstimatePlan& plan, const int16_t* trusted, const Rect& cell, int32_t y,
                 int16_t* nearest);

// Returns the disparity of pixel `at` in thin structure that the given map lacks. The result is the
// disparity of the nearer surface, unless the views clearly show a farther surface. Most pixels
// that the views do not show clearly mix the colours of two surfaces. A comparison of colours
// separates mixed pixels better than a search over disparities does.
int16_t PartedAt(const EstimateMemory& memory, size_t at, int16_t nearest);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_REPAIR_MAP_H_
