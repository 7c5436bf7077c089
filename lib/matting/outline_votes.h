// SPDX-License-Identifier: Apache-2.0
// Decides on which side of an outline the pixels of its band lie (outlines.h). The functions
// process one tile, and each needs the results of the previous one for the pixels around the tile.
#ifndef STARFOCUS_LIB_MATTING_OUTLINE_VOTES_H_
#define STARFOCUS_LIB_MATTING_OUTLINE_VOTES_H_

#include <cstdint>

#include "lib/matting/outline_planes.h"

namespace starfocus {

// Calls act(x, y, index) for each pixel of the band in `rect`.
template <class Act>
void ForBand(const OutlineMemory& memory, const Rect& rect, const Act& act) {
  for (int32_t y = rect.y; y < rect.y + rect.height; ++y) {
    const size_t row = memory.At(0, y);
    for (int32_t x = rect.x; x < rect.x + rect.width; ++x) {
      const size_t at = row + static_cast<size_t>(x);
      if (memory.distance[at] != 0) act(x, y, at);
    }
  }
}

// Writes memory.vote.
void VoteByColour(const OutlinePicture& picture, const OutlineMemory& memory,
                  const OutlinePass& pass, const int16_t* map, const Rect& tile);

// Writes memory.shift and memory.gain.
void ShiftOutlines(const OutlineMemory& memory, const OutlinePass& pass, const Rect& tile);

// Writes memory.side.
void SnapToColours(const OutlinePicture& picture, const OutlineMemory& memory, const int16_t* map,
                   const Rect& tile);

// Returns true if pixel (x, y) of the band belongs to the nearer side according to memory.side of
// the pixel and its neighbours.
bool IsNearer(const OutlineMemory& memory, const int16_t* map, int32_t x, int32_t y);

// Returns the disparity of pixel (x, y) of the band (kDisparityBits).
int16_t DisparityOfSide(const OutlineMemory& memory, const OutlinePass& pass, const int16_t* map,
                        int32_t x, int32_t y);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_MATTING_OUTLINE_VOTES_H_
