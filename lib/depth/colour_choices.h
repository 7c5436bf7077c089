// SPDX-License-Identifier: Apache-2.0
// Which surface a doubtful pixel is of, by colour: of the disparities around it those whose pixels
// have its colour cost least, and neighbours of one colour go on with each other's.
#ifndef STARFOCUS_LIB_DEPTH_COLOUR_CHOICES_H_
#define STARFOCUS_LIB_DEPTH_COLOUR_CHOICES_H_

#include <cstdint>

#include "lib/depth/colour_cell.h"
#include "lib/depth/colour_map.h"
#include "simd/depth_kernels.h"

namespace starfocus {

inline constexpr int32_t kMostChoices = 6;

// The disparities that a pixel may have, kDisparityBits, and what each costs, in steps of colour:
// alone and summed along paths.
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
  ChoicePath* paths;  // a row
  ColourCell* cell;
};

// Fills the choices of `region`, row after row, and their sums.
void WeighChoices(const ColourMap& map, const uint8_t* doubt, const Rect& region,
                  const simd::DepthKernels& kernels, const ChoiceMemory& memory);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_COLOUR_CHOICES_H_
