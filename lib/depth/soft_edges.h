// SPDX-License-Identifier: Apache-2.0
// Measures how soft the edges of a picture are, and widens the nearer surfaces of its repaired map.
// Lenses and sharpening filters mix several pixels next to an outline. These pixels belong to the
// nearer surface: as part of the farther one, they would stay sharp inside its blur.
#ifndef STARFOCUS_LIB_DEPTH_SOFT_EDGES_H_
#define STARFOCUS_LIB_DEPTH_SOFT_EDGES_H_

#include <cstdint>

#include "lib/depth/colour_map.h"

namespace starfocus {

// Largest number of pixels by which the nearer surface is widened.
inline constexpr int32_t kMostSoft = 3;

// Smallest step of disparity of an edge.
inline constexpr int32_t kSoftStep = 5 << kDisparityBits;

// Number of edges of a tile at which a profile was taken. The pixel k + 1 pixels beyond the first
// one of the farther surface still shows some of the nearer surface at mixed[k] of these edges.
struct SoftCount {
  int32_t edges;
  int32_t mixed[kMostSoft];
};

// Adds the edges of a rectangle to *count.
void CountSoft(const ColourMap& map, const Rect& rect, SoftCount* count);

// Returns the number of pixels by which nearer surfaces should be widened. It is one more than the
// number of pixels that show some of the nearer surface at half of the edges or more, or 0.
int32_t SoftnessOf(const SoftCount* counts, int32_t tiles);

// Returns the disparity of the nearest surface that pixel (x, y) shows in part and that is much
// nearer than the pixel. It is searched along the row and column within `softness` pixels. Returns
// the pixel's own disparity if there is no such surface.
int16_t WidenedAt(const ColourMap& map, int32_t softness, int32_t x, int32_t y);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_SOFT_EDGES_H_
