// SPDX-License-Identifier: Apache-2.0
// Jobs that compare pixels with the surrounding foreground and background colours. Each job
// processes one tile; `data` is a HairJob.
#ifndef STARFOCUS_LIB_DEPTH_HAIR_UNMIX_H_
#define STARFOCUS_LIB_DEPTH_HAIR_UNMIX_H_

#include <cstdint>

namespace starfocus {

// Count the near pixels that look like background. CountInside processes only the cells with
// kIsInside, and CountCells processes all cells.
void CountInside(const void* data, int32_t index, int32_t worker);
void CountCells(const void* data, int32_t index, int32_t worker);

// Write the coverage of cells with hair. In the second pass, the background colour of a pixel is
// mixed with the pixel's own colour. The share of the pixel's own colour increases as the coverage
// from the first pass decreases.
void UnmixFirst(const void* data, int32_t index, int32_t worker);
void UnmixAgain(const void* data, int32_t index, int32_t worker);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_HAIR_UNMIX_H_
