// SPDX-License-Identifier: Apache-2.0
// Chooses the surface of each doubtful pixel by colour. The candidates are the surrounding
// disparities; those whose pixels have a similar colour cost least. Paths then make neighbours of
// one colour prefer the same surface.
#ifndef STARFOCUS_LIB_DEPTH_COLOUR_CHOICES_H_
#define STARFOCUS_LIB_DEPTH_COLOUR_CHOICES_H_

#include <cstdint>

#include "lib/depth/colour_cell.h"
#include "lib/depth/colour_map.h"
#include "simd/depth_kernels.h"

namespace starfocus {

inline constexpr int32_t kMostChoices = 6;

// Candidate disparities of a pixel, kDisparityBits. `cost` is the cost of each one alone, `sum` its
// sum over paths, both in codes of colour difference.
struct Choices {
  int32_t count;
  int16_t disparity[kMostChoices], cost[kMostChoices], sum[kMostChoices];
};

// Costs of a path up to a pixel.
struct ChoicePath {
  int16_t cost[kMostChoices];
};

// Scratch memory of a worker for one region.
struct ChoiceMemory {
  Choices* choices;
  ChoicePath* paths;  // one row
  ColourCell* cell;
};

// Fills the choices of `region`, row by row, and their sums.
void WeighChoices(const ColourMap& map, const uint8_t* doubt, const Rect& region,
                  const simd::DepthKernels& kernels, const ChoiceMemory& memory);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_COLOUR_CHOICES_H_
