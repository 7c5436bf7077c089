// SPDX-License-Identifier: Apache-2.0
#include "lib/filter/gather.h"

#include "lib/input/load_field.h"

namespace starfocus {
namespace {

class Gather {
 public:
  Gather(const GatherJob& job, Field* field, const Gathered& out)
      : job_(job),
        block_(job.cells.block),
        frame_(LayerFrame(block_, job.cells.layer)),
        field_(field),
        out_(out) {}

  void Load() {
    for (int32_t y = block_.y; y < Bottom(); y += kCellSize) {
      for (int32_t x = block_.x; x < Right(); x += kCellSize) {
        if (!job_.cells.IsGathered(x, y)) continue;
        border_ = Max(border_, job_.kernels_of_radius[StepOf(x, y)].size);
      }
    }
    LoadField(*job_.kernels, *job_.window, frame_, {border_, border_, border_, border_}, field_);
  }

  // Filters the row of cells at y; those side by side that have the same kernel go together.
  void FilterRow(int32_t y) {
    for (int32_t x = block_.x; x < Right();) {
      const int32_t first = x;
      x += kCellSize;
      if (!job_.cells.IsGathered(first, y)) continue;
      const int32_t step = StepOf(first, y);
      while (x < Right() && job_.cells.IsGathered(x, y) && StepOf(x, y) == step) x += kCellSize;
      Rect part = job_.cells.PixelsOf(first, y);
      const Rect last = job_.cells.PixelsOf(x - kCellSize, y);
      part.width = last.x + last.width - part.x;
      if (!Filter(part, job_.kernels_of_radius[step])) return;
      pixels_ += static_cast<uint64_t>(Min(x, Right()) - first) *
                 static_cast<uint64_t>(Min(kCellSize, Bottom() - y));
    }
  }

  int32_t Right() const { return block_.x + block_.width; }
  int32_t Bottom() const { return block_.y + block_.height; }
  uint64_t pixels() const { return pixels_; }

 private:
  // Returns whether patience lasted until then.
  bool Filter(const Rect& part, const BlurKernel& kernel) const {
    const int64_t points = (2 * kernel.size + 1) * (2 * kernel.size + 1);
    if (!GoesOn(job_.patience, 3 * points * part.width * part.height)) return false;
    const int32_t x = part.x - frame_.x, y = part.y - frame_.y;
    const int16_t* in = field_->Rgb(border_ + x, border_ + y);
    const size_t in_stride = RgbStride(field_->width);
    const simd::Disc disc = {kernel.size, kernel.sum_bits, kernel.weights};
    const auto rows = static_cast<size_t>(part.height), count = 3 * static_cast<size_t>(part.width);
    const size_t at = static_cast<size_t>(y) * out_.stride + 3 * static_cast<size_t>(x);
    if (job_.cells.layer == 0) {
      job_.kernels->FilterDisc(in, in_stride, disc, job_.window->transfer->encoding, rows, count,
                               out_.codes + at, out_.stride);
    } else {
      job_.kernels->FilterDiscLayer(in, in_stride, disc, rows, count, out_.samples + at,
                                    out_.stride);
    }
    return true;
  }

  int32_t StepOf(int32_t x, int32_t y) const {
    const Cell& cell = *job_.grid->At(x / kCellSize, y / kCellSize);
    const int32_t radius = job_.scale.Radius(Abs((cell.low + cell.high) / 2 - job_.scale.focus));
    return BlurStep(radius >> job_.cells.layer);
  }

  const GatherJob& job_;
  const Rect& block_;  // in the picture
  const Rect frame_;   // at the layer
  Field* field_;
  const Gathered& out_;
  int32_t border_ = 0;  // largest kernel size
  uint64_t pixels_ = 0;
};

}  // namespace

uint64_t GatherCells(const GatherJob& job, Field* field, const Gathered& out) {
  Gather gather(job, field, out);
  gather.Load();
  for (int32_t y = job.cells.block.y; y < gather.Bottom(); y += kCellSize) gather.FilterRow(y);
  return gather.pixels();
}

}  // namespace starfocus
