// SPDX-License-Identifier: Apache-2.0
// Measures how soft the edges of a picture are, and widens the nearer surfaces of the picture's
// repaired map. Lenses and sharpening filters mix several pixels next to an outline. The mixed
// pixels must belong to the nearer surface. As part of the farther surface, the mixed pixels would
// stay sharp inside the blur of the nearer surface.
#ifndef STARFOCUS_LIB_DEPTH_SOFT_EDGES_H_
#define STARFOCUS_LIB_DEPTH_SOFT_EDGES_H_

#include <cstdint>

#include "lib/depth/colour_map.h"

namespace starfocus {

// Largest number of pixels by which the nearer surface is widened.
inline constexpr int32_t kMostSoft = 3;

// Neighbouring pixels whose disparities differ by more than kSoftStep (kDisparityBits) form an
// edge.
inline constexpr int32_t kSoftStep = 5 << kDisparityBits;

// Counts of the edges of a tile. `edges` is the number of edges at which a colour profile was
// measured. Let pixel k + 1 of a profile be the pixel that lies k + 1 pixels beyond the first pixel
// of the farther surface. mixed[k] is the number of profiles in which pixel k + 1 shows a part of
// the nearer surface.
struct SoftCount {
  int32_t edges;
  int32_t mixed[kMostSoft];
};

// Adds the counts of the edges in a rectangle to *count.
void CountSoft(const ColourMap& map, const Rect& rect, SoftCount* count);

// Returns the number of pixels by which nearer surfaces should be widened, at most kMostSoft. The
// result is one more than the number of consecutive pixels that show a part of the nearer surface
// in at least half of the profiles. If no pixel shows the nearer surface in at least half of the
// profiles, the result is 0.
int32_t SoftnessOf(const SoftCount* counts, int32_t tiles);

// Returns the disparity of the nearest surface that is much nearer than pixel (x, y) and that the
// pixel shows in part. The surface is searched along the row and the column of the pixel, within
// `softness` pixels. If the pixel shows no part of a nearer surface, returns the pixel's own
// disparity.
int16_t WidenedAt(const ColourMap& map, int32_t softness, int32_t x, int32_t y);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_SOFT_EDGES_H_
