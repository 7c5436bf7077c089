// SPDX-License-Identifier: Apache-2.0
// Stores the coverage of pixels near depth edges in thin structures, such as hair, twigs and grass.
// The map splits each pixel near an edge, on either side, into a near and a far surface. The engine
// computes the map in passes over tiles, once for each row of the picture, before planning and
// rendering blocks.
#ifndef STARFOCUS_LIB_MATTING_COVERAGE_H_
#define STARFOCUS_LIB_MATTING_COVERAGE_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/arena.h"
#include "lib/base/config.h"
#include "lib/base/fixed.h"
#include "lib/base/geometry.h"
#include "lib/base/jobs.h"
#include "lib/io/input.h"
#include "starfocus/matte.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Side of a tile in pixels. The engine decides per tile whether pixels are split
// (CoverageTile::thin).
inline constexpr int32_t kCoverageTile = 16;

// Coverage has 7 fractional bits and ranges from 0 to kWhole. The value kUnsplit marks pixels that
// are not near a depth edge.
inline constexpr int kAlphaBits = 7;
inline constexpr int32_t kWhole = 1 << kAlphaBits;
inline constexpr uint8_t kUnsplit = 255;

// Coverage above kMostExact counts as more than it is: pixels with a coverage of at least
// kLeastWhole belong to the near surface alone.
inline constexpr int32_t kMostExact = 102, kLeastWhole = (kMostExact + kWhole) / 2;

// Largest step of disparity within one surface, in kDisparityBits. A larger step of disparity
// counts as an edge of a thin structure.
inline constexpr int32_t kThinStep = 5 << kDisparityBits;

// Largest distance in pixels from an edge to a pixel that is split.
inline constexpr int32_t kBandRadius = simd::kBeyondRadius;

// Light of the far surface in a patch with a side of 2^level pixels, and the confidence of the
// light.
struct FarLight {
  int16_t rgb[3];     // Light of the far surface: R, G, B.
  int16_t weight;     // Confidence of the light in `rgb`, 0 to kKnown.
  int16_t disparity;  // Disparity of the far surface, kDisparityBits.
};
inline constexpr int32_t kFarKnownBits = 8;
inline constexpr int32_t kKnown = 1 << kFarKnownBits;

// Largest displacement in pixels of a nearer surface relative to the far surface, along either
// axis. The light of the far surface is not read from views in which a nearer surface moves by more
// than kMostMove pixels.
inline constexpr int32_t kMostMove = 32;

// Number of columns on each side of the picture that may be read.
inline constexpr int32_t kAside = 48;
static_assert(kAside >= kMostMove + 2 && kAside % kCoverageTile == 0,
              "kAside must exceed kMostMove and be a multiple of the side of a tile");
inline constexpr int16_t kNowhere = INT16_MIN;

// Levels of patches, with sides of 1, 2, 4, 8 and 16 pixels.
inline constexpr int kFarLevels = 5;

struct CoverageTile {
  // Set of the disparities of near surfaces in the tile, one bit (BinOf) for each bin of
  // disparities.
  uint64_t near_bins;
  int16_t low, high;  // smallest and largest disparity of both surfaces of all split pixels
  // True if many pixels of the tile are next to depth edges, and some pixels belong to strands one
  // pixel wide. If the light field provides coverage, one pixel next to an edge makes the tile
  // ragged.
  uint8_t ragged;
  // True if the light field provides coverage, and a pixel of the tile is split.
  uint8_t mixed;
  // True if pixels near edges are split in this tile, because this tile or a neighbouring tile is
  // ragged. If the light field provides coverage, this tile must also be mixed.
  uint8_t thin;
};

// Passes that compute the coverage map, in this order.
enum CoveragePass { kFindRagged, kStart, kUnmixFirst, kReadBehind, kUnmixAgain, kCoveragePasses };

// The coverage map: a ring buffer of rows of tiles. Row t is stored at ring row t % tile_rows.
// If a tile extends beyond the picture, its pixels outside the picture are unused.
struct CoverageMap {
  int32_t width = 0, height = 0;  // size of the picture
  // Number of columns of tiles; number of rows of tiles in memory.
  int32_t columns = 0, tile_rows = 0;
  int16_t disparity_min = 0;  // FullConfig.disparity_min, kDisparityBits.
  int bin_bits = 0;           // log2 of the number of disparity values in each bin of near_bins.
  // Largest distance, in tiles, between a tile that is marked `ragged` and a tile that the passes
  // process.
  int32_t around = 1;
  CoverageTile* tiles = nullptr;
  // Planes of pixels, with kAside unused pixels before and after each row.
  uint8_t* first = nullptr;  // Coverage after the first pass.
  uint8_t* alpha = nullptr;  // Coverage after the second pass, or kUnsplit.
  int16_t* near = nullptr;   // Disparity of the near surface; kNowhere beyond the picture.
  FarLight* far[kFarLevels] = {};
  // First row of tiles that each pass has not processed yet; negative before the first row.
  int32_t done[kCoveragePasses] = {};
  // next[pass * jobs + job] is the first row of tiles that a job of a pass has not processed. A job
  // that is repeated after a failure or cancellation leaves out earlier rows, since a pass may
  // overwrite what it reads.
  int32_t* next = nullptr;
  int32_t jobs = 0;

  int32_t Rows() const { return (height + kCoverageTile - 1) / kCoverageTile; }
  CoverageTile& Tile(int32_t column, int32_t row) const {
    return tiles[static_cast<size_t>(row % tile_rows) * static_cast<size_t>(columns) +
                 static_cast<size_t>(column)];
  }
  // Returns the distance in samples between rows of the planes of pixels.
  size_t Stride() const { return static_cast<size_t>(columns * kCoverageTile + 2 * kAside); }
  // Returns the index of pixel (x, y) in the planes of pixels; x may be up to kAside columns
  // outside the picture.
  size_t At(int32_t x, int32_t y) const {
    return static_cast<size_t>(y % (tile_rows * kCoverageTile)) * Stride() +
           static_cast<size_t>(x + kAside);
  }
  // Returns the index of patch (x, y) in `far[level]`.
  size_t PatchAt(int32_t x, int32_t y, int level) const {
    const int32_t rows = (tile_rows * kCoverageTile) >> level;
    const size_t stride = static_cast<size_t>((columns * kCoverageTile) >> level);
    return static_cast<size_t>(y % rows) * stride + static_cast<size_t>(x);
  }
  uint64_t BinOf(int32_t disparity) const {
    return uint64_t{1} << Clamp((disparity - disparity_min) >> bin_bits, 0, 63);
  }
  bool HasTile(int32_t column, int32_t row) const {
    return Contains({0, 0, columns, Rows()}, column, row);
  }
  // Returns the pixels of the picture in a tile.
  Rect PixelsOf(int32_t column, int32_t row) const {
    return Clipped({column * kCoverageTile, row * kCoverageTile, kCoverageTile, kCoverageTile},
                   width, height);
  }
  // Returns true if the passes process the tile at (column, row), because it or a tile at most
  // `around` tiles away is ragged.
  bool IsStarted(int32_t column, int32_t row) const {
    return AnyPixel(Clipped(Around(column, row, around), columns, Rows()),
                    [&](int32_t x, int32_t y) { return Tile(x, y).ragged != 0; });
  }
  // Returns the light of the far surface at pixel (x, y).
  FarLight& FarAt(int32_t x, int32_t y) const { return far[0][PatchAt(x, y, 0)]; }
};

// Returns true if the light field contains coverage. If the light field contains no coverage, the
// passes estimate the coverage.
inline bool HasGiven(const Input& input) { return input.given_coverage.data != nullptr; }

// Converts a sample of given coverage to kAlphaBits.
inline int32_t GivenAlpha(uint8_t sample) { return (sample * kWhole + 127) / 255; }

// Returns the distance in pixels from a split pixel to the farthest pixels that the passes read.
// Returns 0 if the engine has no memory for coverage.
int32_t CoverageBorder(const FullConfig& config);

// Allocates the coverage map for stripes that read `border` rows above and below.
void TakeCoverage(const FullConfig& config, int32_t border, Arena* arena, CoverageMap* map);

// Forgets the rows that were computed, so that FindCoverage starts anew.
void ForgetCoverage(CoverageMap* map);

// Computes the coverage of `rows` of the picture in `map`, which must be input.coverage. Rows
// beyond the picture are ignored. Stripes must follow each other from top to bottom. Returns
// STARFOCUS_OK, STARFOCUS_ERROR_RUNNER or STARFOCUS_ERROR_CANCELLED.
starfocus_status FindCoverage(const FullConfig& config, const Input& input, const Range& rows,
                              Jobs* jobs, CoverageMap* map);

// Computing the coverage of a light field from a matte of the subject and the depth map
// (matte_coverage.cc). The matte replaces the coverage that the map implies only at outlines of the
// subject. Other edges of the map, and parts of the matte that the map contradicts, keep the
// implied coverage.

// Number of pixels around an area whose disparities MatteCoverage reads.
inline constexpr int32_t kMatteRadius = 35;

// Writes the coverage of `area`. out.Row(y) receives row y of the picture, starting with column
// area.x. All disparities must be known. `depth.columns` is ignored.
void MatteCoverage(const simd::ImageKernels& kernels, const starfocus_matte& matte,
                   const DepthSource& depth, const Rect& area, const Plane<uint8_t>& out);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_MATTING_COVERAGE_H_
