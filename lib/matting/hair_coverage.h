// SPDX-License-Identifier: Apache-2.0
// Finds the coverage of hair that a map shows as a solid shape, as is usual in disparity maps of
// monocular networks. Pyramids extend the pure colours of foreground and background to each pixel
// near an outline. The coverage of a pixel is the position of its colour between the foreground
// colour and the background colour. Coverage is found only in places where the pixels inside the
// outline look like hair: many have the colour of the background, and the others are mixtures of
// the colours of foreground and background.
#ifndef STARFOCUS_LIB_MATTING_HAIR_COVERAGE_H_
#define STARFOCUS_LIB_MATTING_HAIR_COVERAGE_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/arena.h"
#include "lib/base/fixed.h"
#include "lib/base/geometry.h"
#include "lib/base/jobs.h"

namespace starfocus {

// Side of a cell in pixels, and side of a block of cells that vote together.
inline constexpr int32_t kHairCell = 4, kHairBlock = 8;
// Fractional bits of mean colours.
inline constexpr int kMeanBits = 6;
// Weight of a mean colour that is fully known.
inline constexpr int kKnownBits = 8;
inline constexpr int32_t kFullyKnown = 1 << kKnownBits;

struct ColourMean {
  uint16_t rgb[3];  // Mean colour, in fixed point (kMeanBits).
  uint16_t weight;  // Weight of the mean, [0, kFullyKnown].
};

struct ColourLevel {
  int32_t columns, rows;
  ColourMean* means;

  ColourMean& At(int32_t x, int32_t y) const {
    return means[static_cast<size_t>(y) * static_cast<size_t>(columns) + static_cast<size_t>(x)];
  }
};

// Extends the colours of a surface from pixels that show the surface to pixels that do not (the
// pull-push algorithm). levels[0] contains the cells of the picture. Each cell of a higher level
// contains the weighted mean of 2x2 cells of the level below, and the last level a single cell.
struct ColourPyramid {
  static constexpr int kMostLevels = 16;
  int32_t count;
  ColourLevel levels[kMostLevels];
};
ColourPyramid TakeColourPyramid(int32_t width, int32_t height, Arena* arena);

// Pulls the means of levels[0] up to the single cell and pushes the means down again, which fills
// in cells of low weight. Returns false if all weights are 0.
bool CarryOnColours(const ColourPyramid& pyramid);

// Interpolates the colour of pixel (x, y) bilinearly from levels[0], in fixed point (kMeanBits).
void ColourAt(const ColourPyramid& pyramid, int32_t x, int32_t y, int32_t* rgb);

// A picture and its map.
struct HairPicture {
  int32_t width, height;
  Plane<const uint8_t> rgb;        // R, G, B of each pixel
  Plane<const int16_t> disparity;  // kDisparityBits
  Plane<uint8_t> coverage;         // output
};

// Votes of the pixels of a block on whether the block shows hair.
struct HairVotes;

// Memory of the search in cells and blocks.
struct HairMemory {
  int32_t columns, rows, block_columns, block_rows;
  int16_t *least, *greatest;  // Range of the disparities of each cell.
  int16_t *low, *high;        // Range of the disparities of all cells at most 10 cells away.
  uint8_t* hair;              // To what degree each cell shows hair, 0 to 255.
  // FindHairCoverage alone uses the following.
  ColourPyramid far, near;
  HairVotes* votes;  // One element for each block.

  // Smallest difference of disparity between two surfaces, kDisparityBits.
  static constexpr int32_t kEdgeStep = 5 << kDisparityBits;

  size_t At(int32_t column, int32_t row) const {
    return static_cast<size_t>(row) * static_cast<size_t>(columns) + static_cast<size_t>(column);
  }
  size_t BlockAt(int32_t column, int32_t row) const {
    return static_cast<size_t>(row * block_columns + column);
  }
  HairVotes& VotesAt(int32_t column, int32_t row) const;
  // Returns true if there are two surfaces within 10 cells.
  bool HasEdge(size_t cell) const { return high[cell] - low[cell] > kEdgeStep; }
  // Returns true if the disparity belongs to the nearer of the two surfaces around a cell.
  bool IsNear(size_t cell, int32_t disparity) const {
    return HasEdge(cell) && 2 * disparity > low[cell] + high[cell];
  }
};

// Takes the memory of a search in a picture of width x height pixels. TakeHairColours takes the
// part that FindHairCoverage alone uses.
HairMemory TakeHairMemory(int32_t width, int32_t height, Arena* arena);
void TakeHairColours(int32_t width, int32_t height, Arena* arena, HairMemory* memory);

// Number of phases that FindHairCoverage runs or skips.
inline constexpr int32_t kHairPhases = 7;

// Finds the cells with hair and writes the coverage of their pixels. Returns true if any cell has
// hair, and false after an error.
bool FindHairCoverage(const HairPicture& picture, const HairMemory& memory, Sequence* run);

// Returns true if any cell that overlaps the rectangle has hair.
bool HasHair(const HairMemory& memory, const Rect& rect);

// Completes the coverage of the pixels [columns.first, columns.last) of row y. `disparity` has the
// final disparities of these pixels. Where the cell shows no hair, the coverage is 0 for far pixels
// and 255 for near pixels. Where the cell shows hair, writes the confidence if `confidence` is not
// null: 255 minus the difference between the coverage and the coverage that the map alone implies.
void CompleteCoverage(const HairMemory& memory, const Range& columns, int32_t y,
                      const int16_t* disparity, uint8_t* coverage, uint8_t* confidence);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_MATTING_HAIR_COVERAGE_H_
