// SPDX-License-Identifier: Apache-2.0
// SIMD kernels that match captured views with the centre view. DeinterleaveRow and InterpolateRow
// prepare the planes of the views. CostLabels computes the cost of each label at each pixel of a
// row. Its building blocks process one label of a row of pixels. Their vector code reads and writes
// whole groups of kSliceLanes samples.
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

// Returns 256 * kCostScale / views, rounded up. The product of this factor and the sum of the
// differences of `views` views is 256 times the cost. The product is less than 2^16.
constexpr uint32_t MeanFactor(size_t views) {
  return static_cast<uint32_t>((256 * kCostScale + views - 1) / views);
}

inline constexpr size_t kMostMatched = 16;  // largest number of side views

// Offsets in samples by which a label moves a pixel in a side view.
struct ViewMove {
  // Offset from the pixel's red sample in the centre view to the moved pixel's red sample in the
  // side view.
  int32_t at;
  // Offset in LabelRow::hidden from the pixel in the plane of the first view to the moved pixel in
  // the plane of the side view.
  int32_t hidden;
};

// A row of pixels, and the rules of the comparison.
struct LabelRow {
  const uint8_t* pixels;  // Red sample of the first pixel in the centre view.
  size_t plane;           // Distance in samples between the planes R, G and B, in all views.
  const ViewMove* moves;  // moves[l * views + k]: offsets of label l in side view k.
  // Planes with the number of hidden labels, or kViewEnds, of each pixel in each view; points to
  // the first pixel of the row in the plane of the first view. Null if all views see all pixels.
  const uint8_t* hidden;
  size_t labels;  // [1, 254].
  size_t views;   // Number of side views, [1, kMostMatched].
  // The sides from which SeenCost computes the cost, for views at any positions. If there are none,
  // views = arms * rings, and the members below define the cost.
  const uint16_t* sides;
  size_t side_count;
  size_t arms, rings;  // The side views lie on `arms` rays and `rings` rings around the centre.
  bool one_side;       // True to use the views on the best side of a pixel, false to use all views.
  bool ends;           // True if some values of `hidden` may be kViewEnds.
  // True to replace a view only at pixels outside the view, and to limit the differences of views
  // in which a surface hides the pixel.
  bool limits;
};

namespace reference {

inline int InterpolateByte(int a, int b, int part) {
  return (a * (128 - part) + b * part + 64) >> 7;
}

// Splits pixels into rows of R, G and B: plane[n] = rgb[3 n], plane[n + stride] = rgb[3 n + 1],
// plane[n + 2 stride] = rgb[3 n + 2], for n < count. No other elements of `plane` are written.
STARFOCUS_REFERENCE void DeinterleaveRow(const uint8_t* rgb, size_t count, size_t stride,
                                         uint8_t* plane) {
  for (size_t n = 0; n < count; ++n) {
    for (size_t c = 0; c < 3; ++c) plane[n + c * stride] = rgb[3 * n + c];
  }
}

// Sets out[n] to the interpolated sample `across` / 128 of a pixel to the right of sample n, and
// `down` / 128 of the way from `row` to `next`. `across` and `down` are in [0, 128). Interpolation
// is bilinear, first down and then across, and rounds half up after each direction. The rows have
// count + 1 samples. `out` is written in whole groups of kSliceLanes.
STARFOCUS_REFERENCE void InterpolateRow(const uint8_t* row, const uint8_t* next, int32_t across,
                                        int32_t down, size_t count, uint8_t* out) {
  for (size_t n = 0; n < count; ++n) {
    const int left = InterpolateByte(row[n], next[n], down),
              right = InterpolateByte(row[n + 1], next[n + 1], down);
    out[n] = static_cast<uint8_t>(InterpolateByte(left, right, across));
  }
}

// Sets difference[n] to the difference between pixel n of the centre view and pixel n of a side
// view, clamped to kMostDifference. In both views, the planes R, G and B are `plane` samples apart.
STARFOCUS_REFERENCE void MatchView(const uint8_t* centre, const uint8_t* view, size_t plane,
                                   size_t count, uint8_t* difference) {
  for (size_t n = 0; n < count; ++n) {
    const int sum = ColourDistance(centre + n, view + n, plane);
    difference[n] = static_cast<uint8_t>(sum < kMostDifference ? sum : kMostDifference);
  }
}

// Replaces a view that does not see a pixel with the opposite view. View a sees pixel n if
// hidden_a[n] <= label, and the opposite view b sees pixel n if hidden_b[n] <= label. If only one
// of views a and b sees pixel n, the difference of the other view is set to the difference of the
// view that sees the pixel. If neither view sees pixel n, both differences are set to
// kUnknownDifference.
STARFOCUS_REFERENCE void StandIn(const uint8_t* hidden_a, const uint8_t* hidden_b, uint8_t label,
                                 size_t count, uint8_t* a, uint8_t* b) {
  for (size_t n = 0; n < count; ++n) {
    const bool by_a = hidden_a[n] <= label, by_b = hidden_b[n] <= label;
    const uint8_t of_a = a[n], of_b = b[n];
    a[n] = by_a ? of_a : by_b ? of_b : uint8_t{kUnknownDifference};
    b[n] = by_b ? of_b : by_a ? of_a : uint8_t{kUnknownDifference};
  }
}

// Limits the differences of views that do not see a pixel. View k does not see pixel n if
// hidden[k][n] > label. The limit is kHiddenDifference if any view sees pixel n, and
// kUnseenDifference if no view sees pixel n.
STARFOCUS_REFERENCE void LimitHidden(const uint8_t* const* hidden, uint8_t label, size_t views,
                                     size_t count, uint8_t* const* differences) {
  for (size_t n = 0; n < count; ++n) {
    bool seen = false;
    for (size_t k = 0; k < views; ++k) seen = seen || hidden[k][n] <= label;
    const uint8_t most = seen ? kHiddenDifference : kUnseenDifference;
    for (size_t k = 0; k < views; ++k) {
      uint8_t& difference = differences[k][n];
      if (hidden[k][n] > label && difference > most) difference = most;
    }
  }
}

// Computes the cost from the views on the side with the smallest differences. If a surface hides a
// pixel from the views on one side, the views on the opposite side see the pixel.
//
// `differences` contains the differences of rings * arms views: for each ring, the arms in the
// order of their angles. There are 4 or 8 arms, and 1 or 2 rings. A side consists of two adjacent
// arms out of 4, or of three adjacent arms out of 8. The cost is the mean over the views of the
// side times kCostScale, rounded down. The computation uses 171 / 256 in place of 2 / 3.
STARFOCUS_REFERENCE void LeastSide(const uint8_t* const* differences, size_t arms, size_t rings,
                                   size_t count, uint8_t* cost) {
  for (size_t n = 0; n < count; ++n) {
    int arm[8] = {};
    for (size_t k = 0; k < arms * rings; ++k) arm[k % arms] += differences[k][n];
    int least = INT32_MAX;
    for (size_t k = 0; k < arms; ++k) {
      int side = arm[k] + arm[(k + 1) % arms];
      if (arms == 8) side += arm[(k + 2) % arms];
      least = side < least ? side : least;
    }
    // Factor that converts the sum over the two or three views of a side to the equivalent sum over
    // six views.
    const int scale = arms == 4 ? 3 : 2;
    cost[n] = static_cast<uint8_t>((least * (rings == 1 ? scale : 1) * 171) >> 8);
  }
}

// Sets cost[n] to the mean difference over all views times kCostScale, rounded down. `views` is 4,
// 8 or 16.
STARFOCUS_REFERENCE void MeanCost(const uint8_t* const* differences, size_t views, size_t count,
                                  uint8_t* cost) {
  for (size_t n = 0; n < count; ++n) {
    size_t sum = 0;
    for (size_t k = 0; k < views; ++k) sum += differences[k][n];
    cost[n] = static_cast<uint8_t>(sum * kCostScale / views);
  }
}

// Computes the cost from the side with the smallest mean difference. Bit k of sides[s] is 1 if side
// view k belongs to side s; each side has a view. The mean of a side includes only the views of the
// side that see the pixel: view k sees pixel n if hidden[k][n] <= label. If
// `hidden` is null, all views see all pixels. The cost is the mean times kCostScale, as the sum
// times MeanFactor. If no view of any side sees a pixel, the difference is kUnknownDifference.
STARFOCUS_REFERENCE void SeenCost(const uint8_t* const* differences, const uint8_t* const* hidden,
                                  uint8_t label, const uint16_t* sides, size_t side_count,
                                  size_t count, uint8_t* cost) {
  for (size_t n = 0; n < count; ++n) {
    uint32_t least = UINT32_MAX;
    for (size_t side = 0; side < side_count; ++side) {
      uint32_t sum = 0, seen = 0;
      for (size_t k = 0; sides[side] >> k != 0; ++k) {
        if ((sides[side] >> k & 1) == 0) continue;
        if (hidden != nullptr && hidden[k][n] > label) continue;
        sum += differences[k][n];
        ++seen;
      }
      if (seen == 0) continue;
      const uint32_t mean = sum * MeanFactor(seen) >> 8;
      least = mean < least ? mean : least;
    }
    constexpr uint32_t kMost = kMostDifference * kCostScale;
    if (least == UINT32_MAX) least = kUnknownDifference * kCostScale;
    cost[n] = static_cast<uint8_t>(least < kMost ? least : kMost);
  }
}

// Returns the cost of label l at pixel n.
inline uint8_t CostLabel(const LabelRow& row, size_t n, size_t l) {
  const size_t views = row.views;
  const ViewMove* moves = row.moves + l * views;
  const auto label = static_cast<uint8_t>(l);
  uint8_t of_view[kMostMatched];
  uint8_t* differences[kMostMatched];
  const uint8_t* hidden[kMostMatched];
  for (size_t k = 0; k < views; ++k) {
    differences[k] = of_view + k;
    const uint8_t* pixel = row.pixels + n;
    MatchView(pixel, pixel + moves[k].at, row.plane, 1, differences[k]);
    if (row.hidden != nullptr) hidden[k] = row.hidden + n + moves[k].hidden;
  }
  uint8_t cost = 0;
  if (row.side_count > 0) {
    SeenCost(differences, row.hidden == nullptr ? nullptr : hidden, label, row.sides,
             row.side_count, 1, &cost);
    return cost;
  }
  if (row.hidden != nullptr) {
    const uint8_t last = row.limits ? uint8_t{kViewEnds - 1} : label;
    for (size_t k = 0; k < views; ++k) {
      const size_t half = row.arms / 2;
      if (k % row.arms >= half || (row.limits && !row.ends)) continue;
      StandIn(hidden[k], hidden[k + half], last, 1, differences[k], differences[k + half]);
    }
    if (row.limits) LimitHidden(hidden, label, views, 1, differences);
  }
  if (row.one_side) {
    LeastSide(differences, row.arms, row.rings, 1, &cost);
  } else {
    MeanCost(differences, views, 1, &cost);
  }
  return cost;
}

// Sets cost[n * places + l] to the cost of label l at pixel n < count. With sides, SeenCost
// computes the cost from the differences of the views. Without sides, StandIn and LimitHidden first
// change the differences of hidden views. LeastSide or MeanCost then computes the cost from the
// differences. `places` is a multiple of kSliceLanes and at least SliceSamples(labels). For each
// pixel, SliceSamples(labels) costs are written.
STARFOCUS_REFERENCE void CostLabels(const LabelRow& row, size_t count, size_t places,
                                    uint8_t* cost) {
  for (size_t n = 0; n < count; ++n) {
    for (size_t l = 0; l < row.labels; ++l) cost[n * places + l] = CostLabel(row, n, l);
  }
}

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_MATCH_H_
