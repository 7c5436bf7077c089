// SPDX-License-Identifier: Apache-2.0
// Visualizes disparity maps.
#ifndef STARFOCUS_EXAMPLES_CLI_DISPARITY_MAP_FIGURES_H_
#define STARFOCUS_EXAMPLES_CLI_DISPARITY_MAP_FIGURES_H_

#include <cstdint>
#include <vector>

#include "platform/image.h"
#include "platform/pfm.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Counts the finite disparities in each of `bins` equal parts of the measured range.
std::vector<int64_t> Histogram(const FloatMap& map, const starfocus_disparity_stats& stats,
                               int bins);

// Draws a finite map as a picture in which the nearest disparity is white.
Image DrawDisparity(const FloatMap& map);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_DISPARITY_MAP_FIGURES_H_
