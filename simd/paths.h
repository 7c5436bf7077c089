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

// The cost of a jump to any other disparity: between pixels of one colour, and at least. By the
// difference of their colours it grows less like an inverse of it.
inline constexpr int kLargestJump = 400, kLeastJump = 128, kSimilarColours = 16;

// A row of pixels that paths go through. Pixel k lies k * step pixels (of PathLabels places, or of
// one number) behind the first one; step is 1 or -1. Places of paths that are no label have
// kNoLabel, before they are written as well, and so has the place before the first one.
struct PathRow {
  const uint8_t* cost;          // [0, 255]; of places that are no label anything
  const int16_t* before;        // the paths of the pixels before, [0, 1300]. It may be the path
                                // itself, one pixel earlier
  const int16_t* before_least;  // the least of each of those
  const int16_t* jump;          // the most that any other disparity costs, [kSlopeCost, 1000]
  int16_t* path;                // written
  int16_t* least;               // written: the least of each pixel's path
  int16_t* sum;                 // the path is added, [0, 32766] then; of no label kNoLabel
  bool adds;                    // false: the sum becomes the path
};

namespace reference {

// path[l] = cost[l] + min(p[l], p[l - 1] + kSlopeCost, p[l + 1] + kSlopeCost, jump), where p is
// `before` less its least. Where all of `before` is alike paths begin: they have the cost alone.
void AddPaths(const PathRow& row, size_t labels, ptrdiff_t step, size_t count);

// jump[n] becomes what a jump costs between pixel n of two rows, of which G and B lie `plane`
// samples behind R and G: kLargestJump * kSimilarColours / (kSimilarColours + difference), rounded
// down, kLeastJump at least. The difference is the sum over R, G and B.
void FindJumps(const uint8_t* pixels, const uint8_t* before, size_t plane, size_t count,
               int16_t* jump);

// choice[n] is the label of the least sum, the first of equal ones, moved by up to half a label
// towards the neighbour of the lesser sum: where two equal slopes through the three meet. It has
// kChoiceBits fractional bits, truncated towards the label. margin[n] is an eighth of what the best
// of the labels 2 or more away has more, 255 at most, and 255 where there is no other; null: none
// is asked for. sum is as paths are added to it.
void ChooseLabels(const int16_t* sum, size_t labels, size_t count, int16_t* choice,
                  uint8_t* margin);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_PATHS_H_
