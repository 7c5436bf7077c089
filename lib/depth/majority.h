// SPDX-License-Identifier: Apache-2.0
// Smooths the outlines of a repaired map. Each pixel near an outline joins the surface to which
// most pixels of similar colour around it belong.
#ifndef STARFOCUS_LIB_DEPTH_MAJORITY_H_
#define STARFOCUS_LIB_DEPTH_MAJORITY_H_

#include <cstdint>

#include "lib/depth/colour_map.h"

namespace starfocus {

// TakeMajority changes pixels within kMajorityReach of another surface, whose disparity differs by
// more than kMajorityStep.
inline constexpr int32_t kMajorityReach = 2, kMajorityStep = 2 * kSurfaceStep;
// Largest length of a row of pixels.
inline constexpr int32_t kMostMajority = 32;

// Writes the disparities of a row of pixels. A pixel keeps its own disparity unless more pixels of
// its colour belong to the other surface. In that case it gets the mean of that surface around it.
void TakeMajority(const ColourMap& map, const Rect& row, int16_t* disparity);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_MAJORITY_H_
