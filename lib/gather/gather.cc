// SPDX-License-Identifier: Apache-2.0
#include "lib/gather/gather.h"

#include <cstring>

#include "lib/io/block_pixels.h"
#include "lib/optics/opening.h"
#include "lib/plan/smooth_cells.h"

namespace starfocus {
namespace {

constexpr int32_t kHalves = 2 * kCellSize;  // number of half pixels along the side of a cell

// Returns the signed blur radius at the upper left corner of a cell.
int32_t RadiusAtCorner(const CellGrid& grid, const BlurScale& scale, int32_t column, int32_t row) {
  constexpr int kSummedBits = 3;  // log2 of the number of summed disparities, two of each cell
  int64_t distance = -int64_t{scale.focus.far} * (1 << kSummedBits);
  for (int32_t y = row - 1; y <= row; ++y) {
    for (int32_t x = column - 1; x <= column; ++x) {
      const Cell& cell = *grid.At(Clamp(x, 0, grid.columns - 1), Clamp(y, 0, grid.rows - 1));
      distance += cell.low + cell.high;
    }
  }
  return static_cast<int32_t>((scale.step * distance) >>
                              (kStepBits + kDisparityBits + kSummedBits - kSlopeBits));
}

}  // namespace

Slope::Slope(const CellGrid& grid, const BlurScale& scale, int32_t column, int32_t row,
             int32_t layer)
    : layer_(layer), left_(kHalves * column), top_(kHalves * row) {
  for (int32_t k = 0; k < 4; ++k) {
    corners_[k] = RadiusAtCorner(grid, scale, column + (k & 1), row + (k >> 1));
  }
}

// Returns the signed radius of a pixel of the layer, in pixels of the layer, with ScaledBits extra
// fractional bits.
int64_t Slope::Scaled(int32_t x, int32_t y) const {
  const int32_t across = (2 * x + 1) * (1 << layer_) - left_;
  const int32_t down = (2 * y + 1) * (1 << layer_) - top_;
  const int32_t above = corners_[0] * (kHalves - across) + corners_[1] * across;
  const int32_t below = corners_[2] * (kHalves - across) + corners_[3] * across;
  return int64_t{above} * (kHalves - down) + int64_t{below} * down;
}

int32_t Slope::At(int32_t x, int32_t y) const {
  return static_cast<int32_t>(RoundShift(Scaled(x, y), ScaledBits()));
}

Range Slope::RangeOf(const Rect& pixels) const {
  const int32_t right = pixels.x + pixels.width - 1, bottom = pixels.y + pixels.height - 1;
  const int32_t radii[4] = {At(pixels.x, pixels.y), At(right, pixels.y), At(pixels.x, bottom),
                            At(right, bottom)};
  int32_t low = radii[0], high = radii[0];
  for (const int32_t radius : radii) {
    low = Min(low, radius);
    high = Max(high, radius);
  }
  const int32_t nearest = low < 0 && high > 0 ? 0 : Min(Abs(low), Abs(high));
  return {nearest, Max(Abs(low), Abs(high))};
}

void Slope::FindMix(const Range& between, const Rect& pixels, size_t stride, int16_t* mix) const {
  constexpr int32_t kOne = INT16_MAX;
  const int64_t low = int64_t{between.first} * between.first;
  const int64_t range = int64_t{between.last} * between.last - low;
  const int64_t unit = range > 0 ? (int64_t{kOne} << 32) / range : 0;
  const int bits = ScaledBits();
  for (int32_t row = 0; row < pixels.height; ++row, mix += stride) {
    const int32_t x = pixels.x, y = pixels.y + row;
    int64_t scaled = Scaled(x, y);
    const int64_t step = Scaled(x + 1, y) - scaled;
    scaled += int64_t{1} << (bits - 1);
    int16_t* to = mix;
    for (int32_t n = 0; n < pixels.width; ++n, to += 3, scaled += step) {
      const int64_t radius = scaled >> bits;
      const int64_t part = ((radius * radius - low) * unit) >> 32;
      to[0] = to[1] = to[2] = static_cast<int16_t>(part < 0 ? 0 : part > kOne ? kOne : part);
    }
  }
}

simd::HalfMove Slope::Move(int32_t spread) const {
  constexpr int32_t kMost = INT16_MAX;
  const int64_t radii = int64_t{corners_[0]} + corners_[1] + corners_[2] + corners_[3];
  // The mean radius is 1/4 of the sum of the radii at the corners. The gradient is 1/16 of the
  // difference between opposite sides.
  const auto half_move = [&](int32_t difference) {
    const int bits = kOpeningBits + 2 * kSlopeBits + 2 + 4 + 1 - 15 + layer_;
    // Rounds the absolute value, so that a mirrored slope moves exactly as far in the other
    // direction.
    const int64_t product = radii * difference * spread;
    const int64_t move = RoundShift(product < 0 ? -product : product, bits);
    const auto limited = static_cast<int32_t>(move < kMost ? move : kMost);
    return static_cast<int16_t>(product < 0 ? -limited : limited);
  };
  return {half_move(corners_[1] + corners_[3] - corners_[0] - corners_[2]),
          half_move(corners_[2] + corners_[3] - corners_[0] - corners_[1])};
}

namespace {

// Largest number of adjacent cells on a slope that are filtered together. Cells that are filtered
// together have the same PSFs.
constexpr int32_t kSlopeCells = 4;

class Gather {
 public:
  Gather(const GatherJob& job, BlockPixels* field, uint8_t* codes, int16_t* samples, size_t stride)
      : job_(job),
        block_(job.cells.block),
        frame_(LayerFrame(block_, job.cells.layer)),
        field_(field),
        codes_(codes),
        samples_(samples),
        stride_(stride) {}

  // Chooses the PSFs of all cells, and loads the pixels that the PSFs cover.
  void Load() {
    for (int32_t y = block_.y; y < Bottom(); y += kCellSize) {
      for (int32_t x = block_.x; x < Right(); x += kCellSize) {
        Psfs& pair = At(x, y) = kNone;
        if (!job_.cells.IsGathered(x, y)) continue;
        pair = PsfsOf(x, y);
        border_ = Max(border_, PsfOf(pair.more).size);
      }
    }
    loaded_ = job_.cells.BoundsOf(true);
    LoadBlock(*job_.input, job_.cells.layer, loaded_, {border_, border_, border_, border_}, field_);
  }

  void Filter() {
    for (int32_t y = block_.y; y < Bottom(); y += kCellSize) FilterRow(y);
  }

  int32_t Right() const { return block_.x + block_.width; }
  int32_t Bottom() const { return block_.y + block_.height; }
  uint64_t pixels() const { return pixels_; }

 private:
  // Indices (PsfIndex) of the PSFs for the smallest and largest radius of a cell. Psfs are stored
  // as bytes, because the indices of all cells of a block are on the stack.
  struct Psfs {
    int8_t less, more;
  };
  static_assert(kMaxGather <= 31,
                "PSF indices must fit in int8_t: index 127 is a radius of 31.5 pixels");
  static constexpr Psfs kNone = {-1, -1};  // marks cells that are rendered from views

  // Sizes of intermediate rows of adjacent cells on a slope, in samples. Rows that span all of the
  // cells have kStride samples. Rows that span a single cell have kCell samples, with one extra
  // pixel on each side. Both kStride and kCell include the samples that kernels read beyond the end
  // of a row.
  static constexpr size_t kPixel = 3;
  static constexpr size_t kStride =
      simd::SliceSamples(3 * kSlopeCells * kCellSize) + simd::kSliceLanes;
  static constexpr size_t kCell = simd::SliceSamples(3 * kCellSize) + simd::kSliceLanes;

  // Filters the row of cells at y. Adjacent cells with the same PSFs are filtered together.
  void FilterRow(int32_t y) {
    for (int32_t x = block_.x; x < Right();) {
      const int32_t first = x;
      x += kCellSize;
      if (At(first, y).less < 0) continue;
      x = job_.cells.IsFlat(first, y) ? FilterFlat(first, y) : FilterSlopes(first, y);
      if (x == first) return;
      pixels_ += static_cast<uint64_t>(Min(x, Right()) - first) *
                 static_cast<uint64_t>(Min(kCellSize, Bottom() - y));
    }
  }

  // Counts the work of filtering `part` with `psf`. Returns false after cancellation.
  bool Spend(const Psf& psf, const Rect& part) const {
    const int64_t points = (2 * psf.size + 1) * (2 * psf.size + 1);
    return GoesOn(job_.cancel, 3 * points * part.width * part.height);
  }

  simd::SampleRows RowsOf(const Rect& part) const {
    return {field_->Rgb(border_ + part.x - loaded_.x, border_ + part.y - loaded_.y),
            RgbStride(field_->width), static_cast<size_t>(part.height),
            3 * static_cast<size_t>(part.width)};
  }

  // Returns the index of the first output sample of `part`.
  size_t FirstOut(const Rect& part) const {
    return static_cast<size_t>(part.y - frame_.y) * stride_ +
           3 * static_cast<size_t>(part.x - frame_.x);
  }

  // Returns the pixels of the layer that belong to cells [x, end) of the row at y.
  Rect PixelsOf(int32_t x, int32_t end, int32_t y) const {
    Rect part = job_.cells.PixelsOf(x, y);
    const Rect last = job_.cells.PixelsOf(end - kCellSize, y);
    part.width = last.x + last.width - part.x;
    return part;
  }

  // Filters adjacent flat cells with the same PSF, starting at (x, y). Returns the end of the
  // cells, or x after cancellation.
  int32_t FilterFlat(int32_t x, int32_t y) {
    const Psfs pair = At(x, y);
    int32_t end = x + kCellSize;
    while (end < Right() && HasPsfs(end, y, true, pair)) end += kCellSize;
    const Rect part = PixelsOf(x, end, y);
    const Psf& psf = PsfOf(pair.less);
    if (!Spend(psf, part)) return x;
    const simd::SampleRows in = RowsOf(part);
    const simd::Disc disc = DiscOf(psf);
    if (codes_ != nullptr) {
      job_.input->kernels->FilterDisc(in, disc, *job_.input->transfer, codes_ + FirstOut(part),
                                      stride_);
    } else {
      job_.input->kernels->FilterDiscLayer(in, disc, samples_ + FirstOut(part), stride_);
    }
    return end;
  }

  // Filters adjacent cells on a slope with the same two PSFs, starting at (x, y). Mixes the results
  // of the smaller and the larger PSF pixel by pixel. Finally, displaces the mixed pixels, because
  // the mean of all views is displaced on a slope. Returns the end of the cells, or x after
  // cancellation.
  int32_t FilterSlopes(int32_t x, int32_t y) {
    const Psfs pair = At(x, y);
    const int32_t most = Min(Right(), x + kSlopeCells * kCellSize);
    int32_t end = x + kCellSize;
    while (end < most && HasPsfs(end, y, false, pair)) end += kCellSize;
    const Rect part = PixelsOf(x, end, y);
    const Psf &less = PsfOf(pair.less), &more = PsfOf(pair.more);
    if (!Spend(more, part)) return x;
    job_.input->kernels->FilterTwoDiscs(RowsOf(part), DiscOf(less), DiscOf(more), less_, more_,
                                        kStride);
    for (; x < end; x += kCellSize) {
      const Rect pixels = job_.cells.PixelsOf(x, y);
      const Slope slope = SlopeOf(x, y);
      Mix(slope, pair, pixels, 3 * static_cast<size_t>(pixels.x - part.x));
      ContinueBeyond(pixels.height, 3 * static_cast<size_t>(pixels.width));
      Move(slope.Move(job_.mean_square), pixels);
    }
    return end;
  }

  // Mixes the results of the smaller and the larger PSF in the pixels of a cell. `first` is the
  // index of the first sample of the cell in the filtered rows.
  void Mix(const Slope& slope, const Psfs& pair, const Rect& pixels, size_t first) {
    constexpr int kBits = kSlopeBits - kDisparityBits;
    const Range between = {RadiusOfPsf(pair.less) << kBits, RadiusOfPsf(pair.more) << kBits};
    slope.FindMix(between, pixels, kCell, share_);
    for (int32_t row = 0; row < pixels.height; ++row) {
      const size_t at = first + static_cast<size_t>(row) * kStride;
      job_.input->kernels->MixSamples(less_ + at, more_ + at,
                                      share_ + static_cast<size_t>(row) * kCell,
                                      3 * static_cast<size_t>(pixels.width), Mixed(row));
    }
  }

  // Extrapolates the mixture of a cell by one pixel on each side, so that the gradient continues at
  // the rim of the cell.
  void ContinueBeyond(int32_t height, size_t count) {
    const auto go_on = [](const int16_t* last, ptrdiff_t back) {
      return static_cast<int16_t>(2 * last[0] - last[back]);
    };
    constexpr auto kAcross = static_cast<ptrdiff_t>(kPixel), kDown = static_cast<ptrdiff_t>(kCell);
    const bool one_column = count == 3, one_row = height == 1;
    for (int32_t y = 0; y < height; ++y) {
      int16_t* row = Mixed(y);
      for (ptrdiff_t c = 0; c < kAcross; ++c) {
        int16_t *first = row + c, *last = row + count - kPixel + c;
        first[-kAcross] = go_on(first, one_column ? 0 : kAcross);
        last[kAcross] = go_on(last, one_column ? 0 : -kAcross);
      }
    }
    for (size_t n = 0; n < count; ++n) {
      int16_t *first = Mixed(0) + n, *last = Mixed(height - 1) + n;
      first[-kDown] = go_on(first, one_row ? 0 : kDown);
      last[kDown] = go_on(last, one_row ? 0 : -kDown);
    }
  }

  // Displaces the mixture of a cell by `move`, and stores the result in the output.
  void Move(const simd::HalfMove& move, const Rect& pixels) {
    const size_t count = 3 * static_cast<size_t>(pixels.width);
    const auto rows = static_cast<size_t>(pixels.height);
    job_.input->kernels->MoveSamples({Mixed(0), kCell, rows, count}, move, moved_, kCell);
    size_t at = FirstOut(pixels);
    const int16_t* moved = moved_;
    for (int32_t row = 0; row < pixels.height; ++row) {
      if (codes_ == nullptr) {
        std::memcpy(samples_ + at, moved, count * sizeof(*moved));
      } else {
        job_.input->kernels->Narrow(moved, count, *job_.input->transfer, codes_ + at);
      }
      at += stride_;
      moved += kCell;
    }
  }

  Slope SlopeOf(int32_t x, int32_t y) const {
    return Slope(*job_.grid, job_.scale, x / kCellSize, y / kCellSize, job_.cells.layer);
  }

  // Returns the PSFs that blur a cell: one PSF for the middle of a flat cell, or two PSFs to mix on
  // a slope.
  Psfs PsfsOf(int32_t x, int32_t y) const {
    if (job_.cells.IsFlat(x, y)) {
      const Cell& cell = *job_.grid->At(x / kCellSize, y / kCellSize);
      const int32_t distance = (cell.low + cell.high) / 2 - job_.scale.focus.far;
      const int32_t radius = job_.scale.Radius(Abs(distance));
      const auto index = static_cast<int8_t>(PsfIndex(radius >> job_.cells.layer));
      return {index, index};
    }
    constexpr int kBits = kSlopeBits - kDisparityBits, kUp = (1 << kBits) - 1;
    const Range range = SlopeOf(x, y).RangeOf(job_.cells.PixelsOf(x, y));
    const auto made = [&](int32_t index) {
      return static_cast<int8_t>(Min(index, job_.last_step));
    };
    return {made(PsfBelow(range.first >> kBits)), made(PsfAbove((range.last + kUp) >> kBits))};
  }

  Psfs& At(int32_t x, int32_t y) {
    return psfs_[(y - block_.y) / kCellSize * kMaxRowCells + (x - block_.x) / kCellSize];
  }

  bool HasPsfs(int32_t x, int32_t y, bool flat, const Psfs& pair) {
    const Psfs& here = At(x, y);
    return here.less == pair.less && here.more == pair.more && job_.cells.IsFlat(x, y) == flat;
  }

  // Returns row `row` of the mixture.
  int16_t* Mixed(int32_t row) { return mixed_ + static_cast<size_t>(row + 1) * kCell + kPixel; }

  const Psf& PsfOf(int32_t step) const { return job_.psfs[step]; }

  static simd::Disc DiscOf(const Psf& psf) { return {psf.size, psf.sum_bits, psf.weights}; }

  const GatherJob& job_;
  const Rect& block_;  // The block, in pixels of the picture.
  const Rect frame_;   // LayerFrame of the block, in pixels of the layer.
  Rect loaded_ = {};   // Pixels of the layer that the filters read.
  BlockPixels* field_;
  uint8_t* const codes_;    // output, if it is not null
  int16_t* const samples_;  // output if codes_ is null
  const size_t stride_;
  int32_t border_ = 0;  // border of the field: the largest PSF size
  uint64_t pixels_ = 0;
  Psfs psfs_[kMaxRowCells * kMaxRowCells];  // PSFs (PsfIndex) of each cell of the block
  // Results of the smaller and the larger PSF, and the mix of the larger PSF.
  int16_t less_[kCellSize * kStride] = {}, more_[kCellSize * kStride] = {};
  int16_t share_[kCellSize * kCell] = {};
  // Weighted mean of the results of two PSFs, starting one row above the cell.
  int16_t mixed_[(kCellSize + 2) * kCell] = {};
  int16_t moved_[kCellSize * kCell] = {};
};

}  // namespace

uint64_t GatherCells(const GatherJob& job, BlockPixels* field, uint8_t* codes, int16_t* samples,
                     size_t stride) {
  Gather gather(job, field, codes, samples, stride);
  gather.Load();
  gather.Filter();
  return gather.pixels();
}

}  // namespace starfocus
