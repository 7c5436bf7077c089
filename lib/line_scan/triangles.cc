// SPDX-License-Identifier: Apache-2.0
// The paper's primitive: refocuses one rectangle of the picture with a given N at one layer. The
// views of the aperture form eight triangles and are rendered as types A, B and C (section IV-B).
#include <cstring>
#include <initializer_list>

#include "lib/io/block_pixels.h"
#include "lib/line_scan/line_scan.h"
#include "lib/line_scan/span_sink.h"
#include "lib/plan/renderer.h"

namespace starfocus {
namespace {

// Number of type A lines that are rendered before they are transposed together.
constexpr int32_t kRowsAtOnce = 16;

// Returns the largest i of the type B views (i, i) for N views along the radius.
constexpr int32_t LastOnDiagonal(int32_t n) {
  int32_t last = 0;
  while (2 * (last + 1) * (last + 1) <= n * n) ++last;
  return last;
}

constexpr uint32_t kBlendOne = 1 << simd::kBlendBits;

Direction DirectionOf(int sign) {
  return sign > 0 ? Direction::kRightToLeft : Direction::kLeftToRight;
}

// Transposes pixels: pixel `column` of row `row` of `in` becomes pixel `row` of row `column` of
// `out`. Strides are in samples. The function reads one sample past the end of each row of `in` and
// writes one sample past the end of each row of `out`. Rows of `in` are read in order, so a picture
// can be transposed in strips of rows.
void Transpose(const int16_t* in, size_t in_stride, int32_t rows, int32_t columns, int16_t* out,
               size_t out_stride) {
  for (int32_t row = 0; row < rows; ++row, in += in_stride, out += 3) {
    const int16_t* from = in;
    int16_t* to = out;
    for (int32_t column = 0; column < columns; ++column, from += 3, to += out_stride) {
      std::memcpy(to, from, 4 * sizeof(*to));
    }
  }
}

// Transposes the light of a field. The output array to->rgb must be set and must differ from the
// input array.
void TransposePixels(const BlockPixels& from, BlockPixels* to) {
  Transpose(from.rgb, RgbStride(from.width), from.height, from.width, to->rgb,
            RgbStride(to->width));
}

// Transposes the disparities of a field. The output array to->disparity must be set and must differ
// from the input array. TransposeDisparity must be called before TransposePixels.
void TransposeDisparity(const BlockPixels& from, BlockPixels* to) {
  to->transposed = !from.transposed;
  to->layer = from.layer;
  to->width = from.height;
  to->height = from.width;
  to->x = from.y;
  to->y = from.x;
  to->inner = {from.inner.y, from.inner.x, from.inner.height, from.inner.width};
  for (int32_t row = 0; row < to->height; ++row) {
    int16_t* disparity = to->Disparity(0, row);
    const int16_t* from_disparity = from.Disparity(row, 0);
    for (int32_t column = 0; column < to->width; ++column, from_disparity += from.width) {
      disparity[column] = *from_disparity;
    }
  }
}

// Start and length of a diagonal in pixels. From pixel to pixel of the diagonal, x increases by 1,
// and y increases by 1, or decreases by 1 if `anti`.
struct DiagonalLine {
  int32_t x, y, length;
};

DiagonalLine GetDiagonal(const BlockPixels& field, bool anti, int32_t index) {
  const int32_t x = Max(0, index - (field.height - 1));
  const int32_t y = anti ? Min(index, field.height - 1) : Max(0, field.height - 1 - index);
  const int32_t rest = anti ? y + 1 : field.height - y;
  return {x, y, Min(field.width - x, rest)};
}

// Renders all views of the aperture for one rectangle. "Along" is the direction of the parallax of
// type A views, and "across" is the additional direction of type C views (types of section IV-B of
// the paper).
class Star {
 public:
  Star(const RenderJob& job, LineScanScratch* scratch, uint32_t* sums)
      : job_(job),
        grid_(*job.grid),
        run_range_(RunRange(grid_)),
        half_views_(HalfViews(grid_, job.input->views)),
        scratch_(scratch),
        sums_(sums) {}

  void Refocus() {
    BlockPixels rows = MakeField(0);
    LoadBlock(*job_.input, job_.layer, job_.rect, job_.border, &rows);
    UnmixEdges(*job_.input->kernels, *job_.input, grid_, &rows);
    for (int32_t i = 0; i <= grid_.n(); ++i) scratch_->moves[i] = grid_.Move(i);
    Clear(scratch_->column_sums);
    BlockPixels columns = MakeField(1);
    TransposeDisparity(rows, &columns);
    AddViews(rows, columns, scratch_->column_sums);
    TransposePixels(rows, &columns);
    Clear(sums_);
    AddCentre(rows);
    TypeB(rows, false);
    TypeB(rows, true);
    AddViews(columns, rows, sums_);
    AddTransposed();
  }

 private:
  void Clear(uint32_t* sums) const {
    const size_t samples = 3 * static_cast<size_t>(job_.rect.width) * job_.rect.height;
    std::memset(sums, 0, samples * sizeof(uint32_t));
  }

  BlockPixels MakeField(int orientation) const {
    BlockPixels field;
    field.rgb = scratch_->block_rgb[orientation];
    field.disparity = scratch_->block_disparity[orientation];
    return field;
  }

  SpanList Accumulating(uint32_t* accumulators) const {
    return SpanList(*job_.input->kernels, *scratch_, accumulators);
  }

  // Returns the filler of holes of a line of view (u * i, v * j). Pixel 0 of the line is pixel (x,
  // y) of the picture in the orientation of the field.
  HoleFiller HolesOf(const BlockPixels& field, int u, int v, int32_t x, int32_t y, int32_t dx,
                     int32_t dy) const {
    return {*job_.input,
            field.layer,
            grid_,
            scratch_->moves,
            field.transposed,
            u,
            v,
            half_views_,
            0,
            0,
            x,
            y,
            dx,
            dy};
  }

  // Adds `pixels` pixels of a line, all with weight `weight`.
  static void AddLine(const int16_t* rgb, int32_t pixels, uint32_t weight, uint32_t target,
                      SpanList* list) {
    list->Add(
        {rgb, target, 3 * static_cast<uint32_t>(pixels), static_cast<uint16_t>(weight), 0, 0});
  }

  void AddCentre(const BlockPixels& rows) {
    const Rect& inner = rows.inner;
    SpanList list = Accumulating(sums_);
    for (int32_t row = 0; row < inner.height; ++row) {
      AddLine(rows.Rgb(inner.x, inner.y + row), inner.width, grid_.aperture.Weight(0, 0),
              3u * static_cast<uint32_t>(row * inner.width), &list);
    }
    list.Flush();
  }

  // Returns the weight of view (i, j). The indices are in the orientation of `field`.
  uint32_t WeightOf(const BlockPixels& field, int32_t i, int32_t j) const {
    return field.transposed ? grid_.aperture.Weight(j, i) : grid_.aperture.Weight(i, j);
  }

  // Adds the views of types A and C along the rows of `field`, in the four triangles of the
  // aperture next to the axis of type A. `other` is the transposed field.
  void AddViews(const BlockPixels& field, const BlockPixels& other, uint32_t* accumulators) {
    // Number of samples of a type A view.
    const int64_t samples = 3 * int64_t{field.width} * field.height;
    for (const int sign : {1, -1}) {
      FindAllRuns(field, other, DirectionOf(sign));
      for (int32_t i = 1; i <= grid_.n() && GoesOn(job_.cancel, samples); ++i) {
        const int32_t last = LastAcross(i);
        const Range rows = RowsFor(field, last);
        RenderTypeA(field, sign, i, rows);
        AddColumns(field, sign, i, last, rows, accumulators);
      }
    }
  }

  void FindAllRuns(const BlockPixels& field, const BlockPixels& other, Direction direction) {
    MarkRuns(*scratch_->kernels, run_range_, other.disparity, other.width, field.width,
             field.height, direction, &scratch_->marks);
    for (int32_t row = 0; row < field.height; ++row) {
      scratch_->run_counts[row] = ReadRuns(scratch_->marks, row, field.width, grid_,
                                           scratch_->moves[1], RunsOf(field, row));
    }
  }

  Run* RunsOf(const BlockPixels& field, int32_t row) const {
    return scratch_->runs + static_cast<size_t>(row) * static_cast<size_t>(field.width);
  }

  // Returns the largest j of the type C views (i, j) inside the triangle and the disc.
  int32_t LastAcross(int32_t i) const {
    const int32_t n = grid_.n();
    int32_t j = i - 1;
    while (j > 0 && i * i + j * j > n * n) --j;
    return Max(j, 0);
  }

  // Returns the range of rows that the type C views (i, j) with j <= last read.
  Range RowsFor(const BlockPixels& field, int32_t last) const {
    const Rect& inner = field.inner;
    const int32_t n = grid_.n(), above = inner.y, end = inner.y + inner.height;
    const auto reach = [&](int32_t border) {
      const int32_t splat = last == 0 ? 0 : (border * last + n - 1) / n + 1;
      return Min(border, splat);
    };
    return {inner.y - reach(above), end + reach(field.height - end)};
  }

  // Renders view (sign * i, 0) and the disparities of this view, one line per column of the
  // rectangle.
  void RenderTypeA(const BlockPixels& field, int sign, int32_t i, const Range& rows) {
    const int32_t width = field.inner.width, height = rows.last - rows.first;
    for (int32_t row = 0; row < height; row += kRowsAtOnce) {
      const int32_t count = Min(kRowsAtOnce, height - row);
      SpanList list(*scratch_, scratch_->strip_rgb);
      for (int32_t k = 0; k < count; ++k) {
        RenderRow(field, sign, i, rows.first + row + k, static_cast<uint32_t>(k * width),
                  scratch_->view_disparity + (row + k) * width, &list);
      }
      list.Flush();
      Transpose(scratch_->strip_rgb, 3 * static_cast<size_t>(width), count, width,
                scratch_->columns_rgb + 3 * row, RgbStride(height));
    }
  }

  // Renders a row of view (sign * i, 0) to the list's line, from target pixel `pixel` on.
  void RenderRow(const BlockPixels& field, int sign, int32_t i, int32_t row, uint32_t pixel,
                 int16_t* disparity, SpanList* list) {
    const Line line = {field.Rgb(0, row), field.Disparity(0, row), 1,
                       field.width,       RunsOf(field, row),      scratch_->run_counts[row]};
    HoleFiller holes = HolesOf(field, sign, 0, field.x, field.y + row, 1, 0);
    holes.i = i;
    SpanSink<HoleFiller> sink(line, field.inner.x, pixel, kBlendOne, disparity, holes, list);
    ScanLine(line, DirectionOf(sign), {field.inner.x, field.inner.x + field.inner.width},
             {i, i + 1}, grid_, &sink, [&](int32_t k) { return scratch_->moves[k]; });
  }

  // Adds the views (sign * i, j), |j| <= last, scanned along the columns of the type A view.
  void AddColumns(const BlockPixels& field, int sign, int32_t i, int32_t last, const Range& rows,
                  uint32_t* accumulators) {
    const int32_t width = field.inner.width, height = rows.last - rows.first;
    const int32_t top = field.inner.y - rows.first;
    SpanList list = Accumulating(accumulators);
    for (const int across : {1, -1}) {
      if (across < 0 && last == 0) continue;
      if (last > 0) {
        MarkRuns(*scratch_->kernels, run_range_, scratch_->view_disparity, width, height, width,
                 DirectionOf(across), &scratch_->marks);
      }
      HoleFiller holes =
          HolesOf(field, sign, across, field.x + field.inner.x, field.y + rows.first, 0, 1);
      holes.i = i;
      for (int32_t x = 0; x < width; ++x, ++holes.x) {
        if (!GoesOn(job_.cancel, 3 * int64_t{height} * (last + 1))) return;
        int16_t* rgb = scratch_->columns_rgb + static_cast<size_t>(x) * RgbStride(height);
        const auto first = static_cast<uint32_t>(x * field.inner.height);
        if (across > 0) {
          AddLine(rgb + 3 * top, field.inner.height, WeightOf(field, sign * i, 0), 3 * first,
                  &list);
        }
        if (last == 0) continue;
        const int32_t count =
            ReadRuns(scratch_->marks, x, height, grid_, scratch_->moves[1], scratch_->line_runs);
        const Line line = {rgb,    scratch_->view_disparity + x, width,
                           height, scratch_->line_runs,          count};
        SpanSink<HoleFiller> sink(line, top, first, 0, nullptr, holes, &list);
        ScanLine(line, DirectionOf(across), {top, top + field.inner.height}, {1, last + 1}, grid_,
                 &sink, [&](int32_t j) {
                   holes.j = j;
                   sink.SetWeight(WeightOf(field, sign * i, across * j));
                   return scratch_->moves[j];
                 });
      }
    }
    list.Flush();
  }

  // Adds the type B views on one diagonal of the aperture, inside the disc.
  void TypeB(const BlockPixels& field, bool anti) {
    const int32_t last = LastOnDiagonal(grid_.n());
    if (last == 0) return;
    const Rect& inner = field.inner;
    for (int32_t index = 0; index < field.width + field.height - 1; ++index) {
      const DiagonalLine at = GetDiagonal(field, anti, index);
      const int32_t top = anti ? at.y - (inner.y + inner.height - 1) : inner.y - at.y;
      const int32_t begin = Max(Max(0, inner.x - at.x), top);
      const int32_t end = Min(Min(at.length, inner.x + inner.width - at.x), top + inner.height);
      if (begin >= end) continue;
      if (!GoesOn(job_.cancel, 6 * int64_t{at.length} * last)) return;
      LoadDiagonal(field, anti, at);
      AddDiagonal(field, anti, at, {begin, end}, last);
    }
  }

  // Copies a diagonal of a field to the scratch memory.
  void LoadDiagonal(const BlockPixels& field, bool anti, const DiagonalLine& at) {
    const int32_t down = anti ? -1 : 1;
    for (int32_t t = 0; t < at.length; ++t) {
      const int32_t x = at.x + t, y = at.y + down * t;
      std::memcpy(scratch_->diagonal_rgb + 3 * t, field.Rgb(x, y), 3 * sizeof(int16_t));
      scratch_->diagonal_disparity[t] = *field.Disparity(x, y);
    }
  }

  // Adds the type B views of the pixels `part` of a loaded diagonal.
  void AddDiagonal(const BlockPixels& field, bool anti, const DiagonalLine& at, const Range& part,
                   int32_t last) {
    const int16_t* const disparity = scratch_->diagonal_disparity;
    uint32_t* sums = scratch_->line_accumulators;
    std::memset(sums, 0, 3 * static_cast<size_t>(part.last - part.first) * sizeof(uint32_t));
    SpanList list = Accumulating(sums);
    for (const int sign : {1, -1}) {
      MarkRuns(*scratch_->kernels, run_range_, disparity, 1, at.length, 1, DirectionOf(sign),
               &scratch_->marks);
      const int32_t count =
          ReadRuns(scratch_->marks, 0, at.length, grid_, scratch_->moves[1], scratch_->line_runs);
      const Line line = {scratch_->diagonal_rgb, disparity, 1, at.length,
                         scratch_->line_runs,    count};
      const int across = anti ? -sign : sign;
      HoleFiller holes =
          HolesOf(field, sign, across, field.x + at.x, field.y + at.y, 1, anti ? -1 : 1);
      SpanSink<HoleFiller> sink(line, part.first, 0, 0, nullptr, holes, &list);
      ScanLine(line, DirectionOf(sign), part, {1, last + 1}, grid_, &sink, [&](int32_t k) {
        holes.i = holes.j = k;
        sink.SetWeight(WeightOf(field, sign * k, across * k));
        return scratch_->moves[k];
      });
    }
    list.Flush();
    const Rect& inner = field.inner;
    const int32_t x = at.x + part.first - inner.x;
    const int32_t y = (anti ? at.y - part.first : at.y + part.first) - inner.y;
    const ptrdiff_t step = 3 * (ptrdiff_t{anti ? -inner.width : inner.width} + 1);
    ptrdiff_t target = 3 * (ptrdiff_t{y} * inner.width + x);
    for (int32_t t = part.first; t < part.last; ++t, target += step, sums += 3) {
      for (int c = 0; c < 3; ++c) sums_[target + c] += sums[c];
    }
  }

  // Adds the sums of the pass over rows, which are stored in column order.
  void AddTransposed() {
    const int32_t width = job_.rect.width, height = job_.rect.height;
    for (int32_t y = 0; y < height; ++y) {
      uint32_t* to = sums_ + 3 * static_cast<size_t>(y) * width;
      const uint32_t* from = scratch_->column_sums + 3 * static_cast<size_t>(y);
      for (int32_t x = 0; x < width; ++x, to += 3, from += 3 * static_cast<size_t>(height)) {
        for (int c = 0; c < 3; ++c) to[c] += from[c];
      }
    }
  }

  const RenderJob& job_;
  const ViewGrid& grid_;
  const int16_t run_range_;
  const int32_t half_views_;
  LineScanScratch* scratch_;
  uint32_t* sums_;
};

// Implements Renderer::render for line scans. `scratch` is a LineScanScratch. N > 0.
uint64_t RefocusRectangle(const RenderJob& job, RendererScratch* scratch, uint32_t* sums) {
  Star(job, static_cast<LineScanScratch*>(scratch), sums).Refocus();
  return 3 * PixelsIn(job.rect.width, job.rect.height);
}

int32_t LayerOf(const BlockStats& stats, Demand demand) {
  return LayerByPaper(static_cast<double>(stats.r_min) / (1 << kDisparityBits), demand);
}

// Half of the type A views (on the axes of the aperture, IV-B) are scanned along rows, and half
// along columns. Each type A view is rendered with the border of the other axis. The estimate
// counts half of all views as scanned along rows and half as scanned along columns. Type B views
// are scanned along both axes.
BlockWork MeasureWork(const Rect& rect, const Border& border, const ViewWeights& aperture,
                      const Content (&content)[2], int32_t layer) {
  const Rect field = Extended(rect, border);
  const uint64_t pixels = PixelsIn(rect.width, rect.height);
  const auto all = static_cast<uint64_t>(aperture.views) - 1;
  const uint64_t on_axis = 2 * static_cast<uint64_t>(aperture.n);
  BlockWork work = {};
  work.field = PixelsIn(field.width, field.height);
  work.a = on_axis * (PixelsIn(rect.width, field.height) + PixelsIn(field.width, rect.height));
  work.b = 4 * static_cast<uint64_t>(LastOnDiagonal(aperture.n)) * pixels;
  work.c = (all - 2 * on_axis) * pixels - work.b;
  AddScans(all / 2, rect.height, content[0], layer, &work);
  AddScans(all / 2, rect.width, content[1], layer, &work);
  return work;
}

// In the comments of LineScanScratch, E is `extended`, and R is the side of a superblock.
void TakeScratch(const FullConfig& config, size_t extended, size_t max_n, Arena* arena,
                 RendererScratch* memory) {
  LineScanScratch counted;
  LineScanScratch& scratch = memory == nullptr ? counted : *static_cast<LineScanScratch*>(memory);
  const auto rectangle = static_cast<size_t>(config.superblock);
  const size_t area = extended * extended;
  const size_t rgb_stride = RgbStride(static_cast<int32_t>(extended));
  for (int k = 0; k < 2; ++k) {
    scratch.block_rgb[k] = arena->Take<int16_t>(extended * rgb_stride);
    scratch.block_disparity[k] = arena->Take<int16_t>(area);
  }
  scratch.column_sums = arena->Take<uint32_t>(3 * rectangle * rectangle);
  scratch.diagonal_rgb = arena->Take<int16_t>(3 * extended);
  scratch.diagonal_disparity = arena->Take<int16_t>(extended);
  scratch.moves = arena->Take<int64_t>(max_n + 1);
  scratch.marks.starts = arena->Take<uint16_t>(RunMarkWords(extended, extended));
  scratch.marks.edges = arena->Take<uint16_t>(RunMarkWords(extended, extended));
  scratch.marks.middles = arena->Take<int16_t>(RunMiddles(extended, extended));
  scratch.runs = arena->Take<Run>(area);
  scratch.run_counts = arena->Take<int32_t>(extended);
  scratch.line_runs = arena->Take<Run>(extended);
  scratch.strip_rgb = arena->Take<int16_t>(3 * rectangle * kRowsAtOnce);
  scratch.view_disparity = arena->Take<int16_t>(rectangle * extended);
  scratch.columns_rgb = arena->Take<int16_t>(rectangle * rgb_stride);
  scratch.line_accumulators = arena->Take<uint32_t>(3 * extended);
  scratch.spans = arena->Take<simd::Span>(kSpanCapacity);
  scratch.hole_samples = 6 * extended;
  scratch.holes = arena->Take<int16_t>(scratch.hole_samples);
  scratch.kernels = &simd::BestLineScanKernels();
}

// Largest shift t that leaves a pixel unchanged, in kShiftBits. The pixel stays in place and its
// neighbour has weight 0 if 2 |t| + L <= 1 (SubapertureWeight), where the subaperture L is at most
// |t|. One unit is subtracted from kShiftOne / 3, to allow for rounding.
constexpr int32_t kStill = kShiftOne / 3 - 1;

// Returns false at layers 1 and 2, because blocks at these layers are resampled.
bool NothingMoves(const RenderJob& job) {
  const Input& input = *job.input;
  if (job.layer != 0) return false;
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
  const int32_t left = Clamp(rect.x, 0, input.width - 1);
  const int32_t right = Clamp(rect.x + rect.width, 1, input.width);
  const int32_t top = Clamp(rect.y, 0, input.height - 1);
  const int32_t bottom = Clamp(rect.y + rect.height, 1, input.height);
  for (int32_t y = top; y < bottom; ++y) {
    const int16_t* row = input.disparity.Row(y);
    for (int32_t x = left; x < right; ++x) {
      if (Abs(focus.Distance(row[x])) > limit) return false;
    }
  }
  return true;
}

constexpr starfocus_line_scan kLineScan = {
    {1, false,
     256,  // benchmark mode: largest side of a superblock
     [](double r_max, Demand) { return ViewsByPaper(r_max); }, LayerOf, MakeViewWeights,
     MeasureWork, sizeof(LineScanScratch), TakeScratch, NothingMoves, RefocusRectangle,
     [](const ViewWeights& aperture) { return aperture.sum_bits + kLightBits; }}};

}  // namespace
}  // namespace starfocus

const starfocus_line_scan* starfocus_line_scan_renderer(void) { return &starfocus::kLineScan; }
