// SPDX-License-Identifier: Apache-2.0
// Kernels of semi-global matching (Hirschmueller, "Stereo Processing by Semiglobal Matching and
// Mutual Information", 2008). Each pixel has costs of `labels` disparities, in
// PathLabels(labels) places.
#ifndef STARFOCUS_SIMD_PATHS_H_
#define STARFOCUS_SIMD_PATHS_H_

#include <cstddef>
#include <cstdint>

#include "simd/padding.h"

namespace starfocus::simd {

// Places that a pixel's labels take: one more at least, which is none.
constexpr size_t PathLabels(size_t labels) { return SliceSamples(labels + 1); }

// Neighbouring disparities of one surface cost this each.
inline constexpr int16_t kSlopeCost = 24;
// The cost of a place that is no label.
inline constexpr int16_t kNoLabel = INT16_MAX;
// Fractional bits of a chosen label.
inline constexpr int kChoiceBits = 6;

// A row of pixels that paths go through. Pixel k lies k * step pixels (of PathLabels places, or of
// one number) behind the first one; step is 1 or -1.
struct PathRow {
  const uint8_t* cost;          // [0, 240]; of places that are no label anything
  const int16_t* before;        // the paths of the pixels before, as this kernel writes them; one
                                // number before them can be read. It may be the path itself, one
                                // pixel earlier. Null: paths begin here
  const int16_t* before_least;  // the least of each of those
  const int16_t* jump;          // the most that any other disparity costs, [kSlopeCost, 1000]
  int16_t* path;                // written
  int16_t* least;               // written: the least of each pixel's path
  int16_t* sum;                 // the path is added, [0, 32767] then; of no label anything
};

namespace reference {

// path[l] = cost[l] + min(p[l], p[l - 1] + kSlopeCost, p[l + 1] + kSlopeCost, jump), where p is
// `before` less its least, and kNoLabel where there is no label; the cost alone where paths begin.
void AddPaths(const PathRow& row, size_t labels, ptrdiff_t step, size_t count);

// choice[n] is the label of the least sum, the first of equal ones, moved by up to half a label
// towards the neighbour of the lesser sum: where two equal slopes through the three meet. It has
// kChoiceBits fractional bits, truncated towards the label. margin[n] is an eighth of what the best
// of the labels 2 or more away has more, 255 at most, and 255 where there is no other.
void ChooseLabels(const int16_t* sum, size_t labels, size_t count, int16_t* choice,
                  uint8_t* margin);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_PATHS_H_
