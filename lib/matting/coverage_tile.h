// SPDX-License-Identifier: Apache-2.0
// The steps of the coverage passes (coverage.cc), which process one tile each: finding the pixels
// near depth edges and their two surfaces, unmixing, and estimating the light of the far surface.
// Means over cells of increasing size collect the known light of the far surface, and extend it
// smoothly to pixels without known light (the pull-push algorithm).
#ifndef STARFOCUS_LIB_MATTING_COVERAGE_TILE_H_
#define STARFOCUS_LIB_MATTING_COVERAGE_TILE_H_

#include "lib/matting/coverage_map.h"

namespace starfocus {

// Band (band.cc).

// Sets CoverageTile::ragged of the tiles [first, last) of a row.
void FindRagged(const Input& input, int32_t first, int32_t last, int32_t row);

// Initialises a tile as a single surface with the disparities of the disparity map.
void ClearTile(const Input& input, int32_t column, int32_t row);

// Writes the initial alpha (0, kWhole or kUnsplit) and the near disparities of a tile, both from
// the disparity map alone. Reads the light of the far surface from the centre view, and writes this
// light to the cells of the tile at all levels.
void StartTile(const Input& input, int32_t column, int32_t row);

// For each pixel of the tile near an edge, writes the disparities of both surfaces, the given
// coverage, and the light of the centre view as light of the far surface. Sets `mixed` if the given
// coverage of any pixel differs from the coverage that the disparity map implies.
void StartGiven(const Input& input, int32_t column, int32_t row);

// Coverage (unmix.cc).

// Writes the coverage of a tile after the first pass, starting from the tile's initial alpha.
void UnmixFirst(const Input& input, int32_t column, int32_t row);

// Writes the coverage of a tile after the second pass, and the light of the far surface in the
// tile. The inputs are the coverage of the first pass and the light of the far surface that
// LookBehindTile has read.
void UnmixAgain(const Input& input, int32_t column, int32_t row);

// Writes the final coverage of a tile, and the light of the far surface in the tile. LookBehindTile
// must have read the light of the far surface, unless the light field has only one view.
void TakeGiven(const Input& input, int32_t column, int32_t row);

// Light of the far surface (far_light.cc).

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
// kFarKnownBits fractional bits and is truncated.
constexpr int32_t EighthPower(int32_t a) {
  const int64_t square = a * a, fourth = square * square;
  return static_cast<int32_t>(fourth * fourth >> (8 * kAlphaBits - kFarKnownBits));
}

// Returns the weight of a pixel in a mean of the far surface's light. `alpha` is the coverage of
// the pixel by a nearer surface.
constexpr int32_t FarWeight(int32_t alpha) { return EighthPower(kWhole - alpha); }

// Reads the light of the far surface at the tile's split pixels from the centre view and from the
// OcclusionViews, and recomputes the cells of all levels. Light from a view gets a smaller weight
// if nearer surfaces cover more of the pixel in that view (FarWeight). CoverageMap::first contains
// the coverage by nearer surfaces.
void LookBehindTile(const Input& input, int32_t column, int32_t row);

// Adds detail to the light of the far surface in the mixed pixels of a tile. The light of a mixed
// pixel that the means of both surfaces do not explain is detail of one of the surfaces. The far
// surface gets a part of this light, which decreases with the coverage. Without this part, faint
// coverage would give all detail of the background to the near surface.
void AddFarDetail(const Input& input, int32_t column, int32_t row);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_MATTING_COVERAGE_TILE_H_
