// SPDX-License-Identifier: Apache-2.0
// A cell of the picture whose doubtful pixels are compared by colour with those around them: with
// every second one each way, so that four pictures of half the size are compared apart.
#ifndef STARFOCUS_LIB_DEPTH_COLOUR_CELL_H_
#define STARFOCUS_LIB_DEPTH_COLOUR_CELL_H_

#include <cstddef>
#include <cstdint>

#include "lib/depth/colour_map.h"
#include "simd/colours.h"

namespace starfocus {

// What a pixel's disparity costs, by its doubt: 0 is a ramp, and tells others nothing; 1 to 3 lie
// as near to a step as steps are displaced.
inline constexpr int16_t kDoubtCosts[kDoubtReach + 2] = {80, 45, 45, 45, 22, 11, 0};

// Pixels of a cell at most, and of a block of it that is compared at once, each way.
inline constexpr int32_t kColourCell = 64, kCellBlock = 2 * simd::kColourBlock;

// As many pixels, and those up to the end of a block.
inline int32_t WholeBlocks(int32_t length) {
  return (length + kCellBlock - 1) / kCellBlock * kCellBlock;
}

// A group of disparities is a pixel wide.
inline constexpr int32_t kGroups = 1024;

struct ColourCell {
  static constexpr int32_t kHalf = (kColourCell + 4 * simd::kColourReach) / 2;
  // Of each group that occurs, and one between groups that are no neighbours.
  static constexpr int32_t kMostPlaces = kGroups + 2;

  // The cell and what its pixels are compared with; by row and column, even and odd ones apart.
  simd::ColourSample samples[2][2][kHalf * kHalf];
  // The places of groups, from the nearest to the farthest. The first and the last one are free.
  int32_t places;
  int16_t highest[kMostPlaces];  // disparity
  uint16_t place[kGroups];       // of each group, times kSliceLanes; 0: it doesn't occur
  uint16_t least[kMostPlaces * simd::kSliceLanes];  // keys of a block

  // A block's samples, whose columns and rows from the cell's first ones are even or odd.
  const simd::ColourSample* Window(int32_t x, int32_t y) const {
    return samples[y & 1][x & 1] + y / 2 * kHalf + x / 2;
  }
};

// Fills the samples of all blocks of a cell, and the places.
void FillCell(const ColourMap& map, const uint8_t* doubt, const Rect& area, ColourCell* cell);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_COLOUR_CELL_H_
