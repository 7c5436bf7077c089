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

// Colours of DrawDepth at equal steps of disparity, from the farthest to the nearest. The colours
// between two entries are interpolated. These are nine colours of the colour map viridis
// (https://bids.github.io/colormap/, CC0), whose lightness increases from far to near.
inline constexpr uint8_t kDepthColors[9][3] = {{68, 1, 84},    {71, 45, 123},  {59, 82, 139},
                                               {44, 114, 142}, {33, 145, 140}, {40, 174, 128},
                                               {94, 201, 98},  {173, 220, 48}, {253, 231, 37}};

// Draws a finite map in the colours kDepthColors, of which the first means stats.min and the last
// stats.max. All values must be in this range. `map` may be a sample of the map that was measured.
Image DrawDepth(const FloatMap& map, const starfocus_disparity_stats& stats);

// Reduces a map to `width` x `height` pixels. Every pixel of the result has the disparity at its
// centre, so that edges stay sharp.
FloatMap SampleMap(const FloatMap& map, int width, int height);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_DISPARITY_MAP_FIGURES_H_
