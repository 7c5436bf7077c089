// SPDX-License-Identifier: Apache-2.0
// SIMD kernels that composite slices, front to back, into the views of a strip: a column of
// kSliceLanes pixels whose rows are contiguous in memory.
#ifndef STARFOCUS_SIMD_STRIPS_H_
#define STARFOCUS_SIMD_STRIPS_H_

#include <cstddef>
#include <cstdint>

#include "simd/padding.h"
#include "simd/slices.h"

namespace starfocus::simd {

// Rows of a slice. The four planes of each row are `plane` samples apart.
struct SlicePlanes {
  const int16_t* samples;
  size_t plane;
};

// Interpolation of a view between up to four consecutive samples p of a slice:
//   p[1] + first (p[1] - p[0]) + third (p[1] - p[2]) + fourth (p[2] - p[3]),
// where `first` is `inside` if p[0] and p[1] have the same coverage, otherwise `edge`. All factors
// are in [-1, 0] with 15 fractional bits, since 16 bits hold -1 but not 1. If `third` is not 0,
// `inside` and `edge` are equal. If `third` is 0, `fourth` is 0, too.
struct SliceFraction {
  int16_t inside, edge, third, fourth;
};

// Number of rows of a strip that Composite may read beyond the last one it adds.
inline constexpr size_t kRowsAhead = 6;

// Mark of a row of a strip: the number of rows, starting with this one, that show nothing of a
// slice, at most kNothingNear. It is kCoveredNear if all pixels of the row and of the kRowsAhead
// rows after it are fully covered.
inline constexpr int8_t kNothingNear = kRowsAhead + 1;
inline constexpr int8_t kCoveredNear = -1;

// A slice in a strip. The four planes are `plane` samples apart; a row is kSliceLanes samples.
struct StripSlice {
  const int16_t* samples;  // first row that an unmoved view shows
  const int8_t* near;      // marks of the rows from there on
  size_t plane;
};

// Position of a slice in a view: a move by whole rows, and the interpolation between a row and the
// next ones.
struct SliceOffset {
  int16_t whole;
  int16_t taps;  // number of rows that are interpolated: 2, 3 or 4, depending on the fraction
  SliceFraction fraction;

  static constexpr SliceOffset Of(int32_t whole, const SliceFraction& fraction) {
    const int taps = 2 + (fraction.third != 0 ? 1 : 0) + (fraction.fourth != 0 ? 1 : 0);
    return {static_cast<int16_t>(whole), static_cast<int16_t>(taps), fraction};
  }
};

// Largest number of slices that a view can show.
inline constexpr size_t kMaxSeen = 32;

// Views of a strip, in which the slices are moved along the column.
struct SliceViews {
  const int16_t* weights;      // weight of each view, in [0, 2^14); at most 58000 in total
  const SliceOffset* offsets;  // offsets[view * count + k]: position of slice k in a view
  size_t views;
  const StripSlice* slices;
  size_t count;          // number of slices
  const uint8_t* shown;  // visible slices, the nearest first
  size_t shown_count;    // at most kMaxSeen
  size_t row;            // first row that is composited
  int extra_bits;  // sums are divided by 2^extra_bits, by which the weights are too large; [0, 4]
};

namespace reference {

// Moves rows of a slice along the row by a fraction of a sample, into a strip whose planes are
// `plane` samples apart. out[n] is interpolated between in[n] and the samples after it, and each
// product is rounded halves up.
//
// near[row] is the mark of a row; kRowsAhead marks precede the first. All of them must be at least
// kNothingNear before the call. Marks of rows that show something, or that lie up to kRowsAhead
// before such a row, are set. Other marks are not changed.
void ShiftSlice(const SlicePlanes& in, const SliceFraction& fraction, size_t rows, size_t plane,
                int16_t* out, int8_t* near);

// Adds the views of a strip to sums[(4 row + c) kSliceLanes + n], where c is the plane. A slice
// contributes its premultiplied colours and reduces the remaining light by its coverage.
//
// If the coverage exceeds the remaining light, the slice contributes in proportion to that light,
// up to a ninth of the weight too much. Slices are thus treated as if they covered different parts
// of a pixel.
//
// Rows are interpolated as in ShiftSlice. Products (15 bits) are rounded halves up. The total of
// all views is divided by 2^extra_bits and rounded halves up. No sum exceeds 2^32 - 1.
void Composite(const SliceViews& views, size_t rows, uint32_t* sums);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_STRIPS_H_
