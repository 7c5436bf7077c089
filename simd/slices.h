// SPDX-License-Identifier: Apache-2.0
// SIMD kernels that make a slice. The kernels select the surfaces whose disparity lies in the
// slice's range. If one view stands for a wide part of the lens, the kernels also spread the
// selected surfaces.
//
// A slice holds R, G, B and coverage as samples with 15 fractional bits. The colours are
// premultiplied by the coverage. A fully covered pixel has the coverage kSliceOne. The four planes
// of a row are `plane` samples apart.
#ifndef STARFOCUS_SIMD_SLICES_H_
#define STARFOCUS_SIMD_SLICES_H_

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "simd/layered_depth.h"
#include "simd/samples.h"

namespace starfocus::simd {

inline constexpr int16_t kSliceOne = 32767;

// A row of pixels with up to kSurfaces surfaces each. The first surface is the nearest one; the
// others have no order. Missing surfaces have a disparity below any slice.
struct SurfaceRow {
  const int16_t* disparity[kSurfaces];
  const int16_t* rgb[kSurfaces];  // Light in three planes, `plane` samples apart.
  // Share of the pixel that the first surface covers, with kSliceBits fractional bits.
  const uint8_t* share;
  size_t plane;
  // Bit c is set if group c of kSliceLanes pixels may have more than one surface. In all other
  // groups, the first surface covers each pixel completely, and no other surface is read.
  uint64_t hiding;
};

// Rows of pixels with surfaces. The rows are `stride` pixels apart.
struct SurfaceRows {
  SurfaceRow first;  // First row; `hiding` is unused.
  size_t stride;
  // Bits of each row as in SurfaceRow::hiding, but for the groups from column 0 on. The first pixel
  // is in column `column`, which may lie within a group.
  const uint64_t* hiding;
  size_t column;
  size_t rows, count;  // Number of rows, and of pixels in each row.

  SurfaceRow Row(size_t y) const {
    SurfaceRow row = first;
    for (int k = 0; k < kSurfaces; ++k) {
      row.disparity[k] += y * stride;
      row.rgb[k] += y * stride;
    }
    row.share += y * stride;
    row.hiding = hiding[y] >> column / kSliceLanes;
    if (column % kSliceLanes != 0) row.hiding |= row.hiding >> 1;
    return row;
  }
};

// Coverage of up to 64 groups of kSliceLanes samples of a row. Bit c of `some` is set if the slice
// covers any pixel of group c. Bit c of `all` is set if the slice completely covers all pixels of
// group c.
struct SliceCover {
  uint64_t some, all;
};

// A symmetric filter of 2 reach + 1 taps with 15 fractional bits. `centre` is the middle tap,
// `inner` applies at the distances 1 .. reach - 1, and `outer` at the distance `reach`. `inner` and
// `outer` are twice the taps, because each weights the mean of the two samples on both sides.
struct SliceTaps {
  int32_t reach;                 // Distance in samples of the outermost taps, [1, kMaxSpread].
  int16_t centre, inner, outer;  // Filter coefficients, >= 0.
};
inline constexpr int32_t kMaxSpread = 3;

// The disparities [low, high] of a slice, and the overlap up to `overlap` (SelectSlice).
struct SliceRange {
  int16_t low, high, overlap;
};

namespace reference {

// Selects the surfaces of a slice, for each pixel of the rows. The slice contains the disparities
// in [low, high], and the overlap, which is the disparities above `high` up to `overlap`. A first
// surface that ends at a pixel, or that covers only a part of the pixel, is excluded from the
// overlap. Without this exclusion, the surface would be in two slices, and its coverage would count
// twice.
//
// A first surface of the slice contributes its light times its share. The next surface of the slice
// contributes its light times the rest of the pixel. The fourth output plane is the sum of the
// coverage of all selected surfaces. All outputs of a pixel are zero if the slice contains none of
// its surfaces. If both surfaces share a pixel, the contribution of the first surface is rounded
// half up. Whole groups of kSliceLanes are read; a row has at most 64 groups.
//
// The bits of all groups in which any row contains a pixel of the slice must be set in `groups`.
// Other groups are not read. cover[y] is set to the coverage of row y. If the slice covers a pixel
// of the row, `width` samples of each plane are written: zeros in groups that the slice does not
// cover, and after the last group. `width` is a multiple of kSliceLanes. The other samples of the
// last group, and the samples of all other rows, are unspecified. The rows of `out` are 4 `plane`
// samples apart.
STARFOCUS_REFERENCE void SelectSlice(const SurfaceRows& from, const SliceRange& slice,
                                     uint64_t groups, size_t width, size_t plane, int16_t* out,
                                     SliceCover* cover) {
  for (size_t y = 0; y < from.rows; ++y, out += 4 * plane) {
    const SurfaceRow row = from.Row(y);
    SliceCover& covers = cover[y] = {0, 0};
    for (size_t c = 0; c < 4; ++c) std::fill_n(out + c * plane, width, int16_t{0});
    for (size_t n = 0; n < from.count; ++n) {
      const uint64_t bit = uint64_t{1} << (n / kSliceLanes);
      if ((groups & bit) == 0) continue;
      const bool hiding = (row.hiding & bit) != 0;
      const auto inside = [&](int surface) {
        const bool end = hiding && surface == 0 && row.share[n] != kSliceWhole;
        return row.disparity[surface][n] >= slice.low &&
               row.disparity[surface][n] <= (end ? slice.high : slice.overlap);
      };
      int next = hiding ? 1 : kSurfaces;
      while (next < kSurfaces && !inside(next)) ++next;
      const int share = hiding && row.share[n] < kSliceWhole ? row.share[n] : kSliceWhole;
      const int front = inside(0) ? share : 0;
      const int behind = next < kSurfaces ? kSliceWhole - front : 0;
      const bool all = front + behind == kSliceWhole;
      for (size_t c = 0; c < 3; ++c) {
        const size_t at = c * row.plane + n;
        const int16_t first = row.rgb[0][at], hidden = behind > 0 ? row.rgb[next][at] : int16_t{0};
        const int32_t part = Product15(first - hidden, front << (15 - kSliceBits));
        out[c * plane + n] =
            front == kSliceWhole ? first : static_cast<int16_t>(front > 0 ? hidden + part : hidden);
      }
      out[3 * plane + n] = static_cast<int16_t>(((front + behind) << 8) - (all ? 1 : 0));
      if (n % kSliceLanes == 0) covers.all |= bit;
      if (front + behind > 0) covers.some |= bit;
      if (!all) covers.all &= ~bit;
    }
  }
}

// Filters samples of 2 reach + 1 rows. Output out[n] is the saturated sum of the products of the
// taps and rows[k][n]. The two samples at an equal distance from the middle row are averaged before
// the multiplication. Each mean and each product is rounded half up. Whole groups of kSliceLanes
// are read and written. Samples must not be negative.
STARFOCUS_REFERENCE void SpreadSlice(const int16_t* const* rows, const SliceTaps& taps,
                                     size_t count, int16_t* out) {
  const int16_t* const* const middle = rows + taps.reach;
  for (size_t n = 0; n < SliceSamples(count); ++n) {
    int32_t sum = Product15(middle[0][n], taps.centre);
    for (int32_t k = 1; k <= taps.reach; ++k) {
      const int32_t mean = (middle[-k][n] + middle[k][n] + 1) >> 1;
      sum += Product15(mean, k < taps.reach ? taps.inner : taps.outer);
      if (sum > INT16_MAX) sum = INT16_MAX;
    }
    out[n] = static_cast<int16_t>(sum);
  }
}

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_SLICES_H_
