// SPDX-License-Identifier: Apache-2.0
// Finds the coverage of hair that a map shows as a solid shape, as is usual in disparity maps of
// monocular networks. Pyramids extend the pure colours of foreground and background to each pixel
// near an outline. The coverage of a pixel is the position of its colour between the foreground
// colour and the background colour. Coverage is found only in places where the pixels inside the
// outline look like hair: many have the colour of the background, and the others are mixtures of
// the colours of foreground and background.
#ifndef STARFOCUS_LIB_MATTING_HAIR_COVERAGE_H_
#define STARFOCUS_LIB_MATTING_HAIR_COVERAGE_H_

#include <cstdint>

#include "lib/base/arena.h"
#include "lib/base/geometry.h"
#include "lib/base/jobs.h"
#include "lib/matting/colour_pyramid.h"

namespace starfocus {

// A picture and its map.
struct HairPicture {
  int32_t width, height;
  Plane<const uint8_t> rgb;        // R, G, B of each pixel
  Plane<const int16_t> disparity;  // kDisparityBits
  Plane<uint8_t> coverage;         // output
};

// Votes of the pixels of a block on whether the block shows hair.
struct HairVotes;

// Memory of the search, with one element per cell of the lowest level of a ColourPyramid.
struct HairMemory {
  int32_t columns, rows;
  // Lowest and highest disparity of the cell; later, of all cells that are at most 10 cells away.
  int16_t *low, *high;
  uint8_t* marks;
  // To what degree the cell shows hair, 0 to 255.
  uint8_t* hair;
  // FindHairCoverage alone uses the following.
  ColourPyramid far, near;
  uint16_t* contrast;  // Largest contrast between a near pixel of the cell and the background.
  HairVotes* votes;    // One element for each block.

  // Marks. A cell has an edge if there are two surfaces within 10 cells.
  static constexpr uint8_t kHasEdge = 1;
  // The cell has an edge, and pixels of the nearer or the farther of its two surfaces.
  static constexpr uint8_t kHasNear = 2, kHasFar = 4;

  size_t At(int32_t column, int32_t row) const {
    return static_cast<size_t>(row) * static_cast<size_t>(columns) + static_cast<size_t>(column);
  }
  // Returns true if a pixel of the cell belongs to the nearer surface of an edge.
  bool IsNear(size_t cell, int32_t disparity) const {
    return (marks[cell] & kHasEdge) != 0 && 2 * disparity > low[cell] + high[cell];
  }
};

// Takes the memory of a search in a picture of width x height pixels. TakeHairColours takes the
// part that FindHairCoverage alone uses.
HairMemory TakeHairMemory(int32_t width, int32_t height, Arena* arena);
void TakeHairColours(int32_t width, int32_t height, Arena* arena, HairMemory* memory);

// Number of phases that FindHairCoverage runs or skips.
inline constexpr int32_t kHairPhases = 9;

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
