#include "lib/stack.h"

#include <cstring>

#include "lib/matte.h"

namespace starfocus {
namespace {

// A pixel of which slices cover less than this part of all views' light is not made of them: what
// rounding adds would show.
constexpr uint32_t kLeastShare = 4;

// What weights of a group of views are together: in 16 bits with room for a ninth more, which the
// share of the last light may be too large by, and for the rounding of each slice.
constexpr uint32_t kGroupSum = 58000;

constexpr int32_t kChunk = static_cast<int32_t>(simd::kSliceLanes);  // columns of a tile

class Stack {
 public:
  Stack(const StarJob& job, const SliceRule& rule, const GatherMap* gathered, Field* field,
        StackScratch* scratch, uint32_t* accumulators)
      : job_(job),
        rule_(rule),
        gathered_(gathered),
        grid_(*job.grid),
        field_(*field),
        scratch_(*scratch),
        accumulators_(accumulators) {}

  uint64_t Refocus() {
    LoadField(*job_.window, job_.rect, job_.border, &field_);
    FindSurfaces(*job_.kernels, *job_.window, field_, &scratch_.surfaces);
    FindMatte(*job_.kernels, *job_.window, grid_, field_, &scratch_.surfaces);
    FindScale();
    PlaceSlices();
    const uint64_t pixels = FindParts();
    const size_t samples = kPixelSums * static_cast<size_t>(kChunk * job_.rect.height);
    const StackPart *part = scratch_.parts, *last = part + parts_;
    for (int32_t x = 0; x < job_.rect.width; x += kChunk) {
      std::memset(scratch_.sums, 0, samples * sizeof(*scratch_.sums));
      tile_.x = x;
      tile_.first = part;
      while (part < last && part->x == x) ++part;
      tile_.end = part;
      if (tile_.first < tile_.end) AddTile();
      FinishTile();
    }
    return pixels;
  }

 private:
  uint32_t Weight(int32_t i, int32_t j) const { return grid_.aperture.Weight(i, j); }

  // Largest j of the views (i, j).
  int32_t LastAcross(int32_t i) const {
    const int32_t n = grid_.n();
    int32_t j = n;
    while (i * i + j * j > n * n) --j;
    return j;
  }

  // Weights are scaled so that those of a group are at most kGroupSum together, and each of them a
  // quarter of it.
  void FindScale() {
    uint32_t largest = 0;
    for (int32_t i = 0; i <= grid_.n(); ++i) {
      const int32_t last = LastAcross(i);
      for (int32_t first = -last; first <= last; first += kGroupViews) {
        uint32_t sum = 0, most = 0;
        for (int32_t j = first; j <= Min(first + kGroupViews - 1, last); ++j) {
          sum += Weight(i, j);
          most = Weight(i, j) > most ? Weight(i, j) : most;
        }
        sum = 4 * most > sum ? 4 * most : sum;
        largest = sum > largest ? sum : largest;
      }
    }
    weight_scale_ = (uint64_t{kGroupSum} << 16) / largest;
    least_covered_ =
        static_cast<uint32_t>(((weight_scale_ << grid_.aperture.sum_bits) >> 16) / kLeastShare);
  }

  void PlaceSlices() {
    const Rect& inner = field_.inner;
    const SliceJob job = {job_.kernels,
                          &scratch_.surfaces,
                          &grid_,
                          rule_,
                          inner,
                          scratch_.bins,
                          scratch_.least_blur,
                          scratch_.plane_samples,
                          scratch_.tile_rows};
    Slice slices[kMaxSlices];
    count_ = FindSlices(job, slices);
    int16_t* samples = scratch_.planes;
    const int32_t views = 2 * grid_.n() + 1;
    for (int32_t k = 0; k < count_; ++k) {
      PlacedSlice& placed = placed_[k];
      placed.cover = scratch_.covers + k * scratch_.cover_rows;
      placed.offsets = scratch_.offsets + k * views + grid_.n();
      placed.samples = samples + kChunk;
      PlaceSlice(grid_, slices[k].disparity, inner, &placed);
      FillSlice(*job_.kernels, scratch_.surfaces, slices[k], inner, scratch_.filtered, placed);
      samples += SliceSize(static_cast<size_t>(inner.width), static_cast<size_t>(inner.height),
                           static_cast<size_t>(placed.reach));
    }
  }

  // Of one slice, whose cell makes the rest of the fraction.
  static bool Same(const SliceOffset& a, const SliceOffset& b) {
    return a.whole == b.whole && a.fraction.edge == b.fraction.edge;
  }

  bool IsGathered(const StackPart& part) const {
    if (gathered_ == nullptr) return false;
    const int32_t right = Min(job_.rect.x + part.x + kChunk, job_.rect.x + job_.rect.width);
    for (int32_t y = part.y; y < part.y + part.rows; y += kCellSize) {
      for (int32_t x = job_.rect.x + part.x; x < right; x += kCellSize) {
        if (gathered_->At(x, job_.rect.y + y) == 0) return false;
      }
    }
    return true;
  }

  // What each part of the rectangle sees of the slices. Returns their pixels.
  uint64_t FindParts() {
    static_assert(kPartRows == kCellSize && kChunk % kCellSize == 0, "parts are whole cells");
    parts_ = 0;
    uint64_t pixels = 0;
    for (int32_t x = 0; x < job_.rect.width; x += kChunk) {
      for (int32_t y = 0; y < job_.rect.height; y += kPartRows) {
        StackPart& part = scratch_.parts[parts_];
        part = {x, y, Min(kPartRows, job_.rect.height - y), 0, {}};
        if (IsGathered(part)) continue;
        ++parts_;
        for (int32_t k = 0; k < count_; ++k) {
          const simd::SliceCover cover = CoverOf(placed_[k], part);
          if (cover.some != 0) part.shown[part.count++] = static_cast<uint8_t>(k);
          if (cover.all != 0) break;
        }
        pixels += static_cast<uint64_t>(part.count) *
                  static_cast<uint64_t>(part.rows * Min(kChunk, job_.rect.width - x));
      }
    }
    return pixels;
  }

  // Whether some, or all, of the slice's pixels that a part may see in any view are covered.
  static simd::SliceCover CoverOf(const PlacedSlice& placed, const StackPart& part) {
    const uint64_t chunks = ChunksOf(placed, part.x);
    simd::SliceCover cover = {0, chunks};
    for (int32_t row = part.y; row < part.y + part.rows + 2 * placed.reach; ++row) {
      cover.some |= placed.cover[row].some;
      cover.all &= placed.cover[row].all;
    }
    return {cover.some & chunks, cover.all == chunks ? uint64_t{1} : 0};
  }

  // What of the slices is seen in the tile, and all views of it.
  void AddTile() {
    uint32_t seen = 0;
    for (const StackPart* part = tile_.first; part < tile_.end; ++part) {
      for (int32_t k = 0; k < part->count; ++k) seen |= uint32_t{1} << part->shown[k];
    }
    const StackPart& bottom = tile_.end[-1];
    int16_t* samples = scratch_.tile;
    uint8_t* near = scratch_.tile_near + simd::kRowsAhead;
    tile_.count = 0;
    for (int32_t k = 0; k < count_; ++k) {
      if ((seen >> k & 1) == 0) continue;
      tile_.slices[tile_.count++] = k;
      shifted_[k].samples = samples;
      shifted_[k].near = near;
      PlaceTile(placed_[k], tile_.x, tile_.first->y, bottom.y + bottom.rows, &shifted_[k]);
      samples += 4 * shifted_[k].plane;
      near += shifted_[k].plane / kChunk;
    }
    FindShifts();
    for (int32_t i = -grid_.n(); i <= grid_.n(); ++i) AddColumn(i);
  }

  // Where views (., j) show the tile's slices.
  void FindShifts() {
    simd::SliceShift* shifts = scratch_.shifts;
    for (int32_t j = -grid_.n(); j <= grid_.n(); ++j, shifts += count_) {
      for (int32_t n = 0; n < tile_.count; ++n) {
        const int32_t k = tile_.slices[n];
        const SliceOffset& offset = placed_[k].offsets[j];
        const int32_t row = placed_[k].reach + offset.whole;
        shifts[k] = {shifted_[k].samples + row * kChunk, shifted_[k].near + row, shifted_[k].plane,
                     offset.fraction};
      }
    }
  }

  // Views (i, j) of all j.
  void AddColumn(int32_t i) {
    for (int32_t n = 0; n < tile_.count; ++n) {
      const PlacedSlice& placed = placed_[tile_.slices[n]];
      if (i > -grid_.n() && Same(placed.offsets[i], placed.offsets[i - 1])) continue;
      ShiftSlice(*job_.kernels, placed, placed.offsets[i], tile_.x, shifted_[tile_.slices[n]]);
    }
    const int32_t last = LastAcross(Abs(i));
    for (int32_t first = -last; first <= last; first += kGroupViews) {
      AddGroup(i, first, Min(first + kGroupViews - 1, last));
    }
  }

  // Views (i, first) to (i, last).
  void AddGroup(int32_t i, int32_t first, int32_t last) {
    for (int32_t j = first; j <= last; ++j) {
      scratch_.weights[j - first] = static_cast<int16_t>((Weight(i, j) * weight_scale_) >> 16);
    }
    const simd::SliceShift* shifts = scratch_.shifts + (first + grid_.n()) * count_;
    const auto views = static_cast<size_t>(last + 1 - first);
    for (const StackPart* part = tile_.first; part < tile_.end; ++part) {
      AddPart(shifts, views, *part);
    }
  }

  void AddPart(const simd::SliceShift* shifts, size_t views, const StackPart& part) {
    const simd::SliceViews job = {scratch_.weights,
                                  shifts,
                                  views,
                                  static_cast<size_t>(count_),
                                  part.shown,
                                  static_cast<size_t>(part.count),
                                  static_cast<size_t>(part.y)};
    job_.kernels->composite(job, static_cast<size_t>(part.rows),
                            scratch_.sums + kPixelSums * static_cast<size_t>(part.y * kChunk));
  }

  // What no slice covers is as what covers the rest. A pixel that hardly any view shows is that of
  // the centre view.
  void FinishTile() {
    const simd::StackFinish finish = {least_covered_, grid_.aperture.sum_bits};
    const auto columns = static_cast<size_t>(Min(kChunk, job_.rect.width - tile_.x));
    for (int32_t y = 0; y < job_.rect.height; ++y) {
      const auto at = static_cast<size_t>(y * job_.rect.width + tile_.x);
      job_.kernels->finish_stack(scratch_.sums + kPixelSums * static_cast<size_t>(y * kChunk),
                                 simd::kSliceLanes,
                                 field_.Rgb(field_.inner.x + tile_.x, field_.inner.y + y), finish,
                                 columns, accumulators_ + 3 * at);
    }
  }

  const StarJob& job_;
  const SliceRule rule_;
  const GatherMap* gathered_;
  const ViewGrid& grid_;
  Field& field_;
  StackScratch& scratch_;
  uint32_t* accumulators_;
  PlacedSlice placed_[kMaxSlices];
  ShiftedSlice shifted_[kMaxSlices];  // of the tile and the column of views under way
  struct Tile {
    int32_t x;  // in the rectangle
    const StackPart *first, *end;
    int32_t slices[kMaxSlices];  // that are seen
    int32_t count;
  } tile_;
  int32_t count_ = 0;
  int32_t parts_ = 0;
  uint64_t weight_scale_ = 0;  // 16 bits
  uint32_t least_covered_ = 0;
};

}  // namespace

uint64_t RefocusStack(const StarJob& job, const SliceRule& rule, const GatherMap* gathered,
                      Field* field, StackScratch* scratch, uint32_t* accumulators) {
  return Stack(job, rule, gathered, field, scratch, accumulators).Refocus();
}

}  // namespace starfocus
