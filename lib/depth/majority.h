// SPDX-License-Identifier: Apache-2.0
// Smooths the outlines of a repaired map: each pixel near an outline joins the surface that most
// pixels of similar colour around it belong to.
#ifndef STARFOCUS_LIB_DEPTH_MAJORITY_H_
#define STARFOCUS_LIB_DEPTH_MAJORITY_H_

#include <cstdint>

#include "lib/depth/colour_map.h"

namespace starfocus {

// TakeMajority changes pixels within kMajorityReach of another surface, whose disparity differs by
// more than kMajorityStep.
inline constexpr int32_t kMajorityReach = 2, kMajorityStep = 2 * kSurfaceStep;
// Rows of pixels are at most this long.
inline constexpr int32_t kMostMajority = 32;

// Writes the disparities of a row of pixels: each its own one, or the mean of the other surface's
// around it if more pixels of its colour are of that one.
void TakeMajority(const ColourMap& map, const Rect& row, int16_t* disparity);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_MAJORITY_H_
