// SPDX-License-Identifier: Apache-2.0
// Composites a strip, which consists of kSliceLanes adjacent pixel columns in a bucket. All views
// of a strip are composited while the slices of the strip are in the L1 cache.
#include <cstring>

#include "lib/slices/compositor.h"

namespace starfocus {
namespace {

// If the coverage of a pixel, summed over all views, is less than 1 / kLeastShare of the largest
// possible sum, the pixel takes the colour of the centre view. No test picture has a pixel with so
// little coverage (docs/constants.md).
constexpr uint32_t kLeastShare = 4;

// Largest number of views of a column that are summed together in 16 bits. If more views were
// summed together, each weight would be smaller, and the products of small weights and faint light
// would round to zero.
constexpr int32_t kViewsAtOnce = 16;

// Largest sum of the weights of a group of views. The rest of the 16-bit range is for two errors:
// the rounding in each slice, and a contribution that exceeds the weight of its view by up to a
// ninth.
constexpr uint32_t kGroupSum = 58000;

// Limits for apertures with a steep fall-off (theta of at least 0.3 pi), in which the largest
// weight of a view is more than kSteep times the mean weight. ScaleWeights multiplies the weights
// of these apertures until the mean weight is at least kLeastMean, but by a factor of at most
// kMostPortions. Each product of a weight and a light value is rounded, so smaller weights would
// change the 8-bit codes of dark pixels.
constexpr uint64_t kSteep = 3;
constexpr uint64_t kLeastMean = 2 * kGroupSum / kViewsAtOnce;
constexpr uint64_t kMostPortions = 32;

// Returns the sum of the weights of views (i, first) to (i, last) or four times the largest of
// these weights, whichever is larger.
uint32_t GroupSum(const ViewWeights& aperture, int32_t i, int32_t first, int32_t last) {
  uint32_t sum = 0, most = 0;
  for (int32_t j = first; j <= last; ++j) {
    const uint32_t weight = aperture.Weight(i, j);
    sum += weight;
    most = weight > most ? weight : most;
  }
  return 4 * most > sum ? 4 * most : sum;
}

constexpr int kMostExtraBits = 4;
constexpr int kNoLight = 99;  // result of RankOf for a weight of 0

// Returns the number of times that `weight` can be multiplied by sixteen without exceeding
// `largest`; kNoLight for weight 0.
int RankOf(uint32_t weight, uint32_t largest) {
  int rank = 0;
  for (uint64_t times = weight; times << kMostExtraBits <= largest; ++rank) {
    if (times == 0) return kNoLight;
    times <<= kMostExtraBits;
  }
  return rank;
}

// Returns the largest j for which the aperture has a view (i, j).
int32_t LastAcross(const ViewWeights& aperture, int32_t i) {
  int32_t j = aperture.last;
  while (i * i + j * j > aperture.most) --j;
  return j;
}

}  // namespace

void ScaleWeights(SliceStack* stack) {
  const ViewWeights& aperture = stack->grid->aperture;
  uint32_t largest_sum = 0;
  uint64_t views = 0;
  stack->largest_weight = 0;
  // The weights of columns -i and i are equal, except in full apertures.
  for (int32_t i = aperture.full ? -aperture.last : 0; i <= aperture.last; ++i) {
    const int32_t last = LastAcross(aperture, i);
    for (int32_t j = -last; j <= last; ++j) {
      const uint32_t weight = aperture.Weight(i, j);
      stack->largest_weight = weight > stack->largest_weight ? weight : stack->largest_weight;
      if (weight > 0) views += aperture.full || i == 0 ? 1 : 2;
    }
    for (int32_t first = -last; first <= last; first += kViewsAtOnce) {
      const uint32_t sum = GroupSum(aperture, i, first, Min(first + kViewsAtOnce - 1, last));
      largest_sum = sum > largest_sum ? sum : largest_sum;
    }
  }
  uint64_t scale = (uint64_t{kGroupSum} << 16) / largest_sum;
  if (stack->largest_weight * views > kSteep << aperture.sum_bits) {
    const uint64_t sum = (scale << aperture.sum_bits) >> 16;
    const uint64_t portions = (views * kLeastMean + sum - 1) / sum;
    scale *= portions < kMostPortions ? portions : kMostPortions;
  }
  stack->weight_scale = scale;
  stack->least_covered = static_cast<uint32_t>(((scale << aperture.sum_bits) >> 16) / kLeastShare);
}

namespace {

constexpr int32_t kRowsAhead = static_cast<int32_t>(simd::kRowsAhead);
constexpr int32_t kMostRows = static_cast<int32_t>(simd::kMostRows);

class Strip {
 public:
  Strip(const simd::Kernels& kernels, const SliceStack& stack, const SlicePlane* planes,
        const CellPair* first, const CellPair* end, uint32_t* sums)
      : kernels_(kernels),
        stack_(stack),
        aperture_(stack.grid->aperture),
        planes_(planes),
        first_(first),
        end_(end),
        sums_(sums) {}

  // Composites one column of views at a time. Returns the number of pixels that were shifted.
  uint64_t Composite(uint8_t* memory, CancelToken* cancel) {
    FindRows();
    PlaceSlices(memory);
    for (int32_t i = -stack_.grid->n(); i <= stack_.grid->n(); ++i) {
      if (!GoesOn(cancel, samples_ * (2 * LastAcross(aperture_, i) + 1))) break;
      AddColumn(i);
    }
    return shifted_;
  }

 private:
  // Finds the slices that are visible in at least one cell pair, and the rows of these slices.
  // Clears the sums.
  void FindRows() {
    for (int32_t k = 0; k < stack_.count; ++k) rows_[k] = {0, 0};
    for (const CellPair* pair = first_; pair < end_; ++pair) {
      for (int32_t n = 0; n < pair->count; ++n) {
        Range& rows = rows_[pair->shown[n]];
        if (rows.last == 0) rows.first = pair->y;
        rows.last = pair->y + pair->rows;
      }
      const size_t sums = simd::kStripRow * static_cast<size_t>(pair->rows);
      samples_ += static_cast<int64_t>(sums) * pair->count;
      std::memset(SumsOfRow(sums_, pair->y), 0, sums * sizeof(*sums_));
    }
    for (int32_t k = 0; k < stack_.count; ++k) {
      if (rows_[k].last != 0) seen_slices_[seen_++] = k;
    }
  }

  // Allocates memory of the strip for the slices that are visible in the cell pairs.
  void PlaceSlices(uint8_t* memory) {
    for (int32_t n = 0; n < seen_; ++n) {
      const int32_t k = seen_slices_[n];
      const size_t rows = StripRows(static_cast<size_t>(planes_[k].rows));
      auto* const cover = reinterpret_cast<simd::RowCover*>(memory);
      const size_t covers = simd::RowCovers(rows);
      auto* const samples = reinterpret_cast<int16_t*>(cover + covers);
      shown_[k] = {samples, cover, covers};
      FindFilled(k);
      memory = reinterpret_cast<uint8_t*>(samples + rows * simd::kStripRow);
    }
  }

  // Finds the rows of slice k that are not empty in the strip. Clears the kRowsAhead rows before
  // and after them, because the kernel reads these rows and MoveSlice does not write them.
  void FindFilled(int32_t k) {
    const SlicePlane& placed = planes_[k];
    const uint64_t strips = StripsOf(placed, first_->x);
    int32_t first = rows_[k].first, end = rows_[k].last + 2 * placed.reach;
    const auto empty = [&](int32_t row) { return (placed.cover[row].some & strips) == 0; };
    while (first < end && empty(first)) ++first;
    while (end > first && empty(end - 1)) --end;
    filled_[k] = {first, end};
    const auto clear = [&](int32_t from, int32_t to) {
      std::memset(shown_[k].samples + static_cast<size_t>(from) * simd::kStripRow, 0,
                  static_cast<size_t>(to - from) * simd::kStripRow * sizeof(int16_t));
    };
    clear(Max(first - kRowsAhead, 0), first);
    clear(end, end + kRowsAhead);
  }

  // Adds all views (i, j) of column i.
  void AddColumn(int32_t i) {
    const int32_t last = LastAcross(aperture_, i);
    for (int32_t n = 0; n < seen_; ++n) MoveSlice(seen_slices_[n], i, last);
    for (int32_t begin = -last; begin <= last; begin += kViewsAtOnce) {
      const int32_t most = Min(begin + kViewsAtOnce - 1, last);
      for (int32_t first = begin; first <= most;) first = AddGroup(i, first, most);
    }
  }

  // Shifts slice k for column i of views, and writes the rows that views (i, -last) to (i, last)
  // show to the strip, except for empty rows above and below.
  void MoveSlice(int32_t k, int32_t i, int32_t last) {
    const SlicePlane& placed = planes_[k];
    const int32_t a = stack_.Offset(k, -last).whole, b = stack_.Offset(k, last).whole;
    const int32_t top = placed.reach + Min(a, b), bottom = placed.reach + Max(a, b) + kRowsAhead;
    const int32_t first = Max(rows_[k].first + top, filled_[k].first);
    const int32_t end = Min(rows_[k].last + bottom, filled_[k].last);
    const auto from = static_cast<size_t>(first);
    const simd::SliceRows rows = {
        placed.samples + from * 4 * placed.plane + first_->x + placed.reach, placed.plane,
        placed.cover + first, StripsOf(placed, first_->x), placed.subaperture <= kBoxSubaperture};
    shifted_ += PixelsIn(simd::kStripColumns, Max(end - first, 0));
    kernels_.ShiftSlice(rows, stack_.Offset(k, i), from, static_cast<size_t>(Max(first, end)),
                        shown_[k]);
  }

  // Adds the views (i, first) to (i, j) for the largest j <= most for which all weights have the
  // rank of the first (RankOf). In apertures with a steep fall-off, outer views weigh much less
  // than the middle view. If outer views were summed together with the middle view, the products of
  // outer weights with faint light would round to zero. Returns j + 1.
  int32_t AddGroup(int32_t i, int32_t first, int32_t most) {
    const auto rank_of = [&](int32_t j) {
      return RankOf(aperture_.Weight(i, j), stack_.largest_weight);
    };
    const int rank = rank_of(first);
    int32_t end = first + 1;
    while (end <= most && rank_of(end) == rank) ++end;
    if (rank == kNoLight) return end;
    const uint64_t sum = (GroupSum(aperture_, i, first, end - 1) * stack_.weight_scale) >> 16;
    // The weights are divided into equal portions, none of which exceeds the limit of the kernel.
    const uint64_t portions = sum <= kGroupSum ? 1 : (sum + kGroupSum - 1) / kGroupSum;
    // Small weights get extra fractional bits, unless a whole column fits in one group and the
    // first weight is more than 1/16 of the largest weight.
    const bool is_small = rank > 0 || 2 * aperture_.last >= kViewsAtOnce;
    int extra_bits = 0;
    while (is_small && extra_bits < kMostExtraBits && sum << (extra_bits + 1) <= kGroupSum) {
      ++extra_bits;
    }
    for (uint64_t portion = 0; portion < portions; ++portion) {
      for (int32_t j = first; j < end; ++j) {
        const uint64_t weight =
            (aperture_.Weight(i, j) * (stack_.weight_scale << extra_bits)) >> 16;
        weights_[j - first] =
            static_cast<int16_t>(weight * (portion + 1) / portions - weight * portion / portions);
      }
      AddViews({first, end}, extra_bits);
    }
    return end;
  }

  // Adds the views [rows.first, rows.last) of a column with the weights `weights_`, to at most
  // kMostRows rows at a time. The sums of gathered cells between cell pairs are meaningless.
  void AddViews(const Range& rows, int extra_bits) {
    for (const CellPair *pair = first_, *next; pair < end_; pair = next) {
      next = pair + 1;
      while (next < end_ && next->y + next->rows - pair->y <= kMostRows) ++next;
      simd::SeenSlice seen[kMaxSlices];
      const size_t count = FindSeen(pair, next, seen);
      const simd::SliceViews views = {weights_,
                                      &stack_.Offset(0, rows.first),
                                      static_cast<size_t>(rows.last - rows.first),
                                      static_cast<size_t>(stack_.count),
                                      seen,
                                      count,
                                      extra_bits};
      kernels_.Composite(views, static_cast<size_t>(next[-1].y + next[-1].rows - pair->y),
                         SumsOfRow(sums_, pair->y));
    }
  }

  // Finds the slices that are visible in the cell pairs [first, end), from the nearest to the
  // farthest. Returns their number.
  size_t FindSeen(const CellPair* first, const CellPair* end, simd::SeenSlice* seen) const {
    uint32_t rows[kMaxSlices] = {};
    for (const CellPair* pair = first; pair < end; ++pair) {
      const uint32_t bits = (uint32_t{2} << (pair->rows - 1)) - 1;
      for (int32_t n = 0; n < pair->count; ++n)
        rows[pair->shown[n]] |= bits << (pair->y - first->y);
    }
    size_t count = 0;
    for (int32_t n = 0; n < seen_; ++n) {
      const int32_t k = seen_slices_[n];
      if (rows[k] == 0) continue;
      seen[count++] = {shown_[k], static_cast<size_t>(first->y + planes_[k].reach),
                       static_cast<size_t>(k), rows[k]};
    }
    return count;
  }

  const simd::Kernels& kernels_;
  const SliceStack& stack_;
  const ViewWeights& aperture_;
  const SlicePlane* const planes_;
  const CellPair *const first_, *const end_;
  uint32_t* const sums_;
  int16_t weights_[kViewsAtOnce];  // weights of the current group of views
  int64_t samples_ = 0;  // samples composited in one view, four per pixel, summed over all slices
  uint64_t shifted_ = 0;
  int32_t seen_ = 0;
  int32_t seen_slices_[kMaxSlices];
  Range rows_[kMaxSlices];    // For each slice, the rows of the cell pairs that show the slice.
  Range filled_[kMaxSlices];  // For each slice, the rows outside which it is empty in all views.
  simd::StripSlice shown_[kMaxSlices];  // The slices, shifted for the current column of views.
};

}  // namespace

uint64_t CompositeStrip(const simd::Kernels& kernels, const SliceStack& stack,
                        const SlicePlane* planes, const CellPair* first, const CellPair* end,
                        int16_t* memory, uint32_t* sums, CancelToken* cancel) {
  return Strip(kernels, stack, planes, first, end, sums)
      .Composite(reinterpret_cast<uint8_t*>(memory), cancel);
}

}  // namespace starfocus
