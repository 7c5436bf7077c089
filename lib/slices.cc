#include "lib/slices.h"

#include <cstring>

#include "lib/placed_slice.h"

namespace starfocus {
namespace {

constexpr int kOverlapParts = 10;  // of a slice's range

class SliceFinder {
 public:
  explicit SliceFinder(const SliceJob& job)
      : job_(job), surfaces_(*job.surfaces), grid_(*job.grid) {
    const int64_t step = grid_.step > 0 ? grid_.step : 1;
    constexpr int kBits = kStepBits + kDisparityBits - kShiftBits;
    range_ = static_cast<int32_t>(Limited((int64_t{job.rule.range} << kBits) / step));
    for (int32_t d = 0; d < Max(surfaces_.width, surfaces_.height); ++d) {
      job_.least_blur[d] = static_cast<int32_t>(
          Limited((int64_t{Max(d - 1, 0)} << (kStepBits + kDisparityBits)) / step));
    }
  }

  int32_t Find(Slice* slices) {
    FindBase();
    std::memset(job_.bins, 0, static_cast<size_t>(bins_));
    for (int32_t y = 0; y < surfaces_.height; ++y) Mark(y);
    for (int coarser = 0;; ++coarser) {
      const int32_t count = Cut(coarser, slices);
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

  // Marks the bins of a row's pixels that may splat into the rect.
  void Mark(int32_t y) {
    const Rect& rect = job_.rect;
    const int32_t right = rect.x + rect.width - 1, bottom = rect.y + rect.height - 1;
    const int32_t dy = Max(Max(rect.y - y, y - bottom), 0);
    for (int surface = 0; surface < simd::kSurfaces; ++surface) {
      const int16_t* row = surfaces_.disparity[surface] + surfaces_.At(0, y);
      if (surface > 0 && surfaces_.hiding[y] == 0) return;
      const auto mark = [&](int32_t x, int32_t distance) {
        const int32_t disparity = row[x];
        if (surface > 0 && disparity == kNoSurface) return;
        uint8_t& bin = job_.bins[(disparity - base_) >> bin_bits_];
        if (bin != 0) return;
        if (Abs(disparity - grid_.focus) >= job_.least_blur[distance]) bin = 1;
      };
      for (int32_t x = 0; x < rect.x; ++x) mark(x, Max(rect.x - x, dy));
      for (int32_t x = rect.x; x <= right; ++x) mark(x, dy);
      for (int32_t x = right + 1; x < surfaces_.width; ++x) mark(x, Max(x - right, dy));
    }
  }

  // Bins that a slice with this nearest bin may span.
  int32_t Span(int32_t bin, int coarser) const {
    const int32_t blur = Abs(grid_.Shift(grid_.step, base_ + (bin << bin_bits_)));
    const int64_t wider = Max(kSliceSharp, blur - kSliceSharp);
    const int64_t bins = (wider * range_ / kSliceSharp) >> bin_bits_;
    return static_cast<int32_t>(Limited(bins << coarser));
  }

  // Pixels beyond the rectangle.
  int32_t Reach(int16_t disparity) const {
    return SliceReach(Abs(grid_.Shift(grid_.Move(grid_.n()), disparity)));
  }

  // 0: too many, or too large.
  int32_t Cut(int coarser, Slice* slices) const {
    int32_t count = 0;
    size_t samples = 0, rows = 0;
    for (int32_t bin = bins_ - 1; bin >= 0; --bin) {
      if (job_.bins[bin] == 0) continue;
      if (count == job_.rule.most) return 0;
      const int32_t span = Span(bin, coarser), top = bin;
      int32_t bottom = bin;
      for (; bin > Max(top - span, -1); --bin) {
        if (job_.bins[bin] != 0) bottom = bin;
      }
      ++bin;
      Slice& slice = slices[count++];
      const int32_t low = base_ + (bottom << bin_bits_);
      const int32_t high = base_ + ((top + 1) << bin_bits_) - 1;
      slice.low = static_cast<int16_t>(low);
      slice.high = static_cast<int16_t>(Min(high, INT16_MAX));
      slice.overlap =
          static_cast<int16_t>(Min(high + (span << bin_bits_) / kOverlapParts, INT16_MAX));
      slice.disparity = static_cast<int16_t>(low + (slice.high - low) / 2);
      const auto reach = static_cast<size_t>(Reach(slice.disparity));
      const auto height = static_cast<size_t>(job_.rect.height);
      samples += SliceSize(static_cast<size_t>(job_.rect.width), height, reach);
      rows += ShiftedRows(height, reach);
      if (samples > job_.samples || rows > job_.tile_rows) return 0;
    }
    return count;
  }

  const SliceJob& job_;
  const Surfaces& surfaces_;
  const ViewGrid& grid_;
  int32_t range_;         // of the rule, as a disparity
  int32_t bin_bits_ = 0;  // disparities of a bin
  int32_t base_ = 0, bins_ = 0;
};

}  // namespace

int32_t FindSlices(const SliceJob& job, Slice* slices) { return SliceFinder(job).Find(slices); }

}  // namespace starfocus
