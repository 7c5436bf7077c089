// SPDX-License-Identifier: Apache-2.0
#include "lib/slices/strip.h"

#include <cstring>

namespace starfocus {
namespace {

constexpr int32_t kRowsAhead = static_cast<int32_t>(simd::kRowsAhead);

class Strip {
 public:
  Strip(const StripJob& job, const StripPairs& pairs)
      : job_(job), stack_(*job.stack), pairs_(pairs) {}

  // Composites one column of views at a time.
  void Composite() {
    FindRows();
    PlaceSlices();
    for (int32_t i = -stack_.grid->n(); i <= stack_.grid->n(); ++i) {
      if (!GoesOn(job_.cancel, samples_ * (2 * stack_.weights.LastAcross(Abs(i)) + 1))) return;
      AddColumn(i);
    }
  }

 private:
  // Finds the slices that are visible in at least one cell pair, and the rows of these slices.
  // Clears the sums.
  void FindRows() {
    for (int32_t k = 0; k < stack_.count; ++k) rows_[k] = {0, 0};
    for (const CellPair* pair = pairs_.first; pair < pairs_.end; ++pair) {
      for (int32_t n = 0; n < pair->count; ++n) {
        RowRange& rows = rows_[pair->shown[n]];
        if (rows.last == 0) rows.first = pair->y;
        rows.last = pair->y + pair->rows;
      }
      const size_t sums = kPixelSums * static_cast<size_t>(pair->rows * simd::kStripColumns);
      samples_ += static_cast<int64_t>(sums) * pair->count;
      std::memset(SumsOfRow(job_.sums, pair->y), 0, sums * sizeof(*job_.sums));
    }
    for (int32_t k = 0; k < stack_.count; ++k) {
      if (rows_[k].last != 0) seen_slices_[seen_++] = k;
    }
  }

  // Allocates memory of the strip for the slices that are visible in the cell pairs. The marks
  // `near` of all slices are stored after the samples of all slices.
  void PlaceSlices() {
    size_t rows = 0;
    for (int32_t n = 0; n < seen_; ++n) {
      rows += static_cast<size_t>(job_.planes[seen_slices_[n]].rows) + simd::kRowsAhead;
    }
    int16_t* samples = job_.memory;
    int8_t* near =
        reinterpret_cast<int8_t*>(samples + 4 * rows * simd::kStripColumns) + simd::kRowsAhead;
    for (int32_t n = 0; n < seen_; ++n) {
      const int32_t k = seen_slices_[n];
      const SlicePlane& placed = job_.planes[k];
      ShiftedSlice& shifted = shifted_[k];
      shifted.samples = samples;
      shifted.near = near;
      PlaceStrip(placed, pairs_.x, rows_[k], &shifted);
      shown_[k] = {samples + placed.reach * simd::kStripColumns, near + placed.reach,
                   shifted.plane};
      samples += 4 * shifted.plane;
      near += shifted.plane / simd::kStripColumns;
    }
  }

  // Adds all views (i, j) of column i.
  void AddColumn(int32_t i) {
    const int32_t last = stack_.weights.LastAcross(Abs(i));
    for (int32_t n = 0; n < seen_; ++n) MoveSlice(seen_slices_[n], i, last);
    // Skips views of weight 0 at both ends of the column.
    const ViewWeights& aperture = *stack_.weights.aperture;
    int32_t begin = -last, end = last;
    while (begin <= end && aperture.Weight(i, begin) == 0) ++begin;
    while (begin <= end && aperture.Weight(i, end) == 0) --end;
    for (int32_t group = -last; group <= end; group += kGroupViews) {
      const int32_t most = Min(group + kGroupViews - 1, end);
      for (int32_t first = Max(group, begin); first <= most;) {
        const int32_t alike = stack_.weights.LastAlike(i, first, most);
        if (aperture.Weight(i, first) != 0)
          AddGroup(i, first, alike);  // views with weight 0 add no light
        first = alike + 1;
      }
    }
  }

  // Shifts slice k for column i of views and writes the result to the strip. Only the rows that
  // views (i, -last) to (i, last) show are written.
  void MoveSlice(int32_t k, int32_t i, int32_t last) {
    const SlicePlane& placed = job_.planes[k];
    const RowRange& seen = rows_[k];
    const int32_t a = stack_.Offset(k, -last).whole, b = stack_.Offset(k, last).whole;
    const RowRange rows = {seen.first + placed.reach + Min(a, b),
                           Min(seen.last + placed.reach + Max(a, b) + kRowsAhead, placed.rows)};
    ShiftSlice(*job_.kernels, placed, stack_.Offset(k, i), pairs_.x, rows, shifted_[k]);
  }

  // Adds views (i, first) to (i, last).
  void AddGroup(int32_t i, int32_t first, int32_t last) {
    const uint32_t shares = stack_.weights.Shares(i, first, last);
    for (uint32_t share = 0; share < shares; ++share) AddShare(i, first, last, {share, shares});
  }

  void AddShare(int32_t i, int32_t first, int32_t last, const WeightShare& share) {
    const int extra_bits = stack_.weights.ExtraBits(i, first, last);
    for (int32_t j = first; j <= last; ++j) {
      job_.weights[j - first] = stack_.weights.Weight(i, j, extra_bits, share);
    }
    for (const CellPair* pair = pairs_.first; pair < pairs_.end; ++pair) {
      const simd::SliceViews views = {job_.weights,
                                      &stack_.Offset(0, first),
                                      static_cast<size_t>(last + 1 - first),
                                      shown_,
                                      static_cast<size_t>(stack_.count),
                                      pair->shown,
                                      static_cast<size_t>(pair->count),
                                      static_cast<size_t>(pair->y),
                                      extra_bits};
      job_.kernels->Composite(views, static_cast<size_t>(pair->rows),
                              SumsOfRow(job_.sums, pair->y));
    }
  }

  const StripJob& job_;
  const SliceStack& stack_;
  const StripPairs& pairs_;
  int64_t samples_ = 0;  // samples composited in one view, four per pixel, summed over all slices
  int32_t seen_ = 0;
  int32_t seen_slices_[kMaxSlices];
  RowRange rows_[kMaxSlices];  // For each slice, the rows of the cell pairs that show the slice.
  ShiftedSlice shifted_[kMaxSlices];    // The slices shifted for the current column of views.
  simd::StripSlice shown_[kMaxSlices];  // `shifted_` in the format of the SIMD kernel.
};

}  // namespace

void CompositeStrip(const StripJob& job, const StripPairs& pairs) { Strip(job, pairs).Composite(); }

}  // namespace starfocus
