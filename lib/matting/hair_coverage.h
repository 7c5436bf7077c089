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

// Side of a patch in pixels, and side of a block of patches that vote together.
inline constexpr int32_t kHairPatch = 4, kHairBlock = 8;
// Fractional bits of mean colours.
inline constexpr int kMeanBits = 6;
// Weight of a mean colour that is fully known.
inline constexpr int kKnownBits = 8;
inline constexpr int32_t kFullyKnown = 1 << kKnownBits;

struct ColourMean {
  uint16_t rgb[3];  // Mean colour, in fixed point (kMeanBits).
  uint16_t weight;  // Weight of the mean, [0, kFullyKnown].
};

// Extends the colours of a surface from pixels that show the surface to pixels that do not (the
// pull-push algorithm). Level 0 contains the patches of the picture. Each patch of a higher level
// contains the weighted mean of 2x2 patches of the level below, and the last level a single patch.
struct ColourPyramid {
  static constexpr int kMostLevels = 16;
  int32_t columns, rows, count;  // patches of level 0; number of levels
  ColourMean* levels[kMostLevels];

  int32_t Columns(int level) const { return ((columns - 1) >> level) + 1; }
  int32_t Rows(int level) const { return ((rows - 1) >> level) + 1; }
  ColourMean& At(int level, int32_t x, int32_t y) const {
    return levels[level][ptrdiff_t{y} * Columns(level) + x];
  }
};
// Takes the pyramid of a picture of width x height pixels.
ColourPyramid TakeColourPyramid(int32_t width, int32_t height, Arena* arena);

// Pulls the means of level 0 up to the single patch and pushes the means down again, which fills in
// patches of low weight. Returns false if all weights are 0.
bool CarryOnColours(const ColourPyramid& pyramid);

// Interpolates the colour of pixel (x, y) bilinearly from level 0, in fixed point (kMeanBits).
void ColourAt(const ColourPyramid& pyramid, int32_t x, int32_t y, int32_t* rgb);

// Votes of the pixels of a block in patches inside and outside outlines, where it does not matter
// if outlines are off by a few pixels.
struct HairVotes {
  // Number of pixels of inside patches; of those that differ less from the background colour than a
  // third of the contrast; of those that have nearly the background colour.
  int32_t inside, far, same;
  // Sum of coverage, sum of squares, and sum of squared differences from the mean of the pixel's
  // patch; the coverage is in units of 1/256.
  int32_t sum, squares, fine;
  // Number of pixels of outside patches; sum of their coverage, in units of 1/256.
  int32_t outside, beyond;
  // To what degree the colours in and around the block are those of hair, 0 to 256.
  int32_t found;
};

// Memory of the search in patches and blocks of a picture of width x height pixels.
struct HairMemory {
  int32_t width, height, columns, rows, block_columns, block_rows;
  int16_t *least, *greatest;  // Range of the disparities of each patch.
  int16_t *low, *high;        // Range of the disparities of all patches at most 10 patches away.
  uint8_t* hair;              // To what degree each patch shows hair, 0 to 255.
  ColourPyramid far, near;
  HairVotes* votes;  // One element for each block.

  // Smallest difference of disparity between two surfaces, kDisparityBits.
  static constexpr int32_t kEdgeStep = 5 << kDisparityBits;

  size_t At(int32_t column, int32_t row) const {
    return static_cast<size_t>(row) * static_cast<size_t>(columns) + static_cast<size_t>(column);
  }
  HairVotes& VotesAt(int32_t column, int32_t row) const {
    return votes[row * block_columns + column];
  }
  // Returns true if there are two surfaces within 10 patches.
  bool HasEdge(size_t patch) const { return high[patch] - low[patch] > kEdgeStep; }
  // Returns true if the disparity belongs to the nearer of the two surfaces around a patch.
  bool IsNear(size_t patch, int32_t disparity) const {
    return HasEdge(patch) && 2 * disparity > low[patch] + high[patch];
  }
};
HairMemory TakeHairMemory(int32_t width, int32_t height, Arena* arena);

// Number of phases that FindHairCoverage runs or skips.
inline constexpr int32_t kHairPhases = 7;

// Finds the patches with hair from the R, G and B of each pixel and the map (kDisparityBits), and
// writes the coverage of their pixels. Returns true if any patch has hair, and false after an
// error.
bool FindHairCoverage(const Plane<const uint8_t>& rgb, const Plane<const int16_t>& disparity,
                      const Plane<uint8_t>& coverage, const HairMemory& memory, Sequence* run);

// Returns true if any patch that overlaps the rectangle has hair.
bool HasHair(const HairMemory& memory, const Rect& rect);

// Completes the coverage of the pixels [columns.first, columns.last) of row y. `disparity` has the
// final disparities of these pixels. Where the patch shows no hair, the coverage is 0 for far
// pixels and 255 for near pixels. Where the patch shows hair, writes the confidence if `confidence`
// is not null: 255 minus the difference between the coverage and the coverage that the map alone
// implies.
void CompleteCoverage(const HairMemory& memory, const Range& columns, int32_t y,
                      const int16_t* disparity, uint8_t* coverage, uint8_t* confidence);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_MATTING_HAIR_COVERAGE_H_
