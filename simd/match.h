// SPDX-License-Identifier: Apache-2.0
// What the kernel that compares captured views with the centre view (label_costs.h) is made of:
// one disparity of a row of pixels each. The vector code reads and writes whole groups of
// kSliceLanes samples.
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
// Labels that something nearer hides at a place of a view are the first ones, and told by their
// number; this is where the view ends.
inline constexpr uint8_t kViewEnds = 255;
// The costs of a disparity are differences of views times this, [0, 240].
inline constexpr int kCostScale = 4;

namespace reference {

// difference[n] becomes that of pixel n of the centre and of a view, kMostDifference at most; of
// both, G and B lie `plane` samples behind R and G.
void MatchView(const uint8_t* centre, const uint8_t* view, size_t plane, size_t count,
               uint8_t* difference);

// A view that does not see a pixel is stood in for by the one opposite. The first view sees
// pixel n when hidden_a[n] <= label, the other one when hidden_b[n] <= label; the difference of
// the one that doesn't becomes that of the one that does, and both kUnknownDifference when neither
// does.
void StandIn(const uint8_t* hidden_a, const uint8_t* hidden_b, uint8_t label, size_t count,
             uint8_t* a, uint8_t* b);

// Views that do not see pixel n, hidden[k][n] > label, tell little of it: their differences become
// kHiddenDifference at most, or kUnseenDifference where none of the views sees it.
void LimitHidden(const uint8_t* const* hidden, uint8_t label, size_t views, size_t count,
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

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_MATCH_H_
