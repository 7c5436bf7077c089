#include "lib/slices/compositor.h"

#include <cstring>

#include "lib/input/load_field.h"
#include "lib/slices/matte.h"

namespace starfocus {
namespace {

// A pixel of which slices cover less than this part of all views' light is not made of them: what
// rounding adds would show. Scenes hardly have any, whatever the part (docs/constants.md).
constexpr uint32_t kLeastShare = 4;

// What weights of a group of views are together: in 16 bits with room for a ninth more, which the
// share of the last light may be too large by, and for the rounding of each slice.
constexpr uint32_t kGroupSum = 58000;

constexpr int32_t kChunk = static_cast<int32_t>(simd::kSliceLanes);  // columns of a tile
constexpr int32_t kRowsAhead = static_cast<int32_t>(simd::kRowsAhead);

class Compositor {
 public:
  Compositor(const RenderJob& job, const SliceRule& rule, const SliceLimits& limits,
             const GatherMap* gathered, CompositorScratch* scratch, uint32_t* accumulators)
      : job_(job),
        rule_(rule),
        limits_(limits),
        gathered_(gathered),
        grid_(*job.grid),
        scratch_(*scratch),
        accumulators_(accumulators) {}

  uint64_t Refocus() {
    FindScale();
    LoadSurfaces();
    CutSlices();
    const Section largest = ChooseSection();
    uint64_t pixels = 0;
    for (int32_t y = 0; y < job_.rect.height; y += largest.height) {
      for (int32_t x = 0; x < job_.rect.width; x += largest.width) {
        section_ = {x, y, Min(largest.width, job_.rect.width - x),
                    Min(largest.height, job_.rect.height - y)};
        pixels += RefocusSection();
      }
    }
    return pixels;
  }

 private:
  using Section = Rect;  // a part of the rectangle, of which slices are in memory

  uint32_t Weight(int32_t i, int32_t j) const { return grid_.aperture.Weight(i, j); }

  // Largest j of the views (i, j).
  int32_t LastAcross(int32_t i) const {
    int32_t j = grid_.n();
    while (i * i + j * j > grid_.aperture.most) --j;
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

  void LoadSurfaces() {
    Field field;
    field.rgb = scratch_.field_rgb;
    field.disparity = scratch_.field_disparity;
    LoadField(*job_.window, job_.rect, job_.border, &field);
    FindLayeredDepth(*job_.kernels, *job_.window, field, &scratch_.surfaces);
    FindMatte(*job_.kernels, *job_.window, grid_, field, &scratch_.surfaces);
    inner_ = field.inner;
    const size_t row = 3 * static_cast<size_t>(inner_.width);
    for (int32_t y = 0; y < inner_.height; ++y) {
      std::memcpy(scratch_.centre + static_cast<size_t>(y) * row, field.Rgb(inner_.x, inner_.y + y),
                  row);
    }
  }

  void CutSlices() {
    const SliceJob job = {job_.kernels,  &scratch_.surfaces,  &grid_, rule_, inner_,
                          scratch_.bins, scratch_.least_blur, limits_};
    count_ = FindSlices(job, slices_);
    for (int32_t k = 0; k < count_; ++k) {
      FindOffsets(grid_, slices_[k].disparity, static_cast<size_t>(count_), scratch_.offsets + k);
    }
  }

  // Of slice k, in views (i, .) or (., i).
  const simd::SliceOffset& Offset(int32_t k, int32_t i) const {
    return scratch_.offsets[(i + grid_.n()) * count_ + k];
  }

  // The largest section of which all slices fit into the pool, by halving the rectangle.
  Section ChooseSection() const {
    Section section = {0, 0, job_.rect.width, job_.rect.height};
    const auto half = [](int32_t side, int32_t least) {
      return ((side + 1) / 2 + least - 1) / least * least;
    };
    while (PoolBytes(section) > scratch_.pool_bytes) {
      const bool least_rows = section.height <= kLeastRows;
      if (section.width > kLeastColumns && (least_rows || section.width >= section.height)) {
        section.width = half(section.width, kLeastColumns);
      } else {
        section.height = half(section.height, kLeastRows);
      }
    }
    return section;
  }

  size_t PoolBytes(const Section& section) const {
    const auto width = static_cast<size_t>(section.width);
    const auto height = static_cast<size_t>(section.height);
    size_t bytes = 0;
    for (int32_t k = 0; k < count_; ++k) {
      SlicePlane placed;
      PlaceSlice(grid_, slices_[k].disparity, section, &placed);
      const auto reach = static_cast<size_t>(placed.reach);
      bytes += SliceBytes(width, height, reach) + TileBytes(height, reach);
    }
    return bytes;
  }

  uint64_t RefocusSection() {
    PlaceSlices();
    const uint64_t pixels = FindParts();
    const SectionPart *part = scratch_.parts, *last = part + parts_;
    for (int32_t x = 0; x < section_.width; x += kChunk) {
      tile_.x = x;
      tile_.first = part;
      while (part < last && part->x == x) ++part;
      tile_.end = part;
      if (tile_.first < tile_.end) AddTile();
      FinishTile();
    }
    return pixels;
  }

  // Makes them of the section, one behind the other in the pool.
  void PlaceSlices() {
    const Rect rect = {inner_.x + section_.x, inner_.y + section_.y, section_.width,
                       section_.height};
    uint8_t* next = scratch_.pool;
    for (int32_t k = 0; k < count_; ++k) {
      SlicePlane& placed = placed_[k];
      PlaceSlice(grid_, slices_[k].disparity, rect, &placed);
      const auto rows = static_cast<size_t>(placed.rows);
      placed.cover = reinterpret_cast<simd::SliceCover*>(next);
      placed.samples = reinterpret_cast<int16_t*>(next + CoverBytes(rows)) + kChunk;
      FillSlice(*job_.kernels, scratch_.surfaces, slices_[k], rect, scratch_.filtered, placed);
      next += SliceBytes(static_cast<size_t>(rect.width), static_cast<size_t>(rect.height),
                         static_cast<size_t>(placed.reach));
    }
    tile_.memory = reinterpret_cast<int16_t*>(next);
  }

  // Of one slice, whose subaperture makes the rest of the fraction.
  static bool Same(const simd::SliceOffset& a, const simd::SliceOffset& b) {
    return a.whole == b.whole && a.fraction.edge == b.fraction.edge;
  }

  bool IsGathered(const SectionPart& part) const {
    if (gathered_ == nullptr) return false;
    const int32_t left = job_.rect.x + section_.x, top = job_.rect.y + section_.y + part.y;
    const int32_t right = left + Min(part.x + kChunk, section_.width);
    for (int32_t y = top; y < top + part.rows; y += kCellSize) {
      for (int32_t x = left + part.x; x < right; x += kCellSize) {
        if (gathered_->At(x, y) == 0) return false;
      }
    }
    return true;
  }

  // What each part of the section sees of the slices. Returns their pixels.
  uint64_t FindParts() {
    static_assert(kLeastRows == kCellSize && kChunk % kCellSize == 0, "parts are whole cells");
    parts_ = 0;
    uint64_t pixels = 0;
    for (int32_t x = 0; x < section_.width; x += kChunk) {
      for (int32_t y = 0; y < section_.height; y += kLeastRows) {
        SectionPart& part = scratch_.parts[parts_];
        part = {x, y, Min(kLeastRows, section_.height - y), 0, {}};
        if (IsGathered(part)) continue;
        ++parts_;
        for (int32_t k = 0; k < count_; ++k) {
          const simd::SliceCover cover = CoverOf(placed_[k], part);
          if (cover.some != 0) part.shown[part.count++] = static_cast<uint8_t>(k);
          if (cover.all != 0) break;
        }
        pixels += static_cast<uint64_t>(part.count) *
                  static_cast<uint64_t>(part.rows * Min(kChunk, section_.width - x));
      }
    }
    return pixels;
  }

  // Whether some, or all, of the slice's pixels that a part may see in any view are covered.
  static simd::SliceCover CoverOf(const SlicePlane& placed, const SectionPart& part) {
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
    for (int32_t k = 0; k < count_; ++k) tile_.rows[k] = {0, 0};
    for (const SectionPart* part = tile_.first; part < tile_.end; ++part) {
      for (int32_t n = 0; n < part->count; ++n) {
        RowRange& rows = tile_.rows[part->shown[n]];
        if (rows.last == 0) rows.first = part->y;
        rows.last = part->y + part->rows;
      }
      const size_t sums = kPixelSums * static_cast<size_t>(part->rows * kChunk);
      std::memset(Sums(part->y), 0, sums * sizeof(*scratch_.sums));
    }
    size_t rows = 0;
    tile_.count = 0;
    for (int32_t k = 0; k < count_; ++k) {
      if (tile_.rows[k].last == 0) continue;
      tile_.slices[tile_.count++] = k;
      rows += static_cast<size_t>(placed_[k].rows) + simd::kRowsAhead;
    }
    PlaceTiles(rows);
    for (int32_t i = -grid_.n(); i <= grid_.n(); ++i) AddColumn(i);
  }

  // Of so many rows together. Marks follow all samples.
  void PlaceTiles(size_t rows) {
    int16_t* samples = tile_.memory;
    uint8_t* near = reinterpret_cast<uint8_t*>(samples + 4 * rows * kChunk) + simd::kRowsAhead;
    for (int32_t n = 0; n < tile_.count; ++n) {
      const int32_t k = tile_.slices[n];
      const SlicePlane& placed = placed_[k];
      ShiftedSlice& shifted = shifted_[k];
      shifted.samples = samples;
      shifted.near = near;
      PlaceTile(placed, tile_.x, tile_.rows[k], &shifted);
      seen_[k] = {samples + placed.reach * kChunk, near + placed.reach, shifted.plane};
      samples += 4 * shifted.plane;
      near += shifted.plane / kChunk;
    }
  }

  // Views (i, j) of all j.
  void AddColumn(int32_t i) {
    const int32_t last = LastAcross(Abs(i));
    for (int32_t n = 0; n < tile_.count; ++n) MoveSlice(tile_.slices[n], i, last);
    for (int32_t first = -last; first <= last; first += kGroupViews) {
      AddGroup(i, first, Min(first + kGroupViews - 1, last));
    }
  }

  // Of slice k what views (i, -last) to (i, last) show; nothing if it is there from the column of
  // views before.
  void MoveSlice(int32_t k, int32_t i, int32_t last) {
    const SlicePlane& placed = placed_[k];
    const RowRange& seen = tile_.rows[k];
    const int32_t a = Offset(k, -last).whole, b = Offset(k, last).whole;
    const RowRange rows = {seen.first + placed.reach + Min(a, b),
                           Min(seen.last + placed.reach + Max(a, b) + kRowsAhead, placed.rows)};
    const RowRange& moved = shifted_[k].moved;
    const bool within = moved.first <= rows.first && rows.last <= moved.last;
    if (within && Same(Offset(k, i), Offset(k, i - 1))) return;
    ShiftSlice(*job_.kernels, placed, Offset(k, i), tile_.x, rows, &shifted_[k]);
  }

  // Views (i, first) to (i, last).
  void AddGroup(int32_t i, int32_t first, int32_t last) {
    for (int32_t j = first; j <= last; ++j) {
      scratch_.weights[j - first] = static_cast<int16_t>((Weight(i, j) * weight_scale_) >> 16);
    }
    for (const SectionPart* part = tile_.first; part < tile_.end; ++part) {
      const simd::SliceViews job = {scratch_.weights,
                                    &Offset(0, first),
                                    static_cast<size_t>(last + 1 - first),
                                    seen_,
                                    static_cast<size_t>(count_),
                                    part->shown,
                                    static_cast<size_t>(part->count),
                                    static_cast<size_t>(part->y)};
      job_.kernels->Composite(job, static_cast<size_t>(part->rows), Sums(part->y));
    }
  }

  uint32_t* Sums(int32_t row) const {
    return scratch_.sums + kPixelSums * static_cast<size_t>(row * kChunk);
  }

  void FinishTile() {
    int32_t row = 0;
    for (const SectionPart* part = tile_.first; part < tile_.end; ++part) {
      ClearRows(row, part->y);
      row = part->y + part->rows;
      FinishRows(part->y, row);
    }
    ClearRows(row, section_.height);
  }

  // What no slice covers is as what covers the rest. A pixel that hardly any view shows is that of
  // the centre view.
  void FinishRows(int32_t first, int32_t end) {
    const simd::CompositeFinish finish = {least_covered_, grid_.aperture.sum_bits};
    for (int32_t row = first; row < end; ++row) {
      const size_t at = FirstSample(row);
      job_.kernels->FinishComposite(Sums(row), simd::kSliceLanes, scratch_.centre + at, finish,
                                    Columns(), accumulators_ + at);
    }
  }

  // Of what is gathered afterwards.
  void ClearRows(int32_t first, int32_t end) {
    for (int32_t row = first; row < end; ++row) {
      std::memset(accumulators_ + FirstSample(row), 0, 3 * Columns() * sizeof(*accumulators_));
    }
  }

  // Of the tile's row in the rectangle.
  size_t FirstSample(int32_t row) const {
    return 3 * static_cast<size_t>((section_.y + row) * job_.rect.width + section_.x + tile_.x);
  }

  size_t Columns() const { return static_cast<size_t>(Min(kChunk, section_.width - tile_.x)); }

  const RenderJob& job_;
  const SliceRule rule_;
  const SliceLimits limits_;
  const GatherMap* gathered_;
  const ViewGrid& grid_;
  CompositorScratch& scratch_;
  uint32_t* accumulators_;
  Rect inner_ = {};  // the rectangle in its surfaces
  Slice slices_[kMaxSlices];
  int32_t count_ = 0;
  Section section_ = {};  // under way
  SlicePlane placed_[kMaxSlices];
  ShiftedSlice shifted_[kMaxSlices];  // of the tile and the column of views under way
  simd::TileSlice seen_[kMaxSlices];  // the same, as views of them see it
  struct Tile {
    int32_t x;  // in the section
    const SectionPart *first, *end;
    RowRange rows[kMaxSlices];   // of the section, of the parts that see a slice
    int32_t slices[kMaxSlices];  // that are seen
    int32_t count;
    int16_t* memory;
  } tile_;
  int32_t parts_ = 0;
  uint64_t weight_scale_ = 0;  // 16 bits
  uint32_t least_covered_ = 0;
};

}  // namespace

uint64_t CompositeRectangle(const RenderJob& job, const SliceRule& rule, const SliceLimits& limits,
                            const GatherMap* gathered, CompositorScratch* scratch,
                            uint32_t* accumulators) {
  return Compositor(job, rule, limits, gathered, scratch, accumulators).Refocus();
}

}  // namespace starfocus
