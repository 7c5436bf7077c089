// SPDX-License-Identifier: Apache-2.0
// Cells of 4 x 4 pixels, the two surfaces that meet at large depth edges around a cell, foreground
// (near) and background (far), and the colours of a surface. The search for hair coverage uses the
// two surfaces of a cell to classify pixels as near or far. A pull-push pyramid over the cells
// extends the colours of a surface from pixels that show the surface to pixels that do not.
#ifndef STARFOCUS_LIB_DEPTH_HAIR_CELLS_H_
#define STARFOCUS_LIB_DEPTH_HAIR_CELLS_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/arena.h"
#include "lib/depth/colour_map.h"

namespace starfocus {

// Side of a cell of the lowest level, in pixels.
inline constexpr int32_t kHairCell = 4;
// Fractional bits of mean colours, chosen so that sums of three squared differences fit in 31 bits.
inline constexpr int kMeanBits = 6;
// Largest weight of a pixel or cell. Pixels that show a single surface and cells of fully known
// colour have the weight kFullyKnown.
inline constexpr int kKnownBits = 8;
inline constexpr int32_t kFullyKnown = 1 << kKnownBits;

struct ColourMean {
  uint16_t rgb[3];  // Mean colour, in fixed point (kMeanBits).
  uint16_t weight;  // Weight of the mean, [0, kFullyKnown].
};

// Weighted sum of the colours of pixels or cells.
class ColourSum {
 public:
  // Adds a colour. `weight` is in [0, kFullyKnown]. A weighted sum of 16 pixels fits in 27 bits.
  template <class T>
  void Add(const T* rgb, uint32_t weight) {
    for (int c = 0; c < 3; ++c) sums_[c] += weight * rgb[c];
    weight_ += weight;
  }
  ColourMean Mean() const;

 private:
  uint32_t sums_[3] = {}, weight_ = 0;
};

struct ColourLevel {
  int32_t columns, rows;
  ColourMean* means;

  ColourMean& At(int32_t x, int32_t y) const {
    return means[static_cast<size_t>(y) * static_cast<size_t>(columns) + static_cast<size_t>(x)];
  }
};

// A pyramid of `count` levels. levels[0] contains the cells of the picture; levels[count - 1]
// contains a single cell.
struct ColourPyramid {
  static constexpr int kMostLevels = 16;
  int32_t count;
  ColourLevel levels[kMostLevels];
};
ColourPyramid TakeColourPyramid(int32_t width, int32_t height, Arena* arena);

// Pulls the means of levels[0] up to the single cell and pushes the means down again, which fills
// in cells of low weight. Returns false if all weights are 0.
bool CarryOnColours(const ColourPyramid& pyramid);

// Colours of all pixels of a cell, in fixed point (kMeanBits).
struct CellColours {
  int32_t rgb[kHairCell][kHairCell][3];
};
// Interpolates the colours of a cell's pixels bilinearly from levels[0].
void InterpolateCell(const ColourPyramid& pyramid, int32_t column, int32_t row,
                     CellColours* colours);

// Radius in cells of the square in which the two surfaces of a cell are searched.
inline constexpr int32_t kSurfaceReach = 10;

struct HairCells {
  int32_t columns, rows;
  // After MarkEdges, lowest and highest disparity of the cells within kSurfaceReach.
  int16_t *low, *high;
  // Lowest and highest disparity of the cell.
  int16_t *farthest, *nearest;
  uint8_t* marks;
  int32_t* line;  // scratch memory for a row or a block of columns

  // Mark of a cell with two surfaces within kSurfaceReach.
  static constexpr uint8_t kHasEdge = 1;
  // Mark of a cell with kHasEdge for which neither the cell nor its eight neighbours have near
  // pixels.
  static constexpr uint8_t kIsFar = 2;
  // Mark of a cell with near pixels for which the closest far pixels are 2 to 4 cells away.
  static constexpr uint8_t kIsInside = 4;
  // Mark of a cell that shows hair, where the map shows a solid shape.
  static constexpr uint8_t kHasHair = 8;

  size_t At(int32_t x, int32_t y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(columns) + static_cast<size_t>(x);
  }
  bool IsNear(size_t cell, int32_t disparity) const {
    return (marks[cell] & kHasEdge) != 0 && 2 * disparity > low[cell] + high[cell];
  }
};
HairCells TakeHairCells(int32_t width, int32_t height, Arena* arena);

// Returns true if a cell whose marks are `marks` may have near pixels.
inline bool MayHaveNear(uint8_t marks) { return marks != 0 && (marks & HairCells::kIsFar) == 0; }

// Measures `low`, `high`, `farthest` and `nearest` of a cell.
void MeasureHairCell(const ColourMap& map, int32_t column, int32_t row, const HairCells& cells);

// Sets the marks of all cells. Call MarkEdges after MeasureHairCell has been called for every cell.
// Returns false if no cell has an edge.
bool MarkEdges(const HairCells& cells);

// Sets kHasHair for cells around which many near pixels look like background. `near` is the number
// of near pixels of each cell. `far` is the number of near pixels that look like background,
// multiplied by 256. Both `near` and `far` are overwritten. Returns false if no cell has hair.
bool MarkHair(const HairCells& cells, int32_t* near, int32_t* far);

// Returns true if any cell that overlaps the rectangle has hair.
bool HasHair(const HairCells& cells, const Rect& rect);

// Calls act(column, row) for each cell whose first pixel lies in the tile.
template <class Act>
void ForHairCells(const Rect& tile, const Act& act) {
  const auto begin = [](int32_t pixel) { return (pixel + kHairCell - 1) / kHairCell; };
  for (int32_t row = begin(tile.y); row < begin(tile.y + tile.height); ++row) {
    for (int32_t column = begin(tile.x); column < begin(tile.x + tile.width); ++column) {
      act(column, row);
    }
  }
}

// Returns the rectangle of a cell in pixels of the picture.
inline Rect HairCellAt(const SweepSetup& setup, int32_t column, int32_t row) {
  const int32_t x = column * kHairCell, y = row * kHairCell;
  return {x, y, Min(kHairCell, setup.width - x), Min(kHairCell, setup.height - y)};
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_HAIR_CELLS_H_
