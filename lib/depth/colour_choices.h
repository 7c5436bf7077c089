// SPDX-License-Identifier: Apache-2.0
// Finds and rates the candidate surfaces of each doubtful pixel by colour. The candidates are the
// disparities of the surrounding pixels. A candidate disparity has a low cost if surrounding pixels
// with this disparity have a colour similar to the doubtful pixel. Sums of costs along paths favour
// a common surface for neighbouring pixels of similar colour.
//
// A cell of the picture and its surroundings are stored as four pictures of half the size, one for
// each combination of even or odd rows and columns, because each doubtful pixel is compared with
// pixels in every second row and column only.
#ifndef STARFOCUS_LIB_DEPTH_COLOUR_CHOICES_H_
#define STARFOCUS_LIB_DEPTH_COLOUR_CHOICES_H_

#include <cstddef>
#include <cstdint>

#include "lib/depth/colour_map.h"
#include "simd/colours.h"
#include "simd/depth_kernels.h"

namespace starfocus {

// Cost of keeping a pixel's own disparity, indexed by the pixel's doubt. Pixels of doubt 0 lie on a
// ramp or are unknown. Doubtful pixels are not compared with pixels of doubt 0. Doubts 1 to 3 have
// equal costs, because a map may displace steps by up to 3 pixels.
inline constexpr int16_t kDoubtCosts[kDoubtReach + 2] = {80, 45, 45, 45, 22, 11, 0};

// kColourCell is the largest side of a cell in pixels, and kCellBlock is the side of a block in
// pixels. One call of CompareColours processes every second pixel of a block.
inline constexpr int32_t kColourCell = 64, kCellBlock = 2 * simd::kColourBlock;

// Rounds a length in pixels up to a multiple of kCellBlock.
inline int32_t WholeBlocks(int32_t length) {
  return (length + kCellBlock - 1) / kCellBlock * kCellBlock;
}

// Number of groups of disparities. Each group contains a range of one pixel of disparity.
inline constexpr int32_t kGroups = 1024;

struct ColourCell {
  static constexpr int32_t kHalf = (kColourCell + 4 * simd::kColourReach) / 2;
  // Largest number of slots of a cell. Each group of disparities that occurs in the cell or its
  // surroundings has a slot. An unused slot separates groups that are not adjacent.
  static constexpr int32_t kMostPlaces = kGroups + 2;

  // The pixels of the cell and of its surroundings. The first index of `samples` is the lowest bit
  // of the row, and the second index is the lowest bit of the column.
  simd::ColourSample samples[2][2][kHalf * kHalf];
  // Number of slots, which are ordered from the nearest group to the farthest. The first and the
  // last slot are unused.
  int32_t places;
  int16_t highest[kMostPlaces];  // largest disparity of the group in each slot
  // Index of the slot of each group, multiplied by kSliceLanes; 0 for groups that do not occur in
  // the cell.
  uint16_t place[kGroups];
  uint16_t least[kMostPlaces * simd::kSliceLanes];  // result of CompareColours for a block

  // Returns the samples around the block whose first pixel is (x, y). Coordinates are relative to
  // the first pixel of the cell.
  const simd::ColourSample* Window(int32_t x, int32_t y) const {
    return samples[y & 1][x & 1] + y / 2 * kHalf + x / 2;
  }
};

// Fills `cell` with the samples and slots for the rectangle `area` of the picture.
void FillCell(const ColourMap& map, const uint8_t* doubt, const Rect& area, ColourCell* cell);

inline constexpr int32_t kMostChoices = 6;

// Candidate disparities of a pixel, in fixed point (kDisparityBits). `cost` is the cost of each
// candidate at this pixel alone, and `sum` is the sum of path costs. The unit of costs and sums is
// a colour difference of one code.
struct Choices {
  int32_t count;
  int16_t disparity[kMostChoices], cost[kMostChoices], sum[kMostChoices];
};

// Costs of a path up to a pixel, one for each choice of the pixel. `at` is the pixel's position on
// the line of the path.
struct ChoicePath {
  int32_t at;
  int16_t cost[kMostChoices];
};

// Scratch memory of a worker for one region.
struct ChoiceMemory {
  Choices* choices;
  ChoicePath* paths;  // path of each column
  ColourCell* cell;
};

// Fills memory.choices with the choices of the doubtful pixels of `region`, row by row, and
// computes the sum of path costs of each choice. The elements of other pixels are not written.
void WeighChoices(const ColourMap& map, const uint8_t* doubt, const Rect& region,
                  const simd::DepthKernels& kernels, const ChoiceMemory& memory);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_COLOUR_CHOICES_H_
