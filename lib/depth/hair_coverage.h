// SPDX-License-Identifier: Apache-2.0
// Finds the coverage of hair that a map shows as a solid shape, as is usual in disparity maps of
// monocular networks. Pyramids extend the pure colours of foreground and background to each pixel
// near an outline. The coverage of a pixel is the position of its colour between the foreground
// colour and the background colour. RepairByColour calls the functions of this header.
#ifndef STARFOCUS_LIB_DEPTH_HAIR_COVERAGE_H_
#define STARFOCUS_LIB_DEPTH_HAIR_COVERAGE_H_

#include <cstdint>

#include "lib/depth/hair_cells.h"
#include "lib/depth/maps.h"

namespace starfocus {

struct InsideCount;

// Memory of the search for hair coverage.
struct HairMemory {
  ColourPyramid far, near;
  // `contrast` and `near_pixels` have one value per cell. At first, `contrast` holds the largest
  // squared contrast between a near pixel and the background. Later, `contrast` holds the number of
  // near pixels that look like background, multiplied by 256. `near_pixels` holds the number of
  // near pixels of each cell.
  int32_t *contrast, *near_pixels;
  InsideCount* counts;  // one element for each tile
};

HairMemory TakeHairMemory(const SweepSetup& setup, Arena* arena);

// Number of phases that FindHairCoverage runs or skips.
inline constexpr int32_t kHairPhases = 9;

// Marks the cells with hair and writes the coverage of their pixels. Returns true if any cell has
// hair, and false after an error.
bool FindHairCoverage(const ColourMap& map, const MapOutput& output, const HairCells& cells,
                      const HairMemory& memory, Sequence* run);

// Completes the coverage of a tile whose disparities have been written. In cells without hair, the
// coverage is 0 for far pixels and 255 for near pixels. In cells with hair, the confidence is 255
// minus the difference between the coverage and the coverage that the map alone implies (0 or 255).
void CompleteCoverage(const ColourMap& map, const MapOutput& output, const HairCells& cells,
                      const Rect& tile);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_HAIR_COVERAGE_H_
