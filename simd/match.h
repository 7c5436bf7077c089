// SPDX-License-Identifier: Apache-2.0
// Kernels that compare captured views with the centre view, for one disparity and a row of pixels
// at a time. Rows of `count` samples are read and written in whole groups of kSliceLanes.
#ifndef STARFOCUS_SIMD_MATCH_H_
#define STARFOCUS_SIMD_MATCH_H_

#include <cstddef>
#include <cstdint>

#include "simd/padding.h"

namespace starfocus::simd {

// A difference of two pixels is the sum over R, G and B, in gray levels. Larger ones are all alike:
// whether the pixel is another one by much or by very much tells nothing.
inline constexpr int kMostDifference = 60;
// What stands for a difference that no view shows: rather a poor match.
inline constexpr int kUnknownDifference = 48;
// The most that a view counts which is taken not to see the pixel, and when no view does.
inline constexpr int kHiddenDifference = 18, kUnseenDifference = 27;
// The costs of a disparity are differences of views times this, [0, 240].
inline constexpr int kCostScale = 4;

// Where a row of pixels is seen in another view: at the pixels of `view`, `across` to the right and
// `down` to the next row, both [0, 128) in 128ths of a pixel.
struct MatchRow {
  const uint8_t* view[3];    // R, G and B; the next row lies view_stride behind
  size_t view_stride;        // bytes
  const uint8_t* centre[3];  // R, G and B
  int32_t across, down;
};

namespace reference {

// difference[n] becomes that of pixel n of the centre and the view interpolated there, bilinearly,
// with one rounding (halves up) after each direction; kMostDifference at most. Of a view pixel
// `count` is read, too, and the next row.
void MatchView(const MatchRow& row, size_t count, uint8_t* difference);

// A view that does not see a pixel is stood in for by the one opposite. The first view sees
// pixel n when highest_a[n] <= limit, the other one when highest_b[n] <= limit; the difference of
// the one that doesn't becomes that of the one that does, and both kUnknownDifference when neither
// does.
void StandIn(const int16_t* highest_a, const int16_t* highest_b, int16_t limit, size_t count,
             uint8_t* a, uint8_t* b);

// Views that do not see pixel n, highest[k][n] > limit, tell little of it: their differences become
// kHiddenDifference at most, or kUnseenDifference where none of the views sees it.
void LimitHidden(const int16_t* const* highest, int16_t limit, size_t views, size_t count,
                 uint8_t* const* differences);

// The cost by the views on one side of the pixel, whichever side fits best: what hides a pixel has
// an edge, on the other side of which views see it. `differences` are those of rings * arms views:
// of each ring, arms in the order of their angles; arms is 4 or 8, rings 1 or 2. Sides are two
// neighbouring arms of 4, and three of 8. cost[n] is the mean over the views of the side times
// kCostScale (rounded down, with 171 / 256 for 2 / 3).
void LeastSide(const uint8_t* const* differences, size_t arms, size_t rings, size_t count,
               uint8_t* cost);

// cost[n] is the mean over all views times kCostScale, rounded down; views is 4, 8 or 16.
void MeanCost(const uint8_t* const* differences, size_t views, size_t count, uint8_t* cost);

// Turns rows of one disparity each into pixels of kSliceLanes disparities each:
// pixels[n * pixel_stride + k] = rows[k * row_stride + n], k < kSliceLanes, n < count. Nothing else
// is written.
void GatherLabels(const uint8_t* rows, size_t row_stride, size_t count, uint8_t* pixels,
                  size_t pixel_stride);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_MATCH_H_
