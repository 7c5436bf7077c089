// SPDX-License-Identifier: Apache-2.0
#include "lib/line_scan/triangles.h"
#include "lib/plan/renderer.h"

namespace starfocus {
namespace {

int32_t LayerOf(const BlockStats& stats, Demand demand) {
  return LayerByPaper(static_cast<double>(stats.r_min) / (1 << kDisparityBits), demand);
}

// Half of the type A views (on the axes of the aperture, IV-B) are scanned along rows, and half
// along columns. Each type A view is rendered with the border of the other axis. The estimate
// counts half of all views as scanned along rows and half as scanned along columns. Type B views
// are scanned along both axes.
BlockWork MeasureWork(const Rect& rect, const Border& border, const ViewWeights& aperture,
                      const Content (&content)[2], int32_t layer) {
  const auto width = static_cast<uint64_t>(rect.width), height = static_cast<uint64_t>(rect.height);
  const uint64_t extended_width = width + static_cast<uint64_t>(border.left + border.right);
  const uint64_t extended_height = height + static_cast<uint64_t>(border.top + border.bottom);
  const auto all = static_cast<uint64_t>(aperture.views) - 1;
  const uint64_t on_axis = 2 * static_cast<uint64_t>(aperture.n);
  BlockWork work = {};
  work.field = extended_width * extended_height;
  work.a = on_axis * (width * extended_height + extended_width * height);
  work.b = 4 * static_cast<uint64_t>(LastOnDiagonal(aperture.n)) * width * height;
  work.c = (all - 2 * on_axis) * width * height - work.b;
  AddScans(all / 2, height, content[0], layer, &work);
  AddScans(all / 2, width, content[1], layer, &work);
  return work;
}

// In the comments of LineScanScratch, E is `extended`, and R is the side of a superblock.
void TakeScratch(const starfocus_config& config, size_t extended, size_t max_n, Arena* arena,
                 void* memory) {
  LineScanScratch counted;
  LineScanScratch& scratch = memory == nullptr ? counted : *static_cast<LineScanScratch*>(memory);
  const auto rectangle = static_cast<size_t>(config.superblock);
  const size_t area = extended * extended;
  const size_t rgb_stride = RgbStride(static_cast<int32_t>(extended));
  for (int k = 0; k < 2; ++k) {
    scratch.field_rgb[k] = arena->Take<int16_t>(extended * rgb_stride);
    scratch.field_disparity[k] = arena->Take<int16_t>(area);
  }
  scratch.column_sums = arena->Take<uint32_t>(3 * rectangle * rectangle);
  scratch.diagonal_rgb = arena->Take<int16_t>(3 * area);
  scratch.diagonal_disparity = arena->Take<int16_t>(area);
  scratch.diagonal_offsets = arena->Take<uint32_t>(2 * extended);
  scratch.moves = arena->Take<int64_t>(max_n + 1);
  scratch.marks.starts = arena->Take<uint16_t>(RunMarkWords(extended, extended));
  scratch.marks.edges = arena->Take<uint16_t>(RunMarkWords(extended, extended));
  scratch.marks.middles = arena->Take<int16_t>(RunMiddles(extended, extended));
  scratch.runs = arena->Take<Run>(area);
  scratch.run_counts = arena->Take<int32_t>(extended);
  scratch.line_runs = arena->Take<Run>(extended);
  scratch.strip_rgb = arena->Take<int16_t>(3 * rectangle * kStripRows);
  scratch.view_disparity = arena->Take<int16_t>(rectangle * extended);
  scratch.columns_rgb = arena->Take<int16_t>(rectangle * rgb_stride);
  scratch.line_accumulators = arena->Take<uint32_t>(3 * extended);
  scratch.spans = TakeSpans(extended, arena);
}

// Largest shift t that leaves a pixel unchanged, in kShiftBits. The pixel stays in place and its
// neighbour has weight 0 if 2 |t| + L <= 1 (SubapertureWeight), where the subaperture L is at most
// |t|. One unit is subtracted from kShiftOne / 3, to allow for rounding.
constexpr int32_t kStill = kShiftOne / 3 - 1;

// Returns false at layers 1 and 2, because blocks at these layers are resampled.
bool NothingMoves(const RenderJob& job) {
  const Window& window = *job.window;
  if (window.layer != 0) return false;
  const int64_t still =
      (int64_t{kStill} << (kStepBits + kDisparityBits - kShiftBits)) / job.grid->step;
  // Disparities that differ from a single focus by at most `limit` form no depth edge, so no pixel
  // is mixed. Disparities around a range in focus may form depth edges, where only surfaces that do
  // not move at all stay unmixed.
  const FocusRange& focus = job.grid->focus;
  const int64_t most = focus.IsSingle() ? kSurfaceStep / 2 : 0;
  const auto limit = static_cast<int32_t>(still < most ? still : most);
  // The ranges of rows and columns are clamped so that at least one row and one column lie inside
  // the picture.
  const Rect rect = Extended(job.rect, job.border);
  const int32_t left = Clamp(rect.x, 0, window.width - 1);
  const int32_t right = Clamp(rect.x + rect.width, 1, window.width);
  const int32_t top = Clamp(rect.y, 0, window.height - 1);
  const int32_t bottom = Clamp(rect.y + rect.height, 1, window.height);
  for (int32_t y = top; y < bottom; ++y) {
    const int16_t* row = window.disparity.Row(y);
    for (int32_t x = left; x < right; ++x) {
      if (Abs(focus.Distance(row[x])) > limit) return false;
    }
  }
  return true;
}

}  // namespace

const Renderer kLineScanRenderer = {
    1,
    false,
    256,  // benchmark mode: largest side of a superblock
    [](double r_max, Demand) { return ViewsByPaper(r_max); },
    LayerOf,
    MakeViewWeights,
    MeasureWork,
    sizeof(LineScanScratch),
    TakeScratch,
    NothingMoves,
    RefocusRectangle,
    [](const ViewWeights& aperture) { return aperture.sum_bits + kLightBits; }};

}  // namespace starfocus
