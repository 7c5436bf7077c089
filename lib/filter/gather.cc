// SPDX-License-Identifier: Apache-2.0
#include "lib/filter/gather.h"

#include "lib/input/load_field.h"

namespace starfocus {
namespace {

class Gather {
 public:
  Gather(const GatherJob& job, Field* field)
      : job_(job),
        field_(field),
        column_(job.rect.x / kCellSize),
        row_(job.rect.y / kCellSize),
        columns_((job.rect.width + kCellSize - 1) / kCellSize),
        rows_((job.rect.height + kCellSize - 1) / kCellSize) {}

  void Load() {
    for (int32_t row = 0; row < rows_; ++row) {
      for (int32_t column = 0; column < columns_; ++column) {
        if (!IsGathered(column, row)) continue;
        border_ = Max(border_, job_.kernels_of_radius[StepOf(column, row)].size);
      }
    }
    LoadField(*job_.kernels, *job_.window, job_.rect, {border_, border_, border_, border_}, field_);
  }

  // Filters a row of cells; those side by side that have the same kernel go together.
  void FilterCells(int32_t row, uint8_t* out, size_t out_stride) {
    const int32_t y = row * kCellSize, height = Min(kCellSize, job_.rect.height - y);
    for (int32_t column = 0; column < columns_;) {
      if (!IsGathered(column, row)) {
        ++column;
        continue;
      }
      const int32_t x = column * kCellSize, step = StepOf(column, row);
      while (++column < columns_ && IsGathered(column, row) && StepOf(column, row) == step) {
      }
      const BlurKernel& kernel = job_.kernels_of_radius[step];
      const int32_t width = Min(column * kCellSize, job_.rect.width) - x;
      const int64_t points = (2 * kernel.size + 1) * (2 * kernel.size + 1);
      if (!GoesOn(job_.patience, 3 * points * width * height)) return;
      job_.kernels->FilterDisc(field_->Rgb(border_ + x, border_ + y), RgbStride(field_->width),
                               {kernel.size, kernel.sum_bits, kernel.weights},
                               job_.window->transfer->encoding, static_cast<size_t>(height),
                               3 * static_cast<size_t>(width), out + 3 * x, out_stride);
      pixels_ += static_cast<uint64_t>(width) * static_cast<uint64_t>(height);
    }
  }

  int32_t rows() const { return rows_; }
  uint64_t pixels() const { return pixels_; }

 private:
  bool IsGathered(int32_t column, int32_t row) const {
    return job_.gathered->At((column_ + column) * kCellSize, (row_ + row) * kCellSize) != 0;
  }
  int32_t StepOf(int32_t column, int32_t row) const {
    const Cell& cell = *job_.cells->At(column_ + column, row_ + row);
    return BlurStep(job_.scale.Radius(Abs((cell.low + cell.high) / 2 - job_.scale.focus)));
  }

  const GatherJob& job_;
  Field* field_;
  const int32_t column_, row_;  // of cells, in the picture
  const int32_t columns_, rows_;
  int32_t border_ = 0;  // largest kernel size
  uint64_t pixels_ = 0;
};

}  // namespace

uint64_t GatherRectangle(const GatherJob& job, Field* field, uint8_t* out, size_t out_stride) {
  Gather gather(job, field);
  gather.Load();
  for (int32_t row = 0; row < gather.rows(); ++row) {
    gather.FilterCells(row, out + static_cast<size_t>(row * kCellSize) * out_stride, out_stride);
  }
  return gather.pixels();
}

}  // namespace starfocus
