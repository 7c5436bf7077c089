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

// Largest number of rows that the interpolation reads after the first row (SliceOffset::taps).
inline constexpr size_t kRowsAhead = 3;

// Number of samples of a row of a strip: kSliceLanes samples of R, of G, of B and of the coverage.
inline constexpr size_t kStripRow = 4 * kSliceLanes;

// A half of a strip's columns, which is a vector of the narrowest targets.
inline constexpr size_t kHalfStrip = kSliceLanes / 2;

// Coverage of 64 rows of a half of a strip. Bit r of `some` is set if the slice covers any pixel of
// row r, and bit r of `all` if it completely covers all pixels.
struct RowCover {
  uint64_t some, all;
};

// Returns the number of RowCover of a slice of `rows` rows in a strip. Element 2 w + h has rows 64
// w to 64 w + 63 of half h. Kernels read the bits of 64 rows after any row.
constexpr size_t RowCovers(size_t rows) { return 2 * (rows / 64 + 2); }

// A slice in a strip.
struct StripSlice {
  int16_t* samples;  // First row, kStripRow samples per row.
  RowCover* cover;   // `covers` elements.
  size_t covers;     // RowCovers of the slice's rows.
};

// Position of a slice in a view, along rows or columns: a shift by whole pixels, and factors of the
// interpolation between up to four consecutive samples p of the slice:
//   p[1] + first (p[1] - p[0]) + third (p[1] - p[2]) + fourth (p[2] - p[3]).
// The factor `first` is `inside` if p[0] and p[1] have equal coverage, and `edge` if not. All
// factors are in [-1, 0] with 15 fractional bits, because 16 bits can represent -1 but not 1. If
// `third` is not 0, `inside` and `edge` are equal, and the sum of `edge` and `third` is at least
// -3/4, so that no colour exceeds the coverage. If `third` is 0, `fourth` is also 0.
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

// Rows of a slice that ShiftSlice shifts. Each row has four planes, `plane` samples apart.
struct SliceRows {
  const int16_t* samples;  // First row, at the first column of the strip.
  size_t plane;
  const SliceCover* cover;  // Coverage of each row.
  uint64_t groups;          // Groups of a row that any view shows in the strip, as in SliceCover.
  // True if a row is fully covered where SliceCover says so. Filters leave less than that.
  bool keeps_whole;
};

// Largest number of slices that a view can show.
inline constexpr size_t kMaxSeen = 32;

// Largest number of rows that Composite composites in one call.
inline constexpr size_t kMostRows = 32;

// A slice that views show in the rows that are composited.
struct SeenSlice {
  StripSlice slice;
  size_t row;     // Row of the strip that an unmoved view shows in the first row.
  size_t index;   // Index of the slice's offsets.
  uint32_t rows;  // Bit y is set if the slice may be visible in row y.
};

// The views that Composite adds. In each view, the slices are shifted along the columns of the
// strip.
struct SliceViews {
  const int16_t* weights;      // Weight of each view, in [0, 2^14); the sum is at most 58000.
  const SliceOffset* offsets;  // offsets[view * count + k]: position of slice k in a view.
  size_t views;
  size_t count;           // Number of slices.
  const SeenSlice* seen;  // The visible slices, from the nearest to the farthest.
  size_t seen_count;      // Number of visible slices, at most kMaxSeen.
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

// Shifts rows of a slice along the row by `offset`, and stores the result in the rows [first, end)
// of a strip. Sample n of a row is interpolated between sample n + whole and the following samples.
// Each product is rounded half up. Pixels without coverage in a whole half of a row become zero.
// Writes the coverage of all rows of `out`; other rows than [first, end) have none.
STARFOCUS_REFERENCE void ShiftSlice(const SliceRows& in, const SliceOffset& offset, size_t first,
                                    size_t end, const StripSlice& out) {
  for (size_t n = 0; n < out.covers; ++n) out.cover[n] = {0, 0};
  for (size_t y = first; y < end; ++y) {
    int16_t* const row = out.samples + y * kStripRow;
    std::fill_n(row, kStripRow, int16_t{0});
    if ((in.cover[y - first].some & in.groups) == 0) continue;
    const int16_t* from = in.samples + offset.whole + 4 * (y - first) * in.plane;
    for (size_t half = 0; half < 2; ++half) {
      bool some = false, all = true;
      const auto shift = [&](size_t c) {
        for (size_t n = half * kHalfStrip; n < (half + 1) * kHalfStrip; ++n) {
          const int16_t value =
              Between15(from + c * in.plane + n, from + 3 * in.plane + n, 1, offset);
          row[c * kSliceLanes + n] = value;
          some = some || value != 0;
          all = all && value == kSliceOne;
        }
      };
      shift(3);
      RowCover& cover = out.cover[y / 64 * 2 + half];
      cover.some |= uint64_t{some} << y % 64;
      cover.all |= uint64_t{all} << y % 64;
      for (size_t c = 0; c < 3 && some; ++c) shift(c);
    }
  }
}

// Composites the views of `rows` rows of a strip, in [1, kMostRows], and adds the results to
// sums[(4 row + c) kSliceLanes + n], where c is the plane. A slice contributes its premultiplied
// colours and reduces the remaining light by its coverage.
//
// If the coverage of a slice exceeds the remaining light, the contribution of the slice is reduced
// in proportion. The contribution may be too large by up to a ninth of the view's weight. Slices
// are thus treated as if each slice covered a different part of a pixel.
//
// Rows are interpolated as in ShiftSlice. Rows that neither cover a pixel nor are followed by such
// a row among the interpolated rows are not read. In a slice, no colour may exceed the coverage by
// more than 1, so that pixels without coverage contribute nothing. Products (15 fractional bits)
// are rounded half up. The total of all views is divided by 2^extra_bits and rounded half up. Sums
// must not exceed 2^32 - 1.
STARFOCUS_REFERENCE void Composite(const SliceViews& views, size_t rows, uint32_t* sums) {
  for (size_t y = 0; y < rows; ++y, sums += kStripRow) {
    for (size_t n = 0; n < kSliceLanes; ++n) {
      uint32_t given[4] = {0, 0, 0, 0};
      for (size_t view = 0; view < views.views; ++view) {
        const int16_t weight = views.weights[view];
        int16_t light = kSliceOne;
        for (size_t k = 0; k < views.seen_count; ++k) {
          const SeenSlice& seen = views.seen[k];
          const SliceOffset& offset = views.offsets[view * views.count + seen.index];
          const size_t moved = seen.row + y + static_cast<size_t>(ptrdiff_t{offset.whole});
          const auto shows = [&](size_t row) {
            const RowCover* cover = seen.slice.cover + row / 64 * 2;
            return ((cover[0].some | cover[1].some) >> row % 64 & 1) != 0;
          };
          bool shown = false;
          for (size_t tap = 0; tap < static_cast<size_t>(offset.taps); ++tap) {
            shown = shown || shows(moved + tap);
          }
          if (!shown || (seen.rows >> y & 1) == 0) continue;
          const int16_t* from = seen.slice.samples + moved * kStripRow + n;
          const auto value = [&](size_t c) {
            return Between15(from + c * kSliceLanes, from + 3 * kSliceLanes, kStripRow, offset);
          };
          const int16_t covered = value(3);
          const bool over = covered > light;
          const int16_t part = over ? Product15(weight, SliceShare(covered, light)) : weight;
          for (size_t c = 0; c < 4; ++c)
            given[c] += static_cast<uint32_t>(Product15(value(c), part));
          light = static_cast<int16_t>(over ? 0 : light - covered);
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
