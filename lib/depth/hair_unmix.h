// SPDX-License-Identifier: Apache-2.0
// How much near light the pixels of hair show, by the near and the far colour around: jobs for
// the tiles of a HairJob.
#ifndef STARFOCUS_LIB_DEPTH_HAIR_UNMIX_H_
#define STARFOCUS_LIB_DEPTH_HAIR_UNMIX_H_

#include <cstdint>

namespace starfocus {

// Count the near pixels that look far: of a tile's cells inside outlines, and of each cell.
void CountInside(const void* data, int32_t index, int32_t worker);
void CountCells(const void* data, int32_t index, int32_t worker);

// Write the coverage of cells that have hair. The second time the far colour of a pixel is the more
// its own, the more it was found to be far.
void UnmixFirst(const void* data, int32_t index, int32_t worker);
void UnmixAgain(const void* data, int32_t index, int32_t worker);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_HAIR_UNMIX_H_
