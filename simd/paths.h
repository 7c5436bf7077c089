// SPDX-License-Identifier: Apache-2.0
// SIMD kernels of semi-global matching (Hirschmueller, "Stereo Processing by Semiglobal Matching
// and Mutual Information", 2008). Each pixel has an array of PathLabels(labels) elements, which
// contains the costs of `labels` labels.
//
// A given disparity map adds a prior to the cost of each label of a pixel. The prior of a label is
// the distance to the nearest trusted pixel with the label's disparity. Distances are propagated
// from pixel to pixel, for all labels at once.
#ifndef STARFOCUS_SIMD_PATHS_H_
#define STARFOCUS_SIMD_PATHS_H_

#include <cstddef>
#include <cstdint>

#include "simd/samples.h"

namespace starfocus::simd {

// Returns the number of elements in a pixel's array of costs or paths. The array ends with at least
// one element that is not a label.
constexpr size_t PathLabels(size_t labels) { return SliceSamples(labels + 1); }

// Cost of a step to an adjacent label within a surface.
inline constexpr int16_t kSlopeCost = 24;
// Value of elements that are not labels.
inline constexpr int16_t kNoLabel = INT16_MAX;
// Fractional bits of a chosen label.
inline constexpr int kChoiceBits = 6;

// Parameters of the cost of a jump to any other label. Between pixels of equal colour, a jump costs
// kLargestJump. The cost of a jump decreases with the inverse of the colour difference, down to
// kLeastJump.
inline constexpr int kLargestJump = 400, kLeastJump = 128, kSimilarColours = 16;

// A row of pixels. AddPaths extends the path at pixel k of `before` to pixel k. The pointers point
// to pixel 0; pixel k is k * step pixels after pixel 0, and step is 1 or -1. A pixel has PathLabels
// elements in `cost`, `before`, `path` and `sum`, and one element in all other arrays. Elements of
// paths that are not labels must be kNoLabel, even before AddPaths writes the paths. The element
// before the first element of a path must be kNoLabel as well.
struct PathRow {
  const uint8_t* cost;  // Costs, [0, 255]; elements that are not labels are arbitrary.
  // Paths of the previous pixels, [0, 1300]. `before` may point to the previous pixel of `path`.
  const int16_t* before;
  const int16_t* before_least;  // Smallest element of each path in `before`.
  const int16_t* jump;          // Cost of a jump to any other label, [kSlopeCost, 1000].
  int16_t* path;   // Output: costs of the paths that end at each pixel, for all labels.
  int16_t* least;  // Output: smallest element of each path.
  int16_t* sum;    // In and out: sums of paths, [0, 32766]; kNoLabel if not a label.
  bool adds;       // True to add the paths to the sums, false to set the sums to the paths.
};

// Costs of steps between pixels, and the largest value of a prior. A step to an adjacent pixel
// costs kBesideCost, and a step to a diagonally adjacent pixel kDiagonalCost. If a label differs
// from the labels of all trusted pixels within 8 pixels, the prior of the label is kMostPrior.
inline constexpr uint8_t kBesideCost = 3, kDiagonalCost = 4, kMostPrior = 24;

namespace reference {

inline int Least(int a, int b) { return a < b ? a : b; }

// Returns the term that the path of the previous pixel adds to the cost of label l.
inline int Onward(const int16_t* before, int least, int jump, size_t l, size_t labels) {
  int onward = Least(before[l] - least, jump);
  if (l > 0) onward = Least(onward, before[l - 1] - least + kSlopeCost);
  if (l + 1 < labels) onward = Least(onward, before[l + 1] - least + kSlopeCost);
  return onward;
}

// Returns the position of the minimum relative to the middle label, from three sums; kChoiceBits
// fractional bits.
inline int Refine(int left, int middle, int right) {
  const int from_left = left - middle, from_right = right - middle;
  const int most = from_left > from_right ? from_left : from_right;
  return most == 0 ? 0 : (from_left - from_right) * (1 << (kChoiceBits - 1)) / most;
}

// Computes path[l] = cost[l] + min(p[l], p[l - 1] + kSlopeCost, p[l + 1] + kSlopeCost, jump), where
// p is `before` minus its smallest value. To begin a path at a pixel, set all elements of `before`
// to one value: path[l] is then equal to cost[l].
STARFOCUS_REFERENCE void AddPaths(const PathRow& row, size_t labels, ptrdiff_t step, size_t count) {
  const size_t places = PathLabels(labels);
  for (size_t k = 0; k < count; ++k) {
    const ptrdiff_t pixel = static_cast<ptrdiff_t>(k) * step;
    const ptrdiff_t at = pixel * static_cast<ptrdiff_t>(places);
    int least = kNoLabel;
    for (size_t l = 0; l < labels; ++l) {
      const int path = row.cost[at + static_cast<ptrdiff_t>(l)] +
                       Onward(row.before + at, row.before_least[pixel], row.jump[pixel], l, labels);
      row.path[at + static_cast<ptrdiff_t>(l)] = static_cast<int16_t>(path);
      int16_t& sum = row.sum[at + static_cast<ptrdiff_t>(l)];
      sum = static_cast<int16_t>(row.adds ? sum + path : path);
      least = Least(least, path);
    }
    for (size_t l = labels; l < places; ++l) {
      row.path[at + static_cast<ptrdiff_t>(l)] = row.sum[at + static_cast<ptrdiff_t>(l)] = kNoLabel;
    }
    row.least[pixel] = static_cast<int16_t>(least);
  }
}

// Sets jump[n] to the cost of a jump between pixel n of two rows. The planes R, G and B of both
// rows are `plane` samples apart. The cost is kLargestJump * kSimilarColours / (kSimilarColours +
// difference), rounded down, but at least kLeastJump. The difference is summed over R, G and B.
STARFOCUS_REFERENCE void FindJumps(const uint8_t* pixels, const uint8_t* before, size_t plane,
                                   size_t count, int16_t* jump) {
  for (size_t n = 0; n < count; ++n) {
    const int apart = ColourDistance(pixels + n, before + n, plane);
    const int cost = kLargestJump * kSimilarColours / (kSimilarColours + apart);
    jump[n] = static_cast<int16_t>(cost > kLeastJump ? cost : kLeastJump);
  }
}

// Sets choice[n] to the label with the smallest sum, refined to kChoiceBits fractional bits. If
// several labels have the smallest sum, the first of these labels is chosen. The refinement moves
// the choice by up to half a label towards the neighbour with the smaller sum. The refined choice
// is the point where two lines with opposite slopes through the three sums meet, truncated towards
// the label.
//
// margin[n] is an eighth of the difference between the chosen sum and the smallest sum of labels 2
// or more away. The margin is limited to 255, and is 255 if no label is 2 or more away. `margin`
// may be null. `sum` has the format of PathRow::sum.
STARFOCUS_REFERENCE void ChooseLabels(const int16_t* sum, size_t labels, size_t count,
                                      int16_t* choice, uint8_t* margin) {
  for (size_t n = 0; n < count; ++n, sum += PathLabels(labels)) {
    size_t best = 0;
    for (size_t l = 1; l < labels; ++l) best = sum[l] < sum[best] ? l : best;
    int other = kNoLabel;
    for (size_t l = 0; l < labels; ++l) {
      if (l + 2 <= best || l >= best + 2) other = Least(other, sum[l]);
    }
    int refined = 0;
    if (best > 0 && best + 1 < labels) refined = Refine(sum[best - 1], sum[best], sum[best + 1]);
    choice[n] = static_cast<int16_t>((static_cast<int>(best) << kChoiceBits) + refined);
    if (margin == nullptr) continue;
    margin[n] = static_cast<uint8_t>(Least((other - sum[best]) / 8, 255));
  }
}

inline void Lessen(const uint8_t* from, int way, size_t places, uint8_t* prior) {
  for (size_t l = 0; l < places; ++l) {
    if (from[l] + way < prior[l]) prior[l] = static_cast<uint8_t>(from[l] + way);
  }
}

// Reduces the priors of each pixel, one pixel after the other. Priors propagate to a pixel from the
// previous pixel of the row and from the three adjacent pixels of the previous row. A pixel's prior
// is at most the prior of each adjacent source pixel, plus the cost of the step from the source
// pixel.
//
// Each of the `count` pixels has `places` elements, one per label; `places` is a multiple of
// kSliceLanes. Pixel k is k * step pixels after pixel 0; step is 1 or -1. Priors are in [0,
// kMostPrior]. `before` has the finished priors of the previous row, or is null if there is no
// previous row.
STARFOCUS_REFERENCE void PropagatePrior(uint8_t* prior, const uint8_t* before, size_t places,
                                        ptrdiff_t step, size_t count) {
  const ptrdiff_t next = step * static_cast<ptrdiff_t>(places);
  for (size_t k = 0; k < count; ++k) {
    uint8_t* here = prior + static_cast<ptrdiff_t>(k) * next;
    if (k > 0) Lessen(here - next, kBesideCost, places, here);
    if (before == nullptr) continue;
    const uint8_t* above = before + static_cast<ptrdiff_t>(k) * next;
    Lessen(above, kBesideCost, places, here);
    if (k > 0) Lessen(above - next, kDiagonalCost, places, here);
    if (k + 1 < count) Lessen(above + next, kDiagonalCost, places, here);
  }
}

// Adds prior[n] to cost[n] for n < count. Sums are limited to 255. `count` is a multiple of
// kSliceLanes.
STARFOCUS_REFERENCE void AddPrior(const uint8_t* prior, size_t count, uint8_t* cost) {
  for (size_t n = 0; n < count; ++n) {
    const int sum = cost[n] + prior[n];
    cost[n] = static_cast<uint8_t>(sum < 255 ? sum : 255);
  }
}

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_PATHS_H_
