// SPDX-License-Identifier: Apache-2.0
// Finds and rates the candidate surfaces of each doubtful pixel by colour. The candidates are the
// disparities of the surrounding pixels. A candidate disparity has a low cost if surrounding pixels
// with this disparity have a colour similar to the doubtful pixel. Sums of costs along paths favour
// a common surface for neighbouring pixels of similar colour.
#ifndef STARFOCUS_LIB_DEPTH_COLOUR_CHOICES_H_
#define STARFOCUS_LIB_DEPTH_COLOUR_CHOICES_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/arena.h"
#include "lib/depth/colour_map.h"

namespace starfocus {

inline constexpr int32_t kMostChoices = 6;

// Candidate disparities of a pixel, in fixed point (kDisparityBits). `cost` is the cost of each
// candidate at this pixel alone, and `sum` is the sum of path costs. The unit of costs and sums is
// a colour difference of one code.
struct Choices {
  int32_t count;
  int16_t disparity[kMostChoices], cost[kMostChoices], sum[kMostChoices];
};

struct ChoicePath;
struct ColourCell;

// Scratch memory of a worker for one region.
struct ChoiceMemory {
  Choices* choices;
  ChoicePath* paths;  // path of each column
  ColourCell* cell;
};
// Takes memory for regions of at most `width` columns and `area` pixels.
ChoiceMemory TakeChoices(size_t width, size_t area, Arena* arena);

// Fills memory.choices with the choices of the doubtful pixels of `region`, row by row, and
// computes the sum of path costs of each choice. The elements of other pixels are not written.
void WeighChoices(const ColourMap& map, const uint8_t* doubt, const Rect& region,
                  const simd::DepthKernels& kernels, const ChoiceMemory& memory);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_COLOUR_CHOICES_H_
