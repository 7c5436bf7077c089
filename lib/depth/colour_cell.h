// SPDX-License-Identifier: Apache-2.0
// Stores a cell of the picture, whose doubtful pixels are compared by colour with the surrounding
// pixels. Each doubtful pixel is compared with pixels in every second row and column only. The cell
// is therefore stored as four pictures of half the size, one for each parity of row and column.
#ifndef STARFOCUS_LIB_DEPTH_COLOUR_CELL_H_
#define STARFOCUS_LIB_DEPTH_COLOUR_CELL_H_

#include <cstddef>
#include <cstdint>

#include "lib/depth/colour_map.h"
#include "simd/colours.h"

namespace starfocus {

// Cost of keeping a pixel's own disparity, indexed by the pixel's doubt. Pixels of doubt 0 lie on a
// ramp; other pixels are not compared with pixels of doubt 0. Doubts 1 to 3 have equal costs,
// because steps may be displaced by up to 3 pixels.
inline constexpr int16_t kDoubtCosts[kDoubtReach + 2] = {80, 45, 45, 45, 22, 11, 0};

// kColourCell is the side of the largest cell in pixels, and kCellBlock the side of a block. One
// call of CompareColours processes every second pixel of a block.
inline constexpr int32_t kColourCell = 64, kCellBlock = 2 * simd::kColourBlock;

// Rounds a length up to whole blocks.
inline int32_t WholeBlocks(int32_t length) {
  return (length + kCellBlock - 1) / kCellBlock * kCellBlock;
}

// Number of groups of disparities. Each group contains a range of one pixel of disparity.
inline constexpr int32_t kGroups = 1024;

struct ColourCell {
  static constexpr int32_t kHalf = (kColourCell + 4 * simd::kColourReach) / 2;
  // Largest number of slots. Each group that occurs in the cell has a slot. An unused slot
  // separates groups that are not adjacent.
  static constexpr int32_t kMostPlaces = kGroups + 2;

  // The pixels of the cell and of its surroundings. The first index is the lowest bit of the row,
  // the second index the lowest bit of the column.
  simd::ColourSample samples[2][2][kHalf * kHalf];
  // Number of slots, which are ordered from the nearest group to the farthest. The first and the
  // last slot are unused.
  int32_t places;
  int16_t highest[kMostPlaces];  // largest disparity of the group in each slot
  // Slot of each group times kSliceLanes; 0 for groups that do not occur.
  uint16_t place[kGroups];
  uint16_t least[kMostPlaces * simd::kSliceLanes];  // result of CompareColours for a block

  // Returns the window of the block whose first pixel is (x, y), relative to the first pixel of the
  // cell.
  const simd::ColourSample* Window(int32_t x, int32_t y) const {
    return samples[y & 1][x & 1] + y / 2 * kHalf + x / 2;
  }
};

// Fills `cell` with the samples and slots of the cell of the picture with rectangle `area`.
void FillCell(const ColourMap& map, const uint8_t* doubt, const Rect& area, ColourCell* cell);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_COLOUR_CELL_H_
