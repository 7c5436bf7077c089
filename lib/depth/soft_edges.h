// SPDX-License-Identifier: Apache-2.0
// Measures how soft the edges of a picture are, and widens the nearer surfaces of its repaired map.
// A lens and a sharpening filter mix several pixels beside an outline. These pixels belong to the
// nearer surface: left to the farther one, they would stay sharp inside its blur.
#ifndef STARFOCUS_LIB_DEPTH_SOFT_EDGES_H_
#define STARFOCUS_LIB_DEPTH_SOFT_EDGES_H_

#include <cstdint>

#include "lib/depth/colour_map.h"

namespace starfocus {

// Pixels that the nearer surface is widened by at most.
inline constexpr int32_t kMostSoft = 3;

// Smallest step of disparity of an edge.
inline constexpr int32_t kSoftStep = 5 << kDisparityBits;

// Edges of a tile at which a profile could be taken, and those at which the pixel one, two or three
// pixels beyond the first one of the farther surface still shows some of the nearer one.
struct SoftCount {
  int32_t edges;
  int32_t mixed[kMostSoft];
};

// Adds the edges of a rectangle to *count.
void CountSoft(const ColourMap& map, const Rect& rect, SoftCount* count);

// Returns by how many pixels nearer surfaces are to be widened: one more than those that show some
// of the nearer surface at half of the edges or more, or 0.
int32_t SoftnessOf(const SoftCount* counts, int32_t tiles);

// Returns the disparity of the nearest surface within `softness` pixels of (x, y), along its row or
// column, that is much nearer than the pixel and some of which the pixel shows; else its own.
int16_t WidenedAt(const ColourMap& map, int32_t softness, int32_t x, int32_t y);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_SOFT_EDGES_H_
