// SPDX-License-Identifier: Apache-2.0
// Defines the input, output and memory of the phases of FindHairCoverage, and loops over cells and
// their pixels.
#ifndef STARFOCUS_LIB_DEPTH_HAIR_JOB_H_
#define STARFOCUS_LIB_DEPTH_HAIR_JOB_H_

#include "lib/depth/colour_pyramid.h"
#include "lib/depth/hair_cells.h"
#include "lib/depth/map_rows.h"

namespace starfocus {

// Counts over a tile. `inside` is the number of near pixels that lie 2 to 4 cells inside outlines.
// `far` is the number of such inside pixels that look like background, multiplied by 256.
struct InsideCount {
  int32_t inside, far;
};

struct HairMemory {
  ColourPyramid far, near;
  // `contrast` and `near_pixels` have one value per cell. At first, `contrast` holds the largest
  // squared contrast between a near pixel and the background. Later, `contrast` holds the number of
  // near pixels that look like background, multiplied by 256. `near_pixels` holds the number of
  // near pixels of each cell.
  int32_t *contrast, *near_pixels;
  InsideCount* counts;  // one element for each tile
};

struct HairJob {
  const ColourMap& map;
  const MapOutput& output;
  const HairCells& cells;
  const HairMemory& memory;

  Rect Tile(int32_t index) const { return TileOf(map.plan, index); }
  uint8_t& CoverageAt(int32_t x, int32_t y) const {
    return output
        .coverage[static_cast<size_t>(y) * output.coverage_stride + static_cast<size_t>(x)];
  }
};

inline const HairJob& HairJobOf(const void* data) { return *static_cast<const HairJob*>(data); }

// ShareOf converts a coverage of 0 to 255 to a fraction of kFullyKnown. FourthPower computes the
// fourth power of a fraction of kFullyKnown.
inline uint32_t ShareOf(uint8_t coverage) { return coverage + coverage / 128U; }
inline uint32_t FourthPower(uint32_t share) {
  const uint32_t square = share * share / kFullyKnown;
  return square * square / kFullyKnown;
}

// One pixel of a cell.
struct CellPixel {
  int32_t x, y;         // Position in the picture.
  int32_t column, row;  // Position in the cell.
  bool is_near;
  uint16_t rgb[3];  // kMeanBits
};

// Calls act(pixel) for all pixels of a cell.
template <class Act>
void ForPixels(const HairJob& job, int32_t column, int32_t row, const Act& act) {
  const Rect cell = HairCellAt(job.map.plan, column, row);
  const size_t at = job.cells.At(column, row);
  for (int32_t y = 0; y < cell.height; ++y) {
    for (int32_t x = 0; x < cell.width; ++x) {
      CellPixel pixel = {cell.x + x, cell.y + y, x, y, false, {}};
      pixel.is_near = job.cells.IsNear(at, job.map.disparity[job.map.At(pixel.x, pixel.y)]);
      const uint8_t* rgb = job.map.Pixel(pixel.x, pixel.y);
      for (int c = 0; c < 3; ++c) pixel.rgb[c] = static_cast<uint16_t>(rgb[c] << kMeanBits);
      act(pixel);
    }
  }
}

// Calls act(column, row, marks) for all cells of a tile.
template <class Act>
void ForMarked(const HairJob& job, int32_t index, const Act& act) {
  const HairCells& cells = job.cells;
  ForHairCells(job.Tile(index), [&](int32_t column, int32_t row) {
    act(column, row, cells.marks[cells.At(column, row)]);
  });
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_HAIR_JOB_H_
