// SPDX-License-Identifier: Apache-2.0
// Disparity maps for people to look at.
#ifndef STARFOCUS_EXAMPLES_CLI_DISPARITY_MAP_FIGURES_H_
#define STARFOCUS_EXAMPLES_CLI_DISPARITY_MAP_FIGURES_H_

#include <cstdint>
#include <vector>

#include "platform/image.h"
#include "platform/pfm.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// How many finite disparities lie in each of so many equal parts of the measured range.
std::vector<int64_t> Histogram(const FloatMap& map, const starfocus_disparity_stats& stats,
                               int bins);

// A finite map as a picture: the nearest is white.
Image DrawDisparity(const FloatMap& map);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_DISPARITY_MAP_FIGURES_H_
