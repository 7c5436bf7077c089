// SPDX-License-Identifier: Apache-2.0
// SIMD kernels that composite slices, front to back, into the views of a strip. A strip is a column
// of kSliceLanes pixels whose rows are contiguous in memory.
#ifndef STARFOCUS_SIMD_STRIPS_H_
#define STARFOCUS_SIMD_STRIPS_H_

#include <cstddef>
#include <cstdint>

#include "simd/samples.h"
#include "simd/slices.h"

namespace starfocus::simd {

// Rows of a slice before the slice is shifted to its position in a view. The four planes of each
// row are `plane` samples apart.
struct SlicePlanes {
  const int16_t* samples;
  size_t plane;
};

// Factors of the interpolation between up to four consecutive samples p of a slice:
//   p[1] + first (p[1] - p[0]) + third (p[1] - p[2]) + fourth (p[2] - p[3]).
// The factor `first` is `inside` if p[0] and p[1] have equal coverage, and `edge` if not. All
// factors are in [-1, 0] with 15 fractional bits, because 16 bits can represent -1 but not 1. If
// `third` is not 0, `inside` and `edge` are equal. If `third` is 0, `fourth` is also 0.
struct SliceFraction {
  int16_t inside, edge, third, fourth;
};

// Number of rows of a strip that Composite may read after the last row that it composites.
inline constexpr size_t kRowsAhead = 6;

// Special values of a row's mark. The mark is the number of consecutive rows, from this row on, in
// which the slice covers no pixel, limited to kNothingNear. The mark is kCoveredNear if the slice
// fully covers all pixels of this row and of the next kRowsAhead rows.
inline constexpr int8_t kNothingNear = kRowsAhead + 1;
inline constexpr int8_t kCoveredNear = -1;

// A slice in a strip. The four planes are `plane` samples apart. A row has kSliceLanes samples.
struct StripSlice {
  const int16_t* samples;  // First row of the slice that the centre view shows.
  const int8_t* near;  // Marks of the slice's rows; element 0 is the mark of the row at `samples`.
  size_t plane;
};

// Position of a slice in a view: a shift by whole rows, and the interpolation between a row and the
// next rows.
struct SliceOffset {
  int16_t whole;
  int16_t taps;  // number of interpolated rows: 2, 3 or 4, depending on the fraction
  SliceFraction fraction;

  static constexpr SliceOffset Of(int32_t whole, const SliceFraction& fraction) {
    const int taps = 2 + (fraction.third != 0 ? 1 : 0) + (fraction.fourth != 0 ? 1 : 0);
    return {static_cast<int16_t>(whole), static_cast<int16_t>(taps), fraction};
  }
};

// Largest number of slices that a view can show.
inline constexpr size_t kMaxSeen = 32;

// The views that Composite adds. In each view, the slices are shifted along the columns of the
// strip.
struct SliceViews {
  const int16_t* weights;      // Weight of each view, in [0, 2^14); the sum is at most 58000.
  const SliceOffset* offsets;  // offsets[view * count + k]: position of slice k in a view.
  size_t views;
  const StripSlice* slices;
  size_t count;          // Number of slices.
  const uint8_t* shown;  // Indices of the visible slices, from the nearest to the farthest.
  size_t shown_count;    // Number of visible slices, at most kMaxSeen.
  size_t row;            // First row that is composited.
  // extra_bits is the number of additional fractional bits of the weights, [0, 4]; the sums are
  // divided by 2^extra_bits.
  int extra_bits;
};

namespace reference {

// Shifts rows of a slice along the row by a fraction of a sample, and stores the result in a strip.
// The planes of the strip are `plane` samples apart. Sample out[n] is interpolated between in[n]
// and the following samples. Each product is rounded half up.
//
// near[row] is the mark of a row; kRowsAhead more marks precede near[0]. Before the call, all marks
// must be at least kNothingNear. The kernel sets the marks of rows in which the slice covers a
// pixel, and the marks of the kRowsAhead rows before such a row. The marks of all other rows are
// not changed.
void ShiftSlice(const SlicePlanes& in, const SliceFraction& fraction, size_t rows, size_t plane,
                int16_t* out, int8_t* near);

// Composites the views of a strip and adds the results to sums[(4 row + c) kSliceLanes + n], where
// c is the plane. A slice contributes its premultiplied colours and reduces the remaining light by
// its coverage.
//
// If the coverage of a slice exceeds the remaining light, the contribution of the slice is reduced
// in proportion. The contribution may be too large by up to a ninth of the view's weight. Slices
// are thus treated as if each slice covered a different part of a pixel.
//
// Rows are interpolated as in ShiftSlice. Products (15 fractional bits) are rounded half up. The
// total of all views is divided by 2^extra_bits and rounded half up. Sums must not exceed 2^32 - 1.
void Composite(const SliceViews& views, size_t rows, uint32_t* sums);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_STRIPS_H_
