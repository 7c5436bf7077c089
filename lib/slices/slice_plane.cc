// SPDX-License-Identifier: Apache-2.0
#include "lib/slices/slice_plane.h"

#include <algorithm>
#include <cstring>

namespace starfocus {
namespace {

using simd::kStripColumns;
using simd::SliceOffset;

constexpr int32_t kFractionOne = 1 << 15;
constexpr int kScaleBits = 12;
constexpr int32_t kScaleOne = 1 << kScaleBits;
// Fractional bits of scaled shifts. Subapertures may be as narrow as 1/256 of a pixel, so scaled
// shifts need more bits than kShiftBits.
constexpr int kScaledBits = kShiftBits + kScaleBits;

// Returns the filter taps of a box that is `subaperture` pixels wide (kShiftBits; more than
// kBoxSubaperture).
simd::SliceTaps TapsOf(int32_t subaperture) {
  constexpr int32_t kLargest = (2 * simd::kMaxSpread + 1) * kShiftOne;
  const int32_t length = Min(subaperture, kLargest);
  simd::SliceTaps taps;
  taps.reach = SpreadRadius(subaperture);
  const int32_t whole = (2 * taps.reach - 1) * kShiftOne;
  const int32_t inner = 2 * kFractionOne * kShiftOne / length;
  const int32_t outer = kFractionOne / kShiftOne * (length - whole) * kShiftOne / length;
  const int32_t centre = kFractionOne - (taps.reach - 1) * inner - outer;
  taps.inner = static_cast<int16_t>(inner);
  taps.outer = static_cast<int16_t>(outer);
  taps.centre = static_cast<int16_t>(centre);
  return taps;
}

// Returns the share of each of two to four pixels that a subaperture of one to three pixels covers
// at `shift` (both kShiftBits). A box on whole pixels followed by interpolation is not sufficient:
// adjacent subapertures would then weight some pixels too much and others too little. Lengths are
// in half units of kShiftBits, so that mirrored shifts give mirrored shares in spite of truncation.
SliceOffset BoxOffset(int32_t shift, int32_t subaperture) {
  // All positions are relative to the left end of the first pixel.
  constexpr int32_t kHalves = 2 * kShiftOne;
  const int32_t start = 2 * shift - subaperture + kShiftOne, whole = start >> (kShiftBits + 1);
  const int32_t left = kHalves - (start & (kHalves - 1)), rest = 2 * subaperture - left;
  const auto part = [&](int32_t covered) {
    return static_cast<int16_t>(-(kFractionOne / 2 * covered / subaperture));
  };
  // Returns the share of the first of two adjacent pixels, relative to both pixels. The box covers
  // the first pixel by `more` half units more than the second pixel.
  const auto share = [&](int32_t more) {
    return static_cast<int16_t>(-(kFractionOne / 2 + kFractionOne / 4 * more / subaperture));
  };
  if (rest <= kHalves) return SliceOffset::Of(whole, share(left - rest), share(left - rest), 0, 0);
  if (rest <= 2 * kHalves) {
    return SliceOffset::Of(whole, part(left), part(left), part(rest - kHalves), 0);
  }
  const int32_t right = rest - 2 * kHalves;
  return SliceOffset::Of(whole, part(left), part(left), share(right - left), part(right));
}

// Returns the share, with 15 fractional bits, of the second of two pixels inside a slice, if a
// subaperture narrower than a pixel moves `rest` from the first to the second pixel (both
// kScaledBits). Each part of the subaperture shows the nearer pixel.
int32_t ShareInside(int64_t rest, int32_t subaperture) {
  const int64_t from_middle = (rest - (1 << (kScaledBits - 1))) * kFractionOne;
  const int64_t share = from_middle / Max(subaperture, 1) + kFractionOne / 2;
  return static_cast<int32_t>(share < 0 ? 0 : share > kFractionOne ? kFractionOne : share);
}

// Splits `shift` (kShiftBits) into whole pixels and a fraction. Pixels at the boundary of a slice
// are interpolated linearly. A subaperture narrower than a pixel spreads each pixel inside a slice
// less than linear interpolation does, and moves the pixel by `scale` times the shift.
SliceOffset OffsetOf(int32_t shift, int32_t subaperture, int32_t scale) {
  if (subaperture > kShiftOne && subaperture <= kBoxSubaperture)
    return BoxOffset(shift, subaperture);
  const int32_t whole = shift >> kShiftBits, rest = shift & (kShiftOne - 1);
  const auto before = [](int32_t fraction) {
    return static_cast<int16_t>(fraction - kFractionOne);
  };
  const int16_t edge = before(rest * (kFractionOne / kShiftOne));
  if (subaperture >= kShiftOne) return SliceOffset::Of(whole, edge, edge, 0, 0);
  const int64_t moved = int64_t{shift} * scale - int64_t{whole} * (1 << kScaledBits);
  const int32_t inside = ShareInside(moved, subaperture * scale);
  return SliceOffset::Of(whole, before(inside), edge, 0, 0);
}

// Returns the scale of the shifts inside a slice whose subapertures are narrower than a pixel. The
// views at a distance of 0 to N columns or rows from the middle view have these `weights` and
// absolute `shifts` (kShiftBits). Pixels are integrals over pixels, and the nearer pixel of
// ShareInside is another integral. As for the PSFs of lib/optics/psf.cc, the variance of the shown
// pixels along an axis exceeds the variance of the subapertures by a quarter of the latter, and by
// at most 1/24 of a pixel. Shifts beyond one pixel are not enlarged.
int32_t InnerScale(const uint32_t* weights, const int32_t* shifts, int32_t n) {
  const auto square = [](int32_t shift) {
    return static_cast<uint64_t>(shift) * static_cast<uint64_t>(shift);
  };
  // The wanted variance times the weight of all views, with 16 fractional bits.
  uint64_t total = 0, exact = 0;
  for (int32_t i = 0; i <= n; ++i) {
    total += weights[i];
    exact += weights[i] * square(shifts[i]);
  }
  exact += total * square(shifts[1]) / 12;
  const uint64_t most = total * square(kShiftOne) / 24;
  const uint64_t wanted = exact + (exact / 4 < most ? exact / 4 : most);
  // Returns the sum of the weighted squares of the distances from which views show pixels, with 16
  // fractional bits.
  const auto squares = [&](int32_t scale) {
    uint64_t sum = 0;
    for (int32_t i = 1; i <= n; ++i) {
      const int32_t moved = shifts[i] * scale, whole = moved >> kScaledBits;
      const int32_t share = ShareInside(moved & ((1 << kScaledBits) - 1), shifts[1] * scale);
      sum += uint64_t{weights[i]} *
             static_cast<uint64_t>(whole * whole * kFractionOne + (2 * whole + 1) * share);
    }
    return sum << 1;
  };
  int32_t low = 0, high = kScaleOne * Max(shifts[n], kShiftOne) / Max(shifts[n], 1);
  if (squares(high) <= wanted) return high;
  constexpr int kBisections = 12;
  for (int k = 0; k < kBisections; ++k) {
    const int32_t middle = (low + high) / 2;
    (squares(middle) < wanted ? low : high) = middle;
  }
  return high;
}

// Returns the groups of kSliceLanes pixels that may contain a pixel of the slice in row y, as in
// SliceCover, from the strips' ranges. The groups are in the columns [columns.first, columns.last).
// Each group contains pixels of one or two strips.
uint64_t FindGroups(const LayeredDepth& surfaces, const Slice& slice, const Range& columns,
                    int32_t y) {
  const int32_t strips = (columns.last - 1) / kStripColumns - columns.first / kStripColumns + 1;
  uint64_t within = 0;
  for (int k = 0; k < simd::kSurfaces; ++k) {
    const simd::DisparityRange* const ranges = surfaces.RangesAt(k, columns.first, y);
    for (int32_t strip = 0; strip < strips; ++strip) {
      const simd::DisparityRange& range = ranges[strip];
      const bool meets = (range.low <= slice.overlap) & (range.high >= slice.low);
      within |= uint64_t{meets} << strip;
    }
  }
  if (columns.first % kStripColumns != 0) within |= within >> 1;
  return within & ((uint64_t{2} << (columns.count() - 1) / kStripColumns) - 1);
}

// Repeats the outermost pixels of a row beyond `columns`, which are the columns of the row that lie
// in the surfaces. Clears the samples after the row, which has `width` columns.
void PadRow(const Range& columns, int32_t width, size_t plane, int16_t* row) {
  for (int c = 0; c < 4; ++c, row += plane) {
    std::fill(row, row + columns.first, row[columns.first]);
    std::fill(row + columns.last, row + width, row[columns.last - 1]);
    std::fill(row + width, row + plane, int16_t{0});
  }
}

// Copies the slice's pixels of `rect`, which is in pixels of the surfaces and has at most
// kRangeRows rows, to the rows from `first` on. The pixels of the slice are in `groups`
// (FindGroups).
void SelectRows(const simd::Kernels& kernels, const LayeredDepth& surfaces, const Slice& slice,
                uint64_t groups, const Rect& rect, int32_t first, const SlicePlane& placed) {
  const Range columns = {Max(0, -rect.x), Min(rect.width, surfaces.width - rect.x)};
  const bool is_padded = columns.count() < rect.width;
  const int32_t x = rect.x + columns.first;
  const size_t at = surfaces.At(x, rect.y), row_samples = 4 * placed.plane;
  simd::SurfaceRows from;
  from.first.plane = surfaces.plane;
  from.first.share = surfaces.share + at;
  for (int k = 0; k < simd::kSurfaces; ++k) {
    from.first.disparity[k] = surfaces.disparity[k] + at;
    from.first.rgb[k] = surfaces.rgb[k] + at;
  }
  from.hiding = surfaces.hiding + rect.y;
  from.column = static_cast<size_t>(x);
  from.stride = static_cast<size_t>(surfaces.stride);
  from.rows = static_cast<size_t>(rect.height);
  from.count = static_cast<size_t>(columns.count());
  int16_t* row = placed.samples + static_cast<size_t>(first) * row_samples;
  simd::SliceCover* const cover = placed.cover + first;
  kernels.SelectSlice(from, {slice.low, slice.high, slice.overlap}, groups,
                      is_padded ? simd::SliceSamples(from.count) : placed.plane, placed.plane,
                      row + columns.first, cover);
  for (int32_t k = 0; is_padded && k < rect.height; ++k, row += row_samples) {
    if (cover[k].some == 0) continue;
    PadRow(columns, rect.width, placed.plane, row);
    // Few rows are padded, so every group of a padded row may simply count as partly covered.
    cover[k] = {~uint64_t{0}, 0};
  }
}

// Filters a slice for a wide subaperture. The filter along rows writes the last kFilteredRows rows
// to `filtered`, and the filter along columns writes the result back to the slice. Beyond the first
// and the last row, the slice counts as empty. Extends the coverage bits by the pixels that the
// filter spreads.
void Spread(const simd::Kernels& kernels, int16_t* filtered, const SlicePlane& placed) {
  const simd::SliceTaps taps = TapsOf(placed.subaperture);
  const int32_t reach = taps.reach, last = 2 * reach;
  const size_t count = 4 * placed.plane;  // samples of a row
  const int16_t* rows[kFilteredRows];
  uint64_t some[kFilteredRows] = {};  // unextended bits of the rows
  for (int32_t row = -reach; row < placed.rows + reach; ++row) {
    int16_t* const along_row =
        filtered + static_cast<size_t>((row + reach) % kFilteredRows) * count;
    for (int32_t k = 0; k < last; ++k) some[k] = some[k + 1];
    some[last] = row >= 0 && row < placed.rows ? placed.cover[row].some : 0;
    if (some[last] != 0) {
      const int16_t* const first = placed.samples + static_cast<size_t>(row) * count - reach;
      for (int32_t k = 0; k <= last; ++k) rows[k] = first + k;
      kernels.SpreadSlice(rows, taps, count, along_row);
    } else {
      std::memset(along_row, 0, count * sizeof(*along_row));
    }
    if (row < reach) continue;
    uint64_t any = 0;
    for (int32_t k = 0; k <= last; ++k) {
      any |= some[k];
      rows[k] = filtered + static_cast<size_t>((row - reach + k) % kFilteredRows) * count;
    }
    placed.cover[row - reach].some = any | any << 1 | any >> 1;
    if (any == 0) continue;
    kernels.SpreadSlice(rows, taps, count,
                        placed.samples + static_cast<size_t>(row - reach) * count);
  }
}

}  // namespace

void FindOffsets(const ViewGrid& grid, const Slice* slices, int32_t count, SliceOffset* offsets) {
  const int32_t n = grid.n();
  uint32_t weights[kMaxViewsAlongRadius + 1] = {};
  for (int32_t i = -n; i <= n; ++i) {
    for (int32_t j = -n; j <= n; ++j) weights[Abs(i)] += grid.aperture.Weight(i, j);
  }
  int32_t shifts[kMaxViewsAlongRadius + 1];
  for (int32_t k = 0; k < count; ++k) {
    const int16_t disparity = slices[k].disparity;
    for (int32_t i = 0; i <= n; ++i) shifts[i] = Abs(grid.Shift(grid.Move(i), disparity));
    const int32_t subaperture = shifts[1];
    const int32_t scale = subaperture < kShiftOne ? InnerScale(weights, shifts, n) : kScaleOne;
    const bool is_near = grid.focus.Distance(disparity) > 0;
    for (int32_t i = -n; i <= n; ++i) {
      const int32_t shift = (i > 0) == is_near ? shifts[Abs(i)] : -shifts[Abs(i)];
      offsets[(i + n) * count + k] = OffsetOf(shift, subaperture, scale);
    }
  }
}

void PlaceSlice(const ViewGrid& grid, int16_t disparity, const Rect& rect, SlicePlane* placed) {
  placed->subaperture = Abs(grid.Shift(grid.Move(1), disparity));
  placed->reach = SliceReach(Abs(grid.Shift(grid.Move(grid.n()), disparity)), placed->subaperture);
  placed->rows = rect.height + 2 * placed->reach;
  placed->plane = PlaneSamples(static_cast<size_t>(rect.width), static_cast<size_t>(placed->reach));
}

uint64_t FillSlice(const simd::Kernels& kernels, const LayeredDepth& surfaces, const Slice& slice,
                   const Rect& rect, int16_t* filtered, const SlicePlane& placed) {
  uint64_t selected = 0;
  const int32_t x = rect.x - placed.reach, y = rect.y - placed.reach;
  const int32_t width = rect.width + 2 * placed.reach;
  const Range columns = {Max(x, 0), Min(x + width, surfaces.width)};
  for (int32_t row = 0, rows; row < placed.rows; row += rows) {
    // Rows beyond the first and the last row of the surfaces repeat this row.
    const int32_t from = Clamp(y + row, 0, surfaces.height - 1), left = surfaces.height - from;
    rows = from > y + row ? 1 : Min(kRangeRows - from % kRangeRows, Min(placed.rows - row, left));
    const uint64_t groups = FindGroups(surfaces, slice, columns, from);
    selected += CountBits(groups) * static_cast<size_t>(rows) * simd::kSliceLanes;
    if (groups != 0) {
      SelectRows(kernels, surfaces, slice, groups, {x, from, width, rows}, row, placed);
    } else {
      std::fill_n(placed.cover + row, rows, simd::SliceCover{0, 0});
    }
  }
  if (placed.subaperture > kBoxSubaperture) Spread(kernels, filtered, placed);
  return selected;
}

}  // namespace starfocus
