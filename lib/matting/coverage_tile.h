// SPDX-License-Identifier: Apache-2.0
// The steps of the coverage passes (coverage_passes.cc), which process one tile each: finding the
// pixels near depth edges and their two surfaces, unmixing, and estimating the light of the far
// surface. Means over patches of increasing size collect the known light of the far surface, and
// extend it smoothly to pixels without known light (the pull-push algorithm).
#ifndef STARFOCUS_LIB_MATTING_COVERAGE_TILE_H_
#define STARFOCUS_LIB_MATTING_COVERAGE_TILE_H_

#include <cstring>

#include "lib/matting/coverage.h"

namespace starfocus {

// Band (band.cc).

// Sets CoverageTile::ragged of a tile.
void FindRagged(const Input& input, int32_t column, int32_t row);

// Initialises a tile as a single surface with the disparities of the disparity map.
void ClearTile(const Input& input, int32_t column, int32_t row);

// Writes the initial alpha (0, kWhole or kUnsplit) and the near disparities of a tile, both from
// the disparity map alone. Reads the light of the far surface from the centre view, and writes this
// light to the patches of the tile at all levels.
void StartTile(const Input& input, int32_t column, int32_t row);

// For each pixel of the tile near an edge, writes the disparities of both surfaces, the given
// coverage, and the light of the centre view as light of the far surface. With one view, the light
// of the near surface is first removed (UnmixFar). Pixels whose coverage only repeats the map, and
// which are not beside mixtures, are not split. Sets `mixed` if any pixel is split.
void StartGiven(const Input& input, int32_t column, int32_t row);

// Coverage (coverage_passes.cc).

// Writes the coverage of a tile after the first pass, starting from the tile's initial alpha.
void UnmixFirst(const Input& input, int32_t column, int32_t row);

// Writes the coverage of a tile after the second pass, and the light of the far surface in the
// tile. The inputs are the coverage of the first pass and the light of the far surface that
// ReadBehindTile has read.
void UnmixAgain(const Input& input, int32_t column, int32_t row);

// Writes the final coverage of a tile, and the light of the far surface in the tile. ReadBehindTile
// must have read the light of the far surface, unless the light field has only one view.
void UseGiven(const Input& input, int32_t column, int32_t row);

// Light of the far surface (far_light.cc).

// Computes the light of the far surface in the patches of levels 1 to 4 of a tile, from the patches
// of level 0. Each patch gets the light of the farthest surface in the patch.
void PullTile(int32_t column, int32_t row, const CoverageMap& map);

// Light of the far surface at each pixel of a tile, or in each patch of a level of a tile, with a
// border of one patch. The weight of a pixel is 0 if the light of the far surface is not known
// nearby.
struct FarTile {
  static constexpr int32_t kSide = kCoverageTile + 2;
  FarLight patches[kSide * kSide];

  FarLight& At(int32_t x, int32_t y) { return patches[(y + 1) * kSide + x + 1]; }
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
// OcclusionViews, and recomputes the patches of all levels. Light from a view gets a smaller weight
// if nearer surfaces cover more of the pixel in that view (FarWeight). CoverageMap::first contains
// the coverage by nearer surfaces.
void ReadBehindTile(const Input& input, int32_t column, int32_t row);

// Removes the light of the near surface, a mean of the light around, from the light of the far
// surface in the patches of level 0 of a tile. The result keeps the detail of the background, and
// its weight decreases with the coverage, because an error of the near light grows with the
// coverage. Call UnmixFar before PullTile. CoverageMap::first contains the coverage of the tile.
void UnmixFar(const Input& input, int32_t column, int32_t row);

// Adds detail to the light of the far surface, which side views show, in the mixed pixels of a
// tile. The light of a mixed pixel that the means of both surfaces do not explain is detail of one
// of the surfaces. The far surface gets a part of this light, which decreases with the coverage.
// Without this part, faint coverage would give all detail of the background to the near surface.
void AddFarDetail(const Input& input, int32_t column, int32_t row);

// Search for the surfaces around a pixel of a tile (band.cc).

// Disparities of a tile and of kAround pixels on each side of the tile. Beyond the picture, the
// outermost pixels of the picture are repeated.
template <int32_t kAround>
struct DisparitiesAround {
  static constexpr int32_t kSide = kCoverageTile + 2 * kAround;
  // The samples after the last row may be read, and are not used.
  int16_t disparity[kSide * kSide + simd::kSliceLanes];

  DisparitiesAround() = default;
  DisparitiesAround(const Input& input, int32_t column, int32_t row) {
    const int32_t left = column * kCoverageTile - kAround, top = row * kCoverageTile - kAround;
    for (int32_t y = 0; y < kSide; ++y) {
      const int16_t* from = input.disparity.Row(Clamp(top + y, 0, input.height - 1));
      int16_t* to = disparity + y * kSide;
      if (left >= 0 && left + kSide <= input.width) {
        std::memcpy(to, from + left, kSide * sizeof(*to));
        continue;
      }
      for (int32_t x = 0; x < kSide; ++x) to[x] = from[Clamp(left + x, 0, input.width - 1)];
    }
  }
  static constexpr int32_t At(int32_t x, int32_t y) { return (y + kAround) * kSide + x + kAround; }
};

// Radius in pixels of the search for the far and the near surface of a pixel. In disparity maps
// computed by neural networks, outlines are misplaced by up to kGivenRadius pixels.
inline constexpr int32_t kGivenRadius = 32;

// Largest distance in pixels from a pixel to the pixels that decide whether the pixel is on a ramp.
inline constexpr int32_t kRampRadius = 3;
using GivenDisparities = DisparitiesAround<kGivenRadius + kRampRadius>;

// Result of a search for the nearest pixel of a surface. Among equally distant pixels, the search
// prefers the pixel on the smallest square around the start, and then the first in row order.
struct Found {
  int32_t disparity;  // Disparity of the pixel found, or of the start if none is found.
  int32_t distance;   // Squared distance in pixels; INT32_MAX if no pixel is found.
};

// Disparities of the two surfaces of a pixel near an edge.
struct Surfaces {
  int32_t low, high;

  // Returns true if a disparity belongs to the near surface, so that its implied coverage is 1.
  bool IsNear(int32_t disparity) const { return 2 * disparity >= low + high; }
};

// Searches a tile and its surroundings. A search reads only the patches of kPatchSide x kPatchSide
// pixels that contain the surface. All positions are indices of GivenDisparities::disparity.
class SurfaceSearch {
 public:
  explicit SurfaceSearch(const GivenDisparities& around);

  // A pixel is on a ramp if its disparity lies between the disparities of two opposite pixels at an
  // equal distance of at most kRampRadius.
  bool IsOnRamp(int32_t at) const { return on_ramp_[at]; }

  // Finds the nearest pixel in the square of radius kGivenRadius around a pixel of the tile that is
  // not on a ramp and has a disparity in [low, high].
  Found FindNearest(int32_t at, int32_t low, int32_t high) const;

  // Finds the two surfaces of a pixel of the tile. For a pixel on a ramp, the results are the
  // surfaces at both ends of the ramp. For other pixels, the results are the pixel's own surface
  // and the nearest other surface. Returns false if the search finds no second surface.
  bool FindSurfaces(int32_t at, Surfaces* surfaces) const;

 private:
  static constexpr int32_t kSide = GivenDisparities::kSide;
  static constexpr int32_t kPatchSide = 8;
  static constexpr int32_t kPatches = (kSide + kPatchSide - 1) / kPatchSide;

  // Range of the disparities of a patch, without pixels on ramps; empty if least > greatest.
  struct Patch {
    int16_t least = INT16_MAX, greatest = INT16_MIN;
    bool has_ramp = false;

    void Add(int16_t disparity) {
      if (disparity < least) least = disparity;
      if (disparity > greatest) greatest = disparity;
    }
  };
  const GivenDisparities& around_;
  bool on_ramp_[kSide * kSide] = {};  // false for the outermost kRampRadius pixels
  Patch patches_[kPatches * kPatches];
  Patch all_;  // range of all patches, at which most searches end
};

}  // namespace starfocus

#endif  // STARFOCUS_LIB_MATTING_COVERAGE_TILE_H_
