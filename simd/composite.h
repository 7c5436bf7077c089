// SPDX-License-Identifier: Apache-2.0
// SIMD kernels that composite slices, front to back, into the views of a strip, and that convert
// the sums of the views to a picture's accumulators. A strip is a column of kSliceLanes pixels
// whose rows are contiguous in memory.
#ifndef STARFOCUS_SIMD_COMPOSITE_H_
#define STARFOCUS_SIMD_COMPOSITE_H_

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "simd/light.h"
#include "simd/samples.h"
#include "simd/slices.h"

namespace starfocus::simd {

// Number of rows of a strip that Composite may read after the last row that it composites.
inline constexpr size_t kRowsAhead = 6;

// Special values of a row's mark. The mark is the number of consecutive rows, from this row on, in
// which the slice covers no pixel, limited to kNothingNear. The mark is kCoveredNear if the slice
// fully covers all pixels of this row and of the next kRowsAhead rows.
inline constexpr int8_t kNothingNear = kRowsAhead + 1;
inline constexpr int8_t kCoveredNear = -1;

// A slice in a strip. The four planes are `plane` samples apart. A row has kSliceLanes samples.
struct StripSlice {
  int16_t* samples;  // First row of the slice that the centre view shows.
  int8_t* near;      // Marks of the slice's rows; element 0 is the mark of the row at `samples`.
  size_t plane;
};

// Position of a slice in a view, along rows or columns: a shift by whole pixels, and factors of the
// interpolation between up to four consecutive samples p of the slice:
//   p[1] + first (p[1] - p[0]) + third (p[1] - p[2]) + fourth (p[2] - p[3]).
// The factor `first` is `inside` if p[0] and p[1] have equal coverage, and `edge` if not. All
// factors are in [-1, 0] with 15 fractional bits, because 16 bits can represent -1 but not 1. If
// `third` is not 0, `inside` and `edge` are equal. If `third` is 0, `fourth` is also 0.
struct SliceOffset {
  int16_t whole;
  int16_t taps;  // number of interpolated samples: 2, 3 or 4, depending on the factors
  int16_t inside, edge, third, fourth;

  static constexpr SliceOffset Of(int32_t whole, int16_t inside, int16_t edge, int16_t third,
                                  int16_t fourth) {
    const int taps = 2 + (third != 0 ? 1 : 0) + (fourth != 0 ? 1 : 0);
    return {static_cast<int16_t>(whole), static_cast<int16_t>(taps), inside, edge, third, fourth};
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

inline constexpr int kInverseBits = 48;

namespace reference {

inline int16_t Between15(int16_t from, int16_t to, int16_t fraction) {
  return static_cast<int16_t>(to + Product15(to - from, fraction));
}

// Interpolates between a sample and the following samples, which are `next` apart. `covered` points
// to the coverage of the first sample.
inline int16_t Between15(const int16_t* at, const int16_t* covered, size_t next,
                         const SliceOffset& offset) {
  const bool alike = covered[0] == covered[next];
  int value = Between15(at[0], at[next], alike ? offset.inside : offset.edge);
  if (offset.third != 0) value += Product15(at[next] - at[2 * next], offset.third);
  if (offset.fourth != 0) value += Product15(at[2 * next] - at[3 * next], offset.fourth);
  return static_cast<int16_t>(value);
}

// Approximates light / covered, both in units of kSliceOne, by the series 1 - excess (1 + open +
// open^2). `open` is the part of the pixel that the slice does not cover. The result is exact if
// `open` is 0 or the excess is small, and at most 4 * light.
inline int16_t SliceShare(int16_t covered, int16_t light) {
  const int32_t excess = covered - light, open = kSliceOne - covered;
  const int16_t first = Product15(excess, open), second = Product15(first, open);
  const int32_t share = kSliceOne - Saturated(excess + first + second);
  return static_cast<int16_t>(share < 4 * light ? share : Saturated(4 * light));
}

// Shifts rows of a slice along the row by `offset`, and stores the result in a strip.
// The four planes of each row of `in` are `in_plane` samples apart. The planes of the strip are
// `plane` samples apart. Sample out[n] is interpolated between in[n + whole] and the following
// samples. Each product is rounded half up.
//
// Row n of `in` is empty, and is not read, if the slice covers none of the groups `groups` in
// cover[n]. These groups contain all samples that the kernel reads of the other rows.
//
// near[row] is the mark of a row; kRowsAhead more marks precede near[0]. Before the call, all marks
// must be at least kNothingNear. The kernel sets the marks of rows in which the slice covers a
// pixel, and the marks of the kRowsAhead rows before such a row. The marks of all other rows are
// not changed.
STARFOCUS_REFERENCE void ShiftSlice(const int16_t* in, size_t in_plane, const SliceOffset& offset,
                                    const SliceCover* cover, uint64_t groups, size_t rows,
                                    size_t plane, int16_t* out, int8_t* near) {
  // Number of consecutive fully covered rows up to and including the current row.
  size_t all_covered = 0;
  for (size_t row = 0; row < rows; ++row) {
    if ((cover[row].some & groups) == 0) {
      for (size_t c = 0; c < 4; ++c) {
        std::fill_n(out + c * plane + row * kSliceLanes, kSliceLanes, int16_t{0});
      }
      all_covered = 0;
      continue;
    }
    const int16_t* first = in + offset.whole + 4 * row * in_plane;
    const int16_t* covered = first + 3 * in_plane;
    for (size_t c = 0; c < 4; ++c) {
      const int16_t* from = first + c * in_plane;
      int16_t* to = out + c * plane + row * kSliceLanes;
      for (size_t n = 0; n < kSliceLanes; ++n) to[n] = Between15(from + n, covered + n, 1, offset);
    }
    const int16_t *shown = out + 3 * plane + row * kSliceLanes, *end = shown + kSliceLanes;
    int8_t* last = near + row;
    if (std::any_of(shown, end, [](int16_t sample) { return sample != 0; })) {
      for (int k = 0; k <= int{kRowsAhead}; ++k) last[-k] = std::min(last[-k], int8_t(k));
    }
    const bool all = std::all_of(shown, end, [](int16_t sample) { return sample == kSliceOne; });
    all_covered = all ? all_covered + 1 : 0;
    if (all_covered > kRowsAhead) last[-int{kRowsAhead}] = kCoveredNear;
  }
}

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
STARFOCUS_REFERENCE void Composite(const SliceViews& views, size_t rows, uint32_t* sums) {
  for (size_t y = 0; y < rows; ++y, sums += 4 * kSliceLanes) {
    const size_t row = views.row + y;
    for (size_t n = 0; n < kSliceLanes; ++n) {
      uint32_t given[4] = {0, 0, 0, 0};
      for (size_t view = 0; view < views.views; ++view) {
        const int16_t weight = views.weights[view];
        int16_t light = kSliceOne;
        for (size_t k = 0; k < views.shown_count; ++k) {
          const StripSlice& slice = views.slices[views.shown[k]];
          const SliceOffset& offset = views.offsets[view * views.count + views.shown[k]];
          const ptrdiff_t moved = static_cast<ptrdiff_t>(row) + offset.whole;
          if (slice.near[moved] == kNothingNear) continue;
          const int16_t* from = slice.samples + moved * ptrdiff_t{kSliceLanes} + n;
          const auto value = [&](size_t c) {
            return Between15(from + c * slice.plane, from + 3 * slice.plane, kSliceLanes, offset);
          };
          const int16_t covered = value(3);
          for (size_t c = 0; c < 4; ++c) {
            const int16_t lit =
                covered > light ? Product15(value(c), SliceShare(covered, light)) : value(c);
            given[c] += static_cast<uint32_t>(Product15(weight, lit));
          }
          light = static_cast<int16_t>(covered > light ? 0 : light - covered);
        }
      }
      const uint32_t half = uint32_t{1} << views.extra_bits >> 1;
      for (size_t c = 0; c < 4; ++c) {
        sums[n + c * kSliceLanes] += (given[c] + half) >> views.extra_bits;
      }
    }
  }
}

// Divides colours by coverage. `least` is the smallest coverage by which colours are divided, > 0.
// Accumulators have `bits` fractional bits, [kLightBits, 24]. Colour c of pixel n is sums[c * plane
// + n], and its coverage is covered = sums[3 * plane + n]. If covered >= least, out[3 n + c] is
// sums[c * plane + n] * (2^kInverseBits / covered) in units of 2^-bits. The division truncates; the
// product is rounded half up and limited to 255. If covered < least, out[3 n + c] is the light
// centre[3 n + c], converted to units of 2^-bits. Sums are read in whole groups of kSliceLanes;
// nothing past out[3 count - 1] is written.
STARFOCUS_REFERENCE void FinishComposite(const uint32_t* sums, size_t plane, const int16_t* centre,
                                         uint32_t least, int bits, size_t count, uint32_t* out) {
  const int shift = kInverseBits - 8 - bits;
  const uint64_t white = uint64_t{255} << bits, half = uint64_t{1} << (shift - 1);
  for (size_t n = 0; n < count; ++n) {
    const uint32_t covered = sums[3 * plane + n];
    const bool missing = covered < least;
    const uint64_t inverse = missing ? 0 : (uint64_t{1} << kInverseBits) / covered;
    for (size_t c = 0; c < 3; ++c) {
      const uint64_t value = (sums[c * plane + n] * inverse + half) >> shift;
      out[3 * n + c] = missing ? static_cast<uint32_t>(centre[3 * n + c]) << (bits - kLightBits)
                               : static_cast<uint32_t>(value < white ? value : white);
    }
  }
}

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_COMPOSITE_H_
