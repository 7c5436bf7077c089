// SPDX-License-Identifier: Apache-2.0
// SIMD kernels of semi-global matching (Hirschmueller, "Stereo Processing by Semiglobal Matching
// and Mutual Information", 2008). Each pixel has the costs of `labels` disparities, in an array of
// PathLabels(labels) elements.
#ifndef STARFOCUS_SIMD_PATHS_H_
#define STARFOCUS_SIMD_PATHS_H_

#include <cstddef>
#include <cstdint>

#include "simd/padding.h"

namespace starfocus::simd {

// Returns the number of elements for the labels of a pixel. At least one of them is no label.
constexpr size_t PathLabels(size_t labels) { return SliceSamples(labels + 1); }

// Cost of each step to an adjacent label within a surface.
inline constexpr int16_t kSlopeCost = 24;
// Cost of an element that is no label.
inline constexpr int16_t kNoLabel = INT16_MAX;
// Fractional bits of a chosen label.
inline constexpr int kChoiceBits = 6;

// Cost of a jump to any other disparity: kLargestJump between pixels of one colour, and at least
// kLeastJump. It decreases with the inverse of the colour difference.
inline constexpr int kLargestJump = 400, kLeastJump = 128, kSimilarColours = 16;

// A row of pixels through which paths go. Pixel k is k * step pixels after the first one, each of
// them PathLabels elements or one number; step is 1 or -1. Elements of paths that are no label are
// kNoLabel, even before they are written. The element before the first one is kNoLabel, too.
struct PathRow {
  const uint8_t* cost;  // [0, 255]; anything in elements that are no label
  // paths of the previous pixels, [0, 1300]; may be `path` itself, one pixel earlier
  const int16_t* before;
  const int16_t* before_least;  // smallest cost of each of these paths
  const int16_t* jump;          // largest cost of any other disparity, [kSlopeCost, 1000]
  int16_t* path;                // output: paths
  int16_t* least;               // output: smallest cost of each pixel's path
  int16_t* sum;  // in and out: sum to which the path is added, [0, 32766]; kNoLabel for no label
  bool adds;     // false: the sum is set to the path
};

namespace reference {

// Computes path[l] = cost[l] + min(p[l], p[l - 1] + kSlopeCost, p[l + 1] + kSlopeCost, jump), where
// p is `before` minus its smallest value. A path begins where all values of `before` are equal; it
// then has the cost alone.
void AddPaths(const PathRow& row, size_t labels, ptrdiff_t step, size_t count);

// Sets jump[n] to the cost of a jump between pixel n of two rows, whose planes R, G and B are
// `plane` samples apart. It is kLargestJump * kSimilarColours / (kSimilarColours + difference),
// rounded down, at least kLeastJump. The difference is the sum over R, G and B.
void FindJumps(const uint8_t* pixels, const uint8_t* before, size_t plane, size_t count,
               int16_t* jump);

// Sets choice[n] to the label with the smallest sum (the first of equal ones), with kChoiceBits
// fractional bits. The choice is moved by up to half a label towards the neighbour with the smaller
// sum. It is the point where two lines of equal slope through the three sums meet, truncated
// towards the label.
//
// margin[n] is an eighth of the difference between the chosen sum and the smallest sum of labels 2
// or more away. It is at most 255, and 255 if there is no such label. margin may be null. `sum` has
// the format of PathRow::sum.
void ChooseLabels(const int16_t* sum, size_t labels, size_t count, int16_t* choice,
                  uint8_t* margin);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_PATHS_H_
