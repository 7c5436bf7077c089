// SPDX-License-Identifier: Apache-2.0
// Extends the colours of a surface from pixels that show the surface to pixels that do not (the
// pull-push algorithm). The lowest level of a pyramid has cells of 4x4 pixels. Each cell of a
// higher level contains the weighted mean of 2x2 cells of the level below.
#ifndef STARFOCUS_LIB_MATTING_COLOUR_PYRAMID_H_
#define STARFOCUS_LIB_MATTING_COLOUR_PYRAMID_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/arena.h"

namespace starfocus {

// Side of a cell of the lowest level, in pixels.
inline constexpr int32_t kColourCell = 4;
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
  void Add(const uint16_t* rgb, uint32_t weight) {
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
  int32_t rgb[kColourCell][kColourCell][3];
};
// Interpolates the colours of a cell's pixels bilinearly from levels[0].
void InterpolateCell(const ColourPyramid& pyramid, int32_t column, int32_t row,
                     CellColours* colours);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_MATTING_COLOUR_PYRAMID_H_
