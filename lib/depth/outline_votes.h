// SPDX-License-Identifier: Apache-2.0
// Decides on which side of an outline the pixels of its band lie (outlines.h). The functions
// process one tile, and each needs the results of the previous one for the pixels around the tile.
#ifndef STARFOCUS_LIB_DEPTH_OUTLINE_VOTES_H_
#define STARFOCUS_LIB_DEPTH_OUTLINE_VOTES_H_

#include <cstdint>
#include <cstring>

#include "lib/depth/outline_planes.h"
#include "simd/kernels.h"

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

// Returns true if a pixel of `rect` belongs to the band.
inline bool HasBand(const OutlineMemory& memory, const Rect& rect) {
  static constexpr int8_t kNone[kMostOutlineTile] = {};
  const auto count = static_cast<size_t>(rect.width);
  for (int32_t y = rect.y; y < rect.y + rect.height; ++y) {
    if (std::memcmp(memory.distance + memory.At(rect.x, y), kNone, count) != 0) return true;
  }
  return false;
}

// Calls act(disparity, dx, dy) for the four neighbours of a pixel.
template <class Act>
void ForBeside(const OutlineMemory& memory, const int16_t* map, int32_t x, int32_t y,
               const Act& act) {
  const int16_t* own = map + memory.At(x, y);
  if (x > 0) act(int32_t{own[-1]}, -1, 0);
  if (x + 1 < memory.width) act(int32_t{own[1]}, 1, 0);
  if (y > 0) act(int32_t{own[-memory.width]}, 0, -1);
  if (y + 1 < memory.height) act(int32_t{own[memory.width]}, 0, 1);
}

// Calls act(number, cell, begins) for the cells that a tile touches. `begins` is true if the first
// pixel of the cell lies in the tile.
template <class Act>
void ForShiftCells(const OutlineMemory& memory, const Rect& tile, const Act& act) {
  const ShiftCells columns = memory.Columns(), rows = memory.Rows();
  for (int32_t row = rows.Of(tile.y); row <= rows.Of(tile.y + tile.height - 1); ++row) {
    const int32_t top = rows.Begin(row), height = rows.Begin(row + 1) - top;
    for (int32_t column = columns.Of(tile.x); column <= columns.Of(tile.x + tile.width - 1);
         ++column) {
      const int32_t left = columns.Begin(column), width = columns.Begin(column + 1) - left;
      act(row * columns.Count() + column, Rect{left, top, width, height},
          left >= tile.x && top >= tile.y);
    }
  }
}

// Pixels of a block and the pixels around it, in planes, for simd::SumVotes.
struct VoteBlock {
  static constexpr int32_t kSide = 128, kWidth = kSide + 2 * kMostReach;

  int16_t colour[3][kWidth * kWidth], surface[kWidth * kWidth], trust[kWidth * kWidth];
};

// Writes memory.vote, from samples that are trusted by their distance to the outline.
void VoteByColour(const OutlinePicture& picture, const OutlineMemory& memory,
                  const OutlinePass& pass, const int16_t* map, const Rect& tile, VoteBlock* block);

// Writes memory.shift and memory.gain of the cells whose first pixels lie in the tile.
void ShiftOutlines(const OutlineMemory& memory, const OutlinePass& pass, const Rect& tile);

// Writes memory.side, from samples that are trusted by their own votes, and from the distance to
// the displaced outline.
void VoteAgain(const OutlinePicture& picture, const OutlineMemory& memory, const OutlinePass& pass,
               const int16_t* map, const Rect& tile, VoteBlock* block);

// Planes of a region of at most kMostRegion^2 pixels and a margin of one, for TakeDisparities, and
// the pixels that have no disparity yet.
struct SidePlanes {
  static constexpr size_t kSamples = (kMostRegion + 2) * (kMostRegion + 2);

  int16_t disparity[kSamples];
  uint8_t state[kSamples];
  uint8_t ready[kSamples];  // a bit for odd and one for even rounds
  int32_t pending[kSamples];
};

// Copies `map` to `repaired` in the tile, except pixels that change their side or lie on a ramp:
// these take the disparities of their side around them.
void TakeDisparities(const OutlineMemory& memory, const OutlinePass& pass, const int16_t* map,
                     const Rect& tile, SidePlanes* planes, int16_t* repaired);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_OUTLINE_VOTES_H_
