// SPDX-License-Identifier: Apache-2.0
// Changes the outlines of a repaired map. CellRanges find the areas without a step of disparity.
//
// CountSoft and SoftnessOf measure how soft the edges of a picture are, and WidenedAt widens the
// nearer surfaces. Lenses and sharpening filters mix several pixels next to an outline. The mixed
// pixels must belong to the nearer surface. As part of the farther surface, the mixed pixels would
// stay sharp inside the blur of the nearer surface.
//
// TakeMajority smooths the outlines: each pixel near an outline is assigned to the surface to which
// most surrounding pixels of similar colour belong. MedianOfSurface removes rests of the map's
// ramps from the surfaces.
#ifndef STARFOCUS_LIB_DEPTH_OUTLINES_H_
#define STARFOCUS_LIB_DEPTH_OUTLINES_H_

#include <cstdint>

#include "lib/base/arena.h"
#include "lib/depth/colour_map.h"
#include "lib/depth/thin_cells.h"

namespace starfocus {

// Smallest and largest disparity of each cell of a map, row by row. With the ranges, areas without
// a step are found without reading their pixels again.
struct CellRanges {
  int16_t *low, *high;
};
CellRanges TakeCellRanges(const ThinGrid& grid, Arena* arena);

// Fills the ranges of the cells of tile `index` of a map.
void MeasureCells(const ThinGrid& grid, const int16_t* map, int32_t index,
                  const CellRanges& ranges);

// Returns true if two disparities in cell `number` and the eight cells around it differ by more
// than `step`.
bool MayHaveStep(const ThinGrid& grid, const CellRanges& ranges, int32_t number, int32_t step);

// Largest number of pixels by which the nearer surface is widened.
inline constexpr int32_t kMostSoft = 3;

// Neighbouring pixels whose disparities differ by more than kSoftStep (kDisparityBits) form an
// edge.
inline constexpr int32_t kSoftStep = 5 << kDisparityBits;

// Counts of the edges of a tile. `edges` is the number of edges at which a colour profile was
// measured. Let pixel k + 1 of a profile be the pixel that lies k + 1 pixels beyond the first pixel
// of the farther surface. mixed[k] is the number of profiles in which pixel k + 1 shows a part of
// the nearer surface.
struct SoftCount {
  int32_t edges;
  int32_t mixed[kMostSoft];
};

// Adds the counts of the edges in a rectangle to *count.
void CountSoft(const ColourMap& map, const Rect& rect, SoftCount* count);

// Returns the number of pixels by which nearer surfaces should be widened, at most kMostSoft. The
// result is one more than the number of consecutive pixels that show a part of the nearer surface
// in at least half of the profiles. If no pixel shows the nearer surface in at least half of the
// profiles, the result is 0.
int32_t SoftnessOf(const SoftCount* counts, int32_t tiles);

// Returns the disparity of the nearest surface that is much nearer than pixel (x, y) and that the
// pixel shows in part. The surface is searched along the row and the column of the pixel, within
// `softness` pixels. If the pixel shows no part of a nearer surface, returns the pixel's own
// disparity.
int16_t WidenedAt(const ColourMap& map, int32_t softness, int32_t x, int32_t y);

// TakeMajority may change a pixel if there is another surface within kMajorityReach pixels. Two
// surfaces differ by more than kMajorityStep in disparity.
inline constexpr int32_t kMajorityReach = 2, kMajorityStep = 2 * kSurfaceStep;
// Largest number of pixels in the `row` argument of TakeMajority.
inline constexpr int32_t kMostMajority = 32;

// Writes the disparities of a row of pixels. A pixel keeps its disparity unless another surface has
// a larger weight among the surrounding pixels of similar colour, or the pixel is the only one of
// its surface. A pixel that changes gets the weighted mean disparity of the pixels on its new
// surface.
void TakeMajority(const ColourMap& map, const Rect& row, int16_t* disparity);

// Returns the median disparity of the 3x3 pixels around pixel (x, y) that are on its surface, or
// the disparity of the pixel if both differ by at most a quarter of a pixel. A pixel that keeps
// part of a ramp of the map between two surfaces would show light of the other surface.
int16_t MedianOfSurface(const ColourMap& map, int32_t x, int32_t y);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_OUTLINES_H_
