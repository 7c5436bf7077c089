// SPDX-License-Identifier: Apache-2.0
// Finds and rates the candidate surfaces of each doubtful pixel by colour. The candidates are the
// disparities of the surrounding pixels. A candidate has a low cost if its pixels have a colour
// similar to the doubtful pixel. Sums along paths then make neighbours of one colour prefer one
// surface.
#ifndef STARFOCUS_LIB_DEPTH_COLOUR_CHOICES_H_
#define STARFOCUS_LIB_DEPTH_COLOUR_CHOICES_H_

#include <cstdint>

#include "lib/depth/colour_cell.h"
#include "lib/depth/colour_map.h"
#include "simd/depth_kernels.h"

namespace starfocus {

inline constexpr int32_t kMostChoices = 6;

// Candidate disparities of a pixel, kDisparityBits. `cost` is the cost of each candidate without
// its neighbours, and `sum` the sum of path costs. Costs and sums are in codes of colour
// difference.
struct Choices {
  int32_t count;
  int16_t disparity[kMostChoices], cost[kMostChoices], sum[kMostChoices];
};

// Costs of a path up to a pixel, one for each choice of the pixel.
struct ChoicePath {
  int16_t cost[kMostChoices];
};

// Scratch memory of a worker for one region.
struct ChoiceMemory {
  Choices* choices;
  ChoicePath* paths;  // paths of one row
  ColourCell* cell;
};

// Fills memory.choices with the choices of all pixels of `region`, row by row, and computes the
// sums of the choices.
void WeighChoices(const ColourMap& map, const uint8_t* doubt, const Rect& region,
                  const simd::DepthKernels& kernels, const ChoiceMemory& memory);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_COLOUR_CHOICES_H_
