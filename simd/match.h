// SPDX-License-Identifier: Apache-2.0
// Building blocks of the kernel that compares captured views with the centre view (label_costs.h).
// Each processes one disparity of a row of pixels. The vector code reads and writes whole groups of
// kSliceLanes samples.
#ifndef STARFOCUS_SIMD_MATCH_H_
#define STARFOCUS_SIMD_MATCH_H_

#include <cstddef>
#include <cstdint>

#include "simd/padding.h"

namespace starfocus::simd {

// Largest difference of two pixels: the sum over R, G and B, in gray levels. Larger differences are
// clamped, since they do not matter: the pixels do not match in any case.
inline constexpr int kMostDifference = 60;
// Difference that is assumed if no view shows the pixel: a poor match.
inline constexpr int kUnknownDifference = 48;
// Upper limits of the difference of a view that is known not to see the pixel: if some views see
// the pixel, and if none does.
inline constexpr int kHiddenDifference = 18, kUnseenDifference = 27;
// The hidden labels at a place of a view are the lowest ones; they are stored as their number. This
// value marks places outside the view.
inline constexpr uint8_t kViewEnds = 255;
// Costs of a disparity are differences of views times this, [0, 240].
inline constexpr int kCostScale = 4;

namespace reference {

// Sets difference[n] to the difference of pixel n of the centre view from that of a side view, at
// most kMostDifference. In both, the planes R, G and B are `plane` samples apart.
void MatchView(const uint8_t* centre, const uint8_t* view, size_t plane, size_t count,
               uint8_t* difference);

// Replaces a view that does not see a pixel by the opposite one. The first view sees pixel n if
// hidden_a[n] <= label, the opposite one if hidden_b[n] <= label. The difference of the view that
// does not see it is set to that of the other view. If neither sees it, both are set to
// kUnknownDifference.
void StandIn(const uint8_t* hidden_a, const uint8_t* hidden_b, uint8_t label, size_t count,
             uint8_t* a, uint8_t* b);

// Limits the differences of views that do not see pixel n, hidden[k][n] > label, to at most
// kHiddenDifference, or kUnseenDifference if no view sees it.
void LimitHidden(const uint8_t* const* hidden, uint8_t label, size_t views, size_t count,
                 uint8_t* const* differences);

// Computes the cost from the views on the side of the pixel that fits best. A surface that hides a
// pixel has an edge, and the views on the other side of the edge see the pixel.
//
// `differences` holds those of rings * arms views: for each ring, arms in the order of their
// angles. arms is 4 or 8, rings 1 or 2. A side consists of two adjacent arms of 4, or of three of
// 8. The cost is the mean over the views of the side times kCostScale. It is rounded down, with 171
// / 256 in place of 2 / 3.
void LeastSide(const uint8_t* const* differences, size_t arms, size_t rings, size_t count,
               uint8_t* cost);

// Sets cost[n] to the mean over all views times kCostScale, rounded down; views is 4, 8 or 16.
void MeanCost(const uint8_t* const* differences, size_t views, size_t count, uint8_t* cost);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_MATCH_H_
