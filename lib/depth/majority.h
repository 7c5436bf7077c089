// SPDX-License-Identifier: Apache-2.0
// Smooths the outlines of a repaired map. Each pixel near an outline is assigned to the surface to
// which most surrounding pixels of similar colour belong, and rests of the map's ramps are removed
// from the surfaces.
#ifndef STARFOCUS_LIB_DEPTH_MAJORITY_H_
#define STARFOCUS_LIB_DEPTH_MAJORITY_H_

#include <cstdint>

#include "lib/depth/colour_map.h"

namespace starfocus {

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

#endif  // STARFOCUS_LIB_DEPTH_MAJORITY_H_
