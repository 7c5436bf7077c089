// SPDX-License-Identifier: Apache-2.0
// Building blocks of the kernel that compares captured views with the centre view (label_costs.h).
// Each function processes one label of a row of pixels. The vector code reads and writes whole
// groups of kSliceLanes samples.
#ifndef STARFOCUS_SIMD_MATCH_H_
#define STARFOCUS_SIMD_MATCH_H_

#include <cstddef>
#include <cstdint>

#include "simd/samples.h"

namespace starfocus::simd {

// Upper limit of the difference between two pixels, which is the sum over R, G and B in grey
// levels. Larger differences are clamped, because such pixels do not match in any case.
inline constexpr int kMostDifference = 60;
// Difference that is assumed if no view shows a pixel; the value corresponds to a poor match.
inline constexpr int kUnknownDifference = 48;
// Upper limits of the difference of a view that is known not to see the pixel. The limit is
// kHiddenDifference if another view sees the pixel, and kUnseenDifference if no view sees the
// pixel.
inline constexpr int kHiddenDifference = 18, kUnseenDifference = 27;
// Number of hidden labels that is stored for pixels outside a view. Inside a view, the hidden
// labels of a pixel are always the lowest labels, so it is enough to store their number.
inline constexpr uint8_t kViewEnds = 255;
// Factor between differences and costs. Costs are in [0, 240].
inline constexpr int kCostScale = 4;

// Sets of side views. Bit k of a mask is 1 if side view k belongs to the set. Each set has a view.
struct ViewSides {
  const uint16_t* masks;
  size_t count;
};

// Returns 256 * kCostScale / views, rounded up. The product of this factor and the sum of the
// differences of `views` views is 256 times the cost. The product is less than 2^16.
constexpr uint32_t MeanFactor(size_t views) {
  return static_cast<uint32_t>((256 * kCostScale + views - 1) / views);
}

namespace reference {

// Sets difference[n] to the difference between pixel n of the centre view and pixel n of a side
// view, clamped to kMostDifference. In both views, the planes R, G and B are `plane` samples apart.
void MatchView(const uint8_t* centre, const uint8_t* view, size_t plane, size_t count,
               uint8_t* difference);

// Replaces a view that does not see a pixel with the opposite view. View a sees pixel n if
// hidden_a[n] <= label, and the opposite view b sees pixel n if hidden_b[n] <= label. If only one
// of views a and b sees pixel n, the difference of the other view is set to the difference of the
// view that sees the pixel. If neither view sees pixel n, both differences are set to
// kUnknownDifference.
void StandIn(const uint8_t* hidden_a, const uint8_t* hidden_b, uint8_t label, size_t count,
             uint8_t* a, uint8_t* b);

// Limits the differences of views that do not see a pixel. View k does not see pixel n if
// hidden[k][n] > label. The limit is kHiddenDifference if any view sees pixel n, and
// kUnseenDifference if no view sees pixel n.
void LimitHidden(const uint8_t* const* hidden, uint8_t label, size_t views, size_t count,
                 uint8_t* const* differences);

// Computes the cost from the views on the side with the smallest differences. If a surface hides a
// pixel from the views on one side, the views on the opposite side see the pixel.
//
// `differences` contains the differences of rings * arms views: for each ring, the arms in the
// order of their angles. There are 4 or 8 arms, and 1 or 2 rings. A side consists of two adjacent
// arms out of 4, or of three adjacent arms out of 8. The cost is the mean over the views of the
// side times kCostScale, rounded down. The computation uses 171 / 256 in place of 2 / 3.
void LeastSide(const uint8_t* const* differences, size_t arms, size_t rings, size_t count,
               uint8_t* cost);

// Sets cost[n] to the mean difference over all views times kCostScale, rounded down. `views` is 4,
// 8 or 16.
void MeanCost(const uint8_t* const* differences, size_t views, size_t count, uint8_t* cost);

// Computes the cost from the side with the smallest mean difference. The mean of a side includes
// only the views of the side that see the pixel: view k sees pixel n if hidden[k][n] <= label. If
// `hidden` is null, all views see all pixels. The cost is the mean times kCostScale, as the sum
// times MeanFactor. If no view of any side sees a pixel, the difference is kUnknownDifference.
void SeenCost(const uint8_t* const* differences, const uint8_t* const* hidden, uint8_t label,
              const ViewSides& sides, size_t count, uint8_t* cost);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_MATCH_H_
