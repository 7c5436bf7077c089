// SPDX-License-Identifier: Apache-2.0
// Kernels that composite slices, front to back, into the views of a strip: a column of kSliceLanes
// pixels whose rows follow each other in memory.
#ifndef STARFOCUS_SIMD_STRIPS_H_
#define STARFOCUS_SIMD_STRIPS_H_

#include <cstddef>
#include <cstdint>

#include "simd/padding.h"
#include "simd/slices.h"

namespace starfocus::simd {

// Rows of a slice, each of which holds its four planes side by side, `plane` samples apart.
struct SlicePlanes {
  const int16_t* samples;
  size_t plane;
};

// What a view sees of up to four samples p of a slice that follow each other:
//   p[1] + first (p[1] - p[0]) + third (p[1] - p[2]) + fourth (p[2] - p[3]),
// where `first` is `inside` if p[0] and p[1] are covered alike, else `edge`. All lie in [-1, 0]
// with 15 fractional bits: 16 bits hold -1, but not 1. If `third` is not 0, `inside` and `edge` are
// the same; if it is 0, `fourth` is 0 too.
struct SliceFraction {
  int16_t inside, edge, third, fourth;
};

// Rows of a strip that Composite may read beyond the last one it adds.
inline constexpr size_t kRowsAhead = 6;

// The mark of a row of a strip: how many rows, from it on, show nothing of a slice, at most
// kNothingNear; or kCoveredNear where all pixels of it and of the kRowsAhead rows after it are
// covered all over.
inline constexpr int8_t kNothingNear = kRowsAhead + 1;
inline constexpr int8_t kCoveredNear = -1;

// A slice in a strip. Its four planes lie `plane` samples apart; a row is kSliceLanes samples.
struct StripSlice {
  const int16_t* samples;  // the row that an unmoved view shows first
  const int8_t* near;      // the marks of rows from there on
  size_t plane;
};

// Where a view shows a slice: moved by whole rows, and by what it sees of a row and the next ones.
struct SliceOffset {
  int16_t whole;
  int16_t taps;  // the rows that are seen: 2, 3 or 4, by what of the fraction is not 0
  SliceFraction fraction;

  static constexpr SliceOffset Of(int32_t whole, const SliceFraction& fraction) {
    const int taps = 2 + (fraction.third != 0 ? 1 : 0) + (fraction.fourth != 0 ? 1 : 0);
    return {static_cast<int16_t>(whole), static_cast<int16_t>(taps), fraction};
  }
};

// Slices that a view can show.
inline constexpr size_t kMaxSeen = 32;

// The views of a strip, which see the slices moved along its column.
struct SliceViews {
  const int16_t* weights;      // of the views: each in [0, 2^14), 58000 at most together
  const SliceOffset* offsets;  // offsets[view * count + k]: where a view shows slice k
  size_t views;
  const StripSlice* slices;
  size_t count;          // of the slices
  const uint8_t* shown;  // the slices that are seen, the nearest first
  size_t shown_count;    // kMaxSeen at most
  size_t row;            // the first row that is composited
  int extra_bits;        // of the weights: their sums are divided by 2^extra_bits; [0, 4]
};

namespace reference {

// Moves rows of a slice along the row by a fraction of a sample, into a strip whose planes lie
// `plane` samples apart: out[n] is what is seen of in[n] and the samples after it, and each product
// is rounded halves up. near[row] is the mark of a row, and kRowsAhead marks lie before the first:
// all of them must be kNothingNear or more before. Those of rows that show something, or lie up to
// kRowsAhead before such a row, become what they are; the others stay.
void ShiftSlice(const SlicePlanes& in, const SliceFraction& fraction, size_t rows, size_t plane,
                int16_t* out, int8_t* near);

// Adds the views of a strip to sums[(4 row + c) kSliceLanes + n], where c is the plane. A slice
// takes as much of the view's light as it covers, and gives as much of its colours. Of the last
// light it gives the share that is left (up to a ninth of the weight too much), as if slices beside
// each other covered different parts of a pixel. What is seen of rows is defined as for ShiftSlice.
// Products (15 bits) are rounded halves up, and so is what all views give together, divided by
// 2^extra_bits. No sum exceeds 2^32 - 1.
void Composite(const SliceViews& views, size_t rows, uint32_t* sums);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_STRIPS_H_
