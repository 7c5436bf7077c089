// SPDX-License-Identifier: Apache-2.0
// Compares the doubtful pixels of a cell of the picture with the pixels around them, by colour.
// Each pixel is compared with pixels in every second row and column. The cell is therefore stored
// as four pictures of half the size, one for each parity of row and column.
#ifndef STARFOCUS_LIB_DEPTH_COLOUR_CELL_H_
#define STARFOCUS_LIB_DEPTH_COLOUR_CELL_H_

#include <cstddef>
#include <cstdint>

#include "lib/depth/colour_map.h"
#include "simd/colours.h"

namespace starfocus {

// Cost of a pixel's own disparity by its doubt. Pixels of doubt 0 lie on a ramp, and no pixel is
// compared with them. Doubts 1 to 3 cost the same, because steps may be displaced by up to 3
// pixels.
inline constexpr int16_t kDoubtCosts[kDoubtReach + 2] = {80, 45, 45, 45, 22, 11, 0};

// Width and height in pixels of the largest cell, and of a block. Every second pixel of a block is
// compared at once.
inline constexpr int32_t kColourCell = 64, kCellBlock = 2 * simd::kColourBlock;

// Rounds a length up to whole blocks.
inline int32_t WholeBlocks(int32_t length) {
  return (length + kCellBlock - 1) / kCellBlock * kCellBlock;
}

// Disparities are divided into groups, each one pixel wide.
inline constexpr int32_t kGroups = 1024;

struct ColourCell {
  static constexpr int32_t kHalf = (kColourCell + 4 * simd::kColourReach) / 2;
  // Each group that occurs has a place. An unused place separates groups that are not adjacent.
  static constexpr int32_t kMostPlaces = kGroups + 2;

  // The cell and the pixels around it. The indices are the lowest bits of row and column.
  simd::ColourSample samples[2][2][kHalf * kHalf];
  // Number of places, in order from the nearest group to the farthest. The first and the last one
  // are unused.
  int32_t places;
  int16_t highest[kMostPlaces];  // largest disparity of the group at each place
  uint16_t place[kGroups];       // place of each group times kSliceLanes; 0: it does not occur
  uint16_t least[kMostPlaces * simd::kSliceLanes];  // result of CompareColours for a block

  // Returns the window of the block whose first pixel is (x, y), relative to the first pixel of the
  // cell.
  const simd::ColourSample* Window(int32_t x, int32_t y) const {
    return samples[y & 1][x & 1] + y / 2 * kHalf + x / 2;
  }
};

// Fills the samples and the places for the cell `area`.
void FillCell(const ColourMap& map, const uint8_t* doubt, const Rect& area, ColourCell* cell);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_COLOUR_CELL_H_
