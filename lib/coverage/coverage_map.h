// SPDX-License-Identifier: Apache-2.0
// Coverage of pixels near depth edges in thin structures (hair, twigs, grass): there every pixel is
// parted into a near and a far surface, on both sides of an edge. The map is found once per row of
// the picture, in tiles, before blocks are planned and rendered.
#ifndef STARFOCUS_LIB_COVERAGE_COVERAGE_MAP_H_
#define STARFOCUS_LIB_COVERAGE_COVERAGE_MAP_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/fixed.h"
#include "lib/base/geometry.h"

namespace starfocus {

// Side of a tile in pixels: whether structure is thin is decided by tile.
inline constexpr int32_t kCoverageTile = 16;

// Coverage has 7 fractional bits: 0 to kWhole. kUnparted: the pixel is not near a depth edge.
inline constexpr int kAlphaBits = 7;
inline constexpr int32_t kWhole = 1 << kAlphaBits;
inline constexpr uint8_t kUnparted = 255;

// A larger step of disparity is an edge of thin structure, kDisparityBits. Two pixels closer than
// that are of one surface.
inline constexpr int32_t kThinStep = 5 << kDisparityBits;

// Pixels from an edge within which pixels are parted.
inline constexpr int32_t kBandReach = 3;

// The light of the far surface in a cell of 2^level pixels a side, and how much of it is known.
struct FarCell {
  int16_t rgb[3];     // light
  int16_t weight;     // [0, kKnown]
  int16_t disparity;  // kDisparityBits
};
inline constexpr int32_t kFarKnownBits = 8;
inline constexpr int32_t kKnown = 1 << kFarKnownBits;

// Pixels that a nearer surface may move to one side, in a view, before the far one; views in which
// it moves farther are not looked into.
inline constexpr int32_t kMostMove = 32;

// Columns beyond the picture that are looked at.
inline constexpr int32_t kAside = 48;
static_assert(kAside >= kMostMove + 2 && kAside % kCoverageTile == 0,
              "what moves over comes from there");
inline constexpr int16_t kNowhere = INT16_MIN;

// Levels of cells: 1, 2, 4, 8 and 16 pixels a side.
inline constexpr int kFarLevels = 5;

struct CoverageTile {
  uint64_t near_bins;  // which disparities nearer surfaces of the tile have, by BinOf
  int16_t low, high;   // disparities of both surfaces of its parted pixels
  uint8_t ragged;      // many of its pixels lie beside edges; where coverage is given, any
  uint8_t mixed;       // and much of it is a mixture; where coverage is given, any pixel
  uint8_t thin;        // its pixels are parted: it or a tile beside it is mixed
};

// Rows of tiles; ring row t % tile_rows has row t. Pixels of a tile beyond the picture are unused.
struct CoverageMap {
  int32_t width = 0, height = 0;       // of the picture
  int32_t columns = 0, tile_rows = 0;  // of tiles; tile_rows: in memory
  int16_t disparity_min = 0;           // of the configuration
  int bin_bits = 0;                    // of disparities in a bin of near_bins
  int32_t around = 1;                  // tiles around a ragged one that the passes look at
  CoverageTile* tiles = nullptr;
  // Planes of pixels, with kAside unused ones before and behind each row.
  uint8_t* first = nullptr;  // coverage after the first pass
  uint8_t* alpha = nullptr;  // after the second one, or kUnparted
  int16_t* near = nullptr;   // disparity of the nearer surface, kNowhere beyond the picture
  FarCell* far[kFarLevels] = {};

  int32_t Rows() const { return (height + kCoverageTile - 1) / kCoverageTile; }
  CoverageTile& Tile(int32_t column, int32_t row) const {
    return tiles[static_cast<size_t>(row % tile_rows) * static_cast<size_t>(columns) +
                 static_cast<size_t>(column)];
  }
  // Samples from row to row of planes of pixels.
  size_t Stride() const { return static_cast<size_t>(columns * kCoverageTile + 2 * kAside); }
  // The place of pixel (x, y), up to kAside columns beyond the picture.
  size_t At(int32_t x, int32_t y) const {
    return static_cast<size_t>(y % (tile_rows * kCoverageTile)) * Stride() +
           static_cast<size_t>(x + kAside);
  }
  // The place of cell (x, y) of a level.
  size_t CellAt(int32_t x, int32_t y, int level) const {
    const int32_t rows = (tile_rows * kCoverageTile) >> level;
    const size_t stride = static_cast<size_t>((columns * kCoverageTile) >> level);
    return static_cast<size_t>(y % rows) * stride + static_cast<size_t>(x);
  }
  uint64_t BinOf(int32_t disparity) const {
    return uint64_t{1} << Clamp((disparity - disparity_min) >> bin_bits, 0, 63);
  }
  bool HasTile(int32_t column, int32_t row) const {
    return column >= 0 && column < columns && row >= 0 && row < Rows();
  }
  // Whether a tile within `reach` of this one has the mark.
  bool AnyAround(int32_t column, int32_t row, int32_t reach, uint8_t CoverageTile::*mark) const {
    for (int32_t y = row - reach; y <= row + reach; ++y) {
      for (int32_t x = column - reach; x <= column + reach; ++x) {
        if (HasTile(x, y) && Tile(x, y).*mark != 0) return true;
      }
    }
    return false;
  }
  // Whether the passes look at the tile.
  bool IsStarted(int32_t column, int32_t row) const {
    return AnyAround(column, row, around, &CoverageTile::ragged);
  }
  // The far light of pixel (x, y).
  FarCell& FarAt(int32_t x, int32_t y) const { return far[0][CellAt(x, y, 0)]; }
};

}  // namespace starfocus

#endif  // STARFOCUS_LIB_COVERAGE_COVERAGE_MAP_H_
