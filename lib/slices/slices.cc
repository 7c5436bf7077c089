// SPDX-License-Identifier: Apache-2.0
// Divides the surfaces of a bucket into slices.
#include <cstring>

#include "lib/slices/slice_plane.h"

namespace starfocus {
namespace {

// Slices overlap by 1 / kOverlapParts of their range, so that no gap opens between two slices of
// one slanted surface. The page docs/constants.md compares this overlap with no overlap, half the
// overlap and twice the overlap.
constexpr int kOverlapParts = 10;

// Calls act(rows) for each run of rows in [rows.first, rows.last) that have disparities of a
// surface. Rows without hidden surfaces have only disparities of the first surface.
template <class Act>
void ForEachRun(const LayeredDepth& surfaces, int surface, const Range& rows, const Act& act) {
  const auto has = [&](int32_t y) { return surface == 0 || surfaces.hiding[y] != 0; };
  for (int32_t y = rows.first, end; y < rows.last; y = end) {
    end = y + 1;
    if (!has(y)) continue;
    while (end < rows.last && has(end)) ++end;
    act(Range{y, end});
  }
}

// Finds the slices of a bucket from the disparities of the surfaces around the bucket.
class SliceFinder {
 public:
  SliceFinder(const simd::Kernels& kernels, const LayeredDepth& surfaces, const ViewGrid& grid,
              const SliceRule& rule, const Rect& bucket)
      : kernels_(kernels), surfaces_(surfaces), grid_(grid), rule_(rule), bucket_(bucket) {
    const int64_t step = grid_.step > 0 ? grid_.step : 1;
    constexpr int kBits = kStepBits + kDisparityBits - kShiftBits;
    range_ = static_cast<int32_t>(Limited((int64_t{rule.range} << kBits) / step));
    FindAround();
    for (int32_t d = 0; d < Max(around_.width, around_.height); ++d) {
      surfaces_.least_blur[d] = static_cast<int32_t>(
          Limited((int64_t{Max(d - 1, 0)} << (kStepBits + kDisparityBits)) / step));
    }
  }

  int32_t Find(Slice* slices) {
    FindBase();
    std::memset(surfaces_.bins, 0, static_cast<size_t>(bins_));
    for (int surface = 0; surface < simd::kSurfaces; ++surface) Mark(surface);
    for (int coarser = 0;; ++coarser) {
      const int32_t count = Part(coarser, slices);
      if (count > 0) return count;
    }
  }

 private:
  static int64_t Limited(int64_t disparity) {
    constexpr int64_t kMost = 1 << 20;
    return disparity < kMost ? disparity : kMost;
  }

  void FindBase() {
    const int32_t range = surfaces_.high - surfaces_.low;
    base_ = surfaces_.low;
    while (range >> bin_bits_ >= kSliceBins) ++bin_bits_;
    bins_ = (range >> bin_bits_) + 1;
  }

  // Finds the rectangle of the surfaces from which pixels may splat into the bucket. The rectangle
  // starts at the first row of a group of rows and at the first column of a strip.
  void FindAround() {
    const int64_t move = grid_.Move(grid_.n());
    const int32_t rim =
        Max(Abs(grid_.Shift(move, surfaces_.low)), Abs(grid_.Shift(move, surfaces_.high)));
    const int32_t reach = SliceReach(rim, kWidestSubaperture) + 1;
    around_.x = Max(bucket_.x - reach, 0) / simd::kStripColumns * simd::kStripColumns;
    around_.y = Max(bucket_.y - reach, 0) / kRangeRows * kRangeRows;
    around_.width = Min(bucket_.x + bucket_.width + reach, surfaces_.width) - around_.x;
    around_.height = Min(bucket_.y + bucket_.height + reach, surfaces_.height) - around_.y;
  }

  // Marks the bins of all pixels of a surface that may splat into the bucket.
  void Mark(int surface) {
    const int32_t right = around_.x + around_.width, last = around_.y + around_.height;
    for (int32_t y = around_.y; y < last; y += kRangeRows) {
      const simd::DisparityRange* range = surfaces_.RangesAt(surface, around_.x, y);
      for (int32_t x = around_.x; x < right; x += simd::kStripColumns, ++range) {
        if (range->low > range->high) continue;
        const Rect pixels = {x, y, Min(simd::kStripColumns, right - x), Min(kRangeRows, last - y)};
        const int32_t least = surfaces_.least_blur[Beyond(pixels)];
        if (least == 0) {
          MarkPixels(surface, pixels, range->low, range->high);
        } else {  // skips pixels that are too sharp to reach the bucket
          MarkPixels(surface, pixels, range->low, Min(range->high, grid_.focus.far - least));
          MarkPixels(surface, pixels, Max(range->low, grid_.focus.far + least), range->high);
        }
      }
    }
  }

  // Marks the bins of the pixels whose disparities lie in [low, high]. Returns early if all of
  // these bins are marked, which is the most frequent case.
  void MarkPixels(int surface, const Rect& pixels, int32_t low, int32_t high) {
    if (low > high) return;
    const uint8_t *first = surfaces_.bins + BinOf(low), *last = surfaces_.bins + BinOf(high);
    first =
        static_cast<const uint8_t*>(std::memchr(first, 0, static_cast<size_t>(last + 1 - first)));
    if (first == nullptr) return;
    while (*last != 0) --last;
    const simd::DisparityRange range = {static_cast<int16_t>(Max(low, LowOf(first))),
                                        static_cast<int16_t>(Min(high, LowOf(last + 1) - 1))};
    ForEachRun(surfaces_, surface, {pixels.y, pixels.y + pixels.height}, [&](const Range& rows) {
      MarkRows(surface, {pixels.x, rows.first, pixels.width, rows.last - rows.first}, range);
    });
  }

  // Marks the bins of the pixels whose disparities lie in `range`.
  void MarkRows(int surface, const Rect& pixels, const simd::DisparityRange& range) {
    const int16_t* disparity = surfaces_.disparity[surface] + surfaces_.At(pixels.x, pixels.y);
    uint16_t within[kRangeRows];
    kernels_.FindWithin(disparity, static_cast<size_t>(surfaces_.stride),
                        static_cast<size_t>(pixels.height), range, within);
    // Members are copied to local variables, because the compiler must assume that a write to
    // `bins` may change any member.
    uint8_t* const bins = surfaces_.bins;
    const int32_t* const least_blur = surfaces_.least_blur;
    const int32_t base = base_, bits = bin_bits_, focus = grid_.focus.far;
    const int32_t left = bucket_.x - pixels.x, right = left + bucket_.width - 1;
    for (int32_t y = 0; y < pixels.height; ++y, disparity += surfaces_.stride) {
      const int32_t in_column = Beyond({bucket_.x, pixels.y + y, 1, 1});
      ForEachBit(within[y], [=](int32_t k) {
        uint8_t& mark = bins[(disparity[k] - base) >> bits];
        if (mark != 0) return;
        const int32_t beyond = Max(in_column, Max(left - k, k - right));
        if (Abs(disparity[k] - focus) >= least_blur[beyond]) mark = 1;
      });
    }
  }

  // Returns the lowest disparity of a bin.
  int32_t LowOf(const uint8_t* bin) const {
    return base_ + (static_cast<int32_t>(bin - surfaces_.bins) << bin_bits_);
  }

  int32_t BinOf(int32_t disparity) const { return (disparity - base_) >> bin_bits_; }

  // Returns the distance in pixels from the bucket to the nearest pixel of `pixels`; 0 if `pixels`
  // touches the bucket.
  int32_t Beyond(const Rect& pixels) const {
    const int32_t x =
        Max(bucket_.x - (pixels.x + pixels.width - 1), pixels.x - (bucket_.x + bucket_.width - 1));
    const int32_t y = Max(bucket_.y - (pixels.y + pixels.height - 1),
                          pixels.y - (bucket_.y + bucket_.height - 1));
    return Max(Max(x, y), 0);
  }

  // Returns the number of bins that a slice may cover if `bin` is its nearest bin.
  int32_t Thickness(int32_t bin, int coarser) const {
    const int32_t blur = Abs(grid_.Shift(grid_.step, base_ + (bin << bin_bits_)));
    const int64_t wider = Max(kSliceSharp, blur - kSliceSharp);
    const int64_t bins = (wider * range_ / kSliceSharp) >> bin_bits_;
    return static_cast<int32_t>(Limited(bins << coarser));
  }

  // Divides the disparity bins into slices, each 2^coarser times as thick as SliceRule::range.
  // Returns the number of slices, or 0 if the slices exceed a limit of SliceRule.
  int32_t Part(int coarser, Slice* slices) const {
    int32_t count = 0;
    int32_t area = 0;
    for (int32_t bin = bins_ - 1; bin >= 0; --bin) {
      if (surfaces_.bins[bin] == 0) continue;
      if (count == rule_.most) return 0;
      const int32_t thickness = Thickness(bin, coarser), top = bin;
      int32_t bottom = bin;
      for (; bin > Max(top - thickness, -1); --bin) {
        if (surfaces_.bins[bin] != 0) bottom = bin;
      }
      ++bin;
      Slice& slice = slices[count++];
      const int32_t low = base_ + (bottom << bin_bits_);
      const int32_t high = base_ + ((top + 1) << bin_bits_) - 1;
      slice.low = static_cast<int16_t>(low);
      slice.high = static_cast<int16_t>(Min(high, INT16_MAX));
      slice.overlap =
          static_cast<int16_t>(Min(high + (thickness << bin_bits_) / kOverlapParts, INT16_MAX));
      slice.disparity = static_cast<int16_t>(low + (slice.high - low) / 2);
      SlicePlane placed;
      PlaceSlice(grid_, slice.disparity, bucket_, &placed);
      area += SliceArea(placed.reach);
      if (area > rule_.area) return 0;
    }
    return count;
  }

  const simd::Kernels& kernels_;
  const LayeredDepth& surfaces_;
  const ViewGrid& grid_;
  const SliceRule& rule_;
  const Rect& bucket_;
  int32_t range_;         // SliceRule::range, converted to a range of disparities.
  Rect around_;           // Region to search, in pixels of the surfaces.
  int32_t bin_bits_ = 0;  // log2 of the number of disparities in a bin.
  int32_t base_ = 0, bins_ = 0;
};

}  // namespace

int32_t FindSlices(const simd::Kernels& kernels, const LayeredDepth& surfaces, const ViewGrid& grid,
                   const SliceRule& rule, const Rect& bucket, Slice* slices) {
  return SliceFinder(kernels, surfaces, grid, rule, bucket).Find(slices);
}

void FindStripRanges(const simd::Kernels& kernels, const LayeredDepth& surfaces) {
  const auto width = static_cast<size_t>(surfaces.width);
  const auto stride = static_cast<size_t>(surfaces.stride);
  for (int surface = 0; surface < simd::kSurfaces; ++surface) {
    for (int32_t y = 0; y < surfaces.height; y += kRangeRows) {
      simd::DisparityRange* const ranges = surfaces.RangesAt(surface, 0, y);
      bool first = true;
      ForEachRun(surfaces, surface, {y, Min(y + kRangeRows, surfaces.height)},
                 [&](const Range& rows) {
                   simd::DisparityRange found[kMaxStrips];
                   kernels.FindRanges(surfaces.disparity[surface] + surfaces.At(0, rows.first),
                                      stride, static_cast<size_t>(rows.last - rows.first), width,
                                      first ? ranges : found);
                   for (size_t strip = 0; !first && strip < stride / simd::kSliceLanes; ++strip) {
                     Widen(found[strip], &ranges[strip]);
                   }
                   first = false;
                 });
      if (!first) continue;
      for (size_t strip = 0; strip < stride / simd::kSliceLanes; ++strip) {
        ranges[strip] = {INT16_MAX, INT16_MIN};
      }
    }
  }
}

}  // namespace starfocus
