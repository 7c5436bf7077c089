#include "lib/star.h"

#include <cstring>
#include <initializer_list>

#include "lib/holes.h"
#include "lib/line_scan.h"
#include "lib/span_sink.h"
#include "lib/spread.h"

namespace starfocus {
namespace {

constexpr uint32_t kBlendOne = 256;

Direction DirectionOf(int sign) {
  return sign > 0 ? Direction::kRightToLeft : Direction::kLeftToRight;
}

// Holes of one line of a view.
struct LineHoles {
  const HoleView& view;
  HoleLine line;

  void Fill(int32_t begin, int32_t end, int32_t disparity, const uint8_t* colour,
            uint8_t* out) const {
    FillHole(view, line, begin, end, disparity, colour, out);
  }
};

// The star over one rectangle. "Along" is the direction of type A's parallax, "across" of type C's.
class Star {
 public:
  Star(const StarJob& job, StarScratch* scratch) : job_(job), grid_(*job.grid), scratch_(scratch) {}

  void Run() {
    Field rows = MakeField(0);
    LoadField(*job_.window, job_.rect, job_.border, &rows);
    const size_t samples = 3 * static_cast<size_t>(job_.rect.width) * job_.rect.height;
    std::memset(scratch_->accumulators[0], 0, samples * sizeof(uint32_t));
    if (!grid_.cells || grid_.n() == 0) AddCentre(rows);
    if (grid_.n() == 0) return;
    for (int32_t i = 0; i <= grid_.n(); ++i) scratch_->moves[i] = grid_.Move(i);
    std::memset(scratch_->accumulators[1], 0, samples * sizeof(uint32_t));
    Field columns = MakeField(1);
    TransposeField(rows, &columns);
    if (!grid_.cells) {
      TypeB(rows, false);
      TypeB(rows, true);
    }
    Triangles(rows, scratch_->accumulators[1]);
    Triangles(columns, scratch_->accumulators[0]);
    AddTransposed();
  }

 private:
  // Rows of a field, those that some views are rendered in.
  struct Rows {
    int32_t begin, end;
  };

  Field MakeField(int orientation) const {
    Field field;
    field.rgb = scratch_->field_rgb[orientation];
    field.disparity = scratch_->field_disparity[orientation];
    return field;
  }

  LineView MakeView(int32_t i, int32_t out_begin, int32_t out_end) const {
    return {&grid_, scratch_->moves[i], scratch_->moves[1], out_begin, out_end};
  }

  // The view (u * i, v * j) in the field's orientation.
  HoleView MakeHoleView(const Field& field, int u, int v, int32_t i, int32_t j) const {
    return {job_.window,
            &grid_,
            field.transposed,
            u,
            v,
            u == 0 ? 0 : scratch_->moves[i],
            v == 0 ? 0 : scratch_->moves[j],
            Max(i, j) <= grid_.half_views};
  }

  SpanList Accumulating(uint32_t* accumulators) const {
    return SpanList(*job_.kernels, scratch_->spans, accumulators);
  }
  SpanList Blending(uint8_t* line) const { return SpanList(*job_.kernels, scratch_->spans, line); }

  // Adds `pixels` pixels with one weight.
  static void AddLine(const uint8_t* rgb, int32_t pixels, uint32_t weight, uint32_t target,
                      SpanList* list) {
    list->Add(
        {rgb, target, 3 * static_cast<uint32_t>(pixels), static_cast<uint16_t>(weight), 0, 0});
  }

  void AddCentre(const Field& rows) {
    const Rect& inner = rows.inner;
    SpanList list = Accumulating(scratch_->accumulators[0]);
    for (int32_t row = 0; row < inner.height; ++row) {
      AddLine(rows.rgb + 3 * rows.Offset(inner.x, inner.y + row), inner.width,
              grid_.aperture.Weight(0, 0), 3u * static_cast<uint32_t>(row * inner.width), &list);
    }
    list.Flush();
  }

  // The triangles on either side of the axis "along": types A and C.
  void Triangles(const Field& field, uint32_t* accumulators) {
    for (const int sign : {1, -1}) {
      FindAllRuns(field, DirectionOf(sign));
      if (grid_.cells && sign > 0) SpreadRows(field);
      // The centre view spreads over both axes like any other, half of it in either order.
      const int32_t first = grid_.cells && sign > 0 ? 0 : 1;
      for (int32_t i = first; i <= grid_.n(); ++i) {
        const int32_t last = LastAcross(i);
        const Rows rows = RowsFor(field, last);
        RenderTypeA(field, sign, i, rows);
        AddColumns(field, sign, i, last, rows, accumulators);
      }
    }
  }

  void FindAllRuns(const Field& field, Direction direction) {
    for (int32_t row = 0; row < field.height; ++row) {
      scratch_->run_counts[row] =
          FindRuns(field.disparity + field.Offset(0, row), field.width, direction, grid_.spread,
                   scratch_->runs + field.Offset(0, row));
    }
  }

  // In place, through columns_rgb: the rows of the field are read by this pass alone.
  void SpreadRows(const Field& field) {
    for (int32_t row = 0; row < field.height; ++row) {
      const size_t offset = field.Offset(0, row);
      uint8_t* rgb = field.rgb + 3 * offset;
      const Line line = {rgb, field.disparity + offset, field.width};
      SpreadLine(*job_.kernels, grid_, scratch_->moves[1], line, scratch_->surface_rgb,
                 scratch_->spread_rgb);
      std::memcpy(rgb, scratch_->spread_rgb, 3 * static_cast<size_t>(field.width));
    }
  }

  // Largest j of the type C views (i, j) inside the disc. With cells, which spread along both axes,
  // the views on the diagonals are rendered like type C, half from either axis, since type B
  // spreads along its diagonal only.
  int32_t LastAcross(int32_t i) const {
    const int32_t n = grid_.n();
    int32_t j = grid_.cells ? i : i - 1;
    while (j > 0 && i * i + j * j > n * n) --j;
    return j;
  }

  // Rows that the type C views (i, j), j <= last, can reach from.
  Rows RowsFor(const Field& field, int32_t last) const {
    const Rect& inner = field.inner;
    const int32_t n = grid_.n(), above = inner.y, end = inner.y + inner.height;
    const auto reach = [&](int32_t border) {
      const int32_t splat = last == 0 ? 0 : (border * last + n - 1) / n + 1;
      return Min(border, splat + (grid_.cells ? simd::kMaxSpread : 0));
    };
    return {inner.y - reach(above), end + reach(field.height - end)};
  }

  // Renders view (sign * i, 0) and its disparity, one line per column of the rectangle.
  void RenderTypeA(const Field& field, int sign, int32_t i, const Rows& rows) {
    const Rect& inner = field.inner;
    const LineView view = MakeView(i, inner.x, inner.x + inner.width);
    const int32_t height = rows.end - rows.begin;
    for (int32_t row = 0; row < height; row += kStripRows) {
      const int32_t count = Min(kStripRows, height - row);
      SpanList list = Blending(scratch_->strip_rgb);
      for (int32_t k = 0; k < count; ++k) {
        RenderRow(field, sign, i, rows.begin + row + k, k, view, &list);
      }
      list.Flush();
      TransposeStrip(inner.width, height, row, count);
    }
  }

  void RenderRow(const Field& field, int sign, int32_t i, int32_t row, int32_t strip_row,
                 const LineView& view, SpanList* list) {
    const size_t offset = field.Offset(0, row);
    const Line line = {field.rgb + 3 * offset, field.disparity + offset, field.width};
    const HoleView hole_view = MakeHoleView(field, sign, 0, i, 0);
    const LineHoles holes = {hole_view, {field.x, field.y + row, 1, 0}};
    const int32_t strip = strip_row * field.inner.width;
    SpanSink<LineHoles> sink(line, view.out_begin - strip, kBlendOne, holes,
                             scratch_->strip_disparity, list);
    ScanLine(line, DirectionOf(sign), scratch_->runs + offset, scratch_->run_counts[row], view,
             &sink);
  }

  // Rows [row, row + count) of the type A view, from the strip to columns of `height` pixels.
  void TransposeStrip(int32_t width, int32_t height, int32_t row, int32_t count) {
    for (int32_t x = 0; x < width; ++x) {
      const size_t column = static_cast<size_t>(x) * height + row;
      const uint8_t* from = scratch_->strip_rgb + 3 * x;
      const int16_t* from_disparity = scratch_->strip_disparity + x;
      uint8_t* to = scratch_->columns_rgb + 3 * column;
      int16_t* to_disparity = scratch_->columns_disparity + column;
      // Four bytes at once where the next pixel's are still to come.
      for (int32_t k = 0; k < count; ++k) {
        std::memcpy(to + 3 * k, from + 3 * k * width, k + 1 < count ? 4 : 3);
        to_disparity[k] = from_disparity[k * width];
      }
    }
  }

  // Adds the views (sign * i, j), |j| <= last, from the columns of the type A view.
  void AddColumns(const Field& field, int sign, int32_t i, int32_t last, const Rows& rows,
                  uint32_t* accumulators) {
    const Rect& inner = field.inner;
    const int32_t height = rows.end - rows.begin, top = inner.y - rows.begin;
    for (int32_t x = 0; x < inner.width; ++x) {
      const size_t column = static_cast<size_t>(x) * height;
      Line line = {scratch_->columns_rgb + 3 * column, scratch_->columns_disparity + column,
                   height};
      const HoleLine hole_line = {field.x + inner.x + x, field.y + rows.begin, 0, 1};
      SpanList list = Accumulating(accumulators + 3 * static_cast<size_t>(x) * inner.height);
      for (const int across : {1, -1}) {
        if (across < 0 && last == 0) continue;
        const int32_t runs = last > 0 ? FindRuns(line.disparity, height, DirectionOf(across),
                                                 grid_.spread, scratch_->line_runs)
                                      : 0;
        if (across > 0) {
          if (grid_.cells) {
            SpreadLine(*job_.kernels, grid_, scratch_->moves[1], line, scratch_->surface_rgb,
                       scratch_->spread_rgb);
            line.rgb = scratch_->spread_rgb;
          }
          // The centre's weight is even: what is left of a power of two by orbits of four and
          // eight.
          const uint32_t weight = grid_.aperture.Weight(i, 0) >> (i == 0 ? 1 : 0);
          AddLine(line.rgb + 3 * top, inner.height, weight, 0, &list);
        }
        for (int32_t j = 1; j <= last; ++j) {
          const LineView view = MakeView(j, top, top + inner.height);
          const HoleView hole_view = MakeHoleView(field, sign, across, i, j);
          const LineHoles holes = {hole_view, hole_line};
          const uint32_t weight = grid_.aperture.Weight(i, j) >> (i == j ? 1 : 0);
          SpanSink<LineHoles> sink(line, top, weight, holes, nullptr, &list);
          ScanLine(line, DirectionOf(across), scratch_->line_runs, runs, view, &sink);
        }
      }
      list.Flush();
    }
  }

  Diagonals GetDiagonals(const Field& field, bool anti) {
    Diagonals diagonals;
    diagonals.rgb = scratch_->diagonal_rgb;
    diagonals.disparity = scratch_->diagonal_disparity;
    diagonals.offsets = scratch_->diagonal_offsets;
    LoadDiagonals(field, anti, &diagonals);
    return diagonals;
  }

  static Line GetLine(const Diagonals& diagonals, int32_t index, int32_t length) {
    const size_t offset = diagonals.offsets[index];
    return {diagonals.rgb + 3 * offset, diagonals.disparity + offset, length};
  }

  // Adds the type B views on one diagonal of the aperture, inside the disc.
  void TypeB(const Field& field, bool anti) {
    int32_t last = 0;
    while (2 * (last + 1) * (last + 1) <= grid_.n() * grid_.n()) ++last;
    if (last == 0) return;
    const Diagonals diagonals = GetDiagonals(field, anti);
    const Rect& inner = field.inner;
    for (int32_t index = 0; index < Diagonals::Count(field); ++index) {
      const DiagonalLine at = GetDiagonal(field, anti, index);
      const int32_t top = anti ? at.y - (inner.y + inner.height - 1) : inner.y - at.y;
      const int32_t begin = Max(Max(0, inner.x - at.x), top);
      const int32_t end = Min(Min(at.length, inner.x + inner.width - at.x), top + inner.height);
      if (begin >= end) continue;
      AddDiagonal(field, diagonals, at, index, begin, end, last);
    }
  }

  void AddDiagonal(const Field& field, const Diagonals& diagonals, const DiagonalLine& at,
                   int32_t index, int32_t begin, int32_t end, int32_t last) {
    const Line line = GetLine(diagonals, index, at.length);
    uint32_t* sums = scratch_->line_accumulators;
    std::memset(sums, 0, 3 * static_cast<size_t>(end - begin) * sizeof(uint32_t));
    SpanList list = Accumulating(sums);
    for (const int sign : {1, -1}) {
      const int32_t runs =
          FindRuns(line.disparity, at.length, DirectionOf(sign), grid_.spread, scratch_->line_runs);
      for (int32_t k = 1; k <= last; ++k) {
        const LineView view = MakeView(k, begin, end);
        const int across = diagonals.anti ? -sign : sign;
        const HoleView hole_view = MakeHoleView(field, sign, across, k, k);
        const LineHoles holes = {hole_view,
                                 {field.x + at.x, field.y + at.y, 1, diagonals.anti ? -1 : 1}};
        SpanSink<LineHoles> sink(line, begin, grid_.aperture.Weight(k, k), holes, nullptr, &list);
        ScanLine(line, DirectionOf(sign), scratch_->line_runs, runs, view, &sink);
      }
    }
    list.Flush();
    const Rect& inner = field.inner;
    for (int32_t t = begin; t < end; ++t) {
      const int32_t x = at.x + t - inner.x;
      const int32_t y = (diagonals.anti ? at.y - t : at.y + t) - inner.y;
      uint32_t* target = scratch_->accumulators[0] + 3 * (static_cast<size_t>(y) * inner.width + x);
      for (int c = 0; c < 3; ++c) target[c] += sums[3 * (t - begin) + c];
    }
  }

  // The pass over columns worked on the transposed rectangle.
  void AddTransposed() {
    const int32_t width = job_.rect.width, height = job_.rect.height;
    for (int32_t y = 0; y < height; ++y) {
      uint32_t* to = scratch_->accumulators[0] + 3 * static_cast<size_t>(y) * width;
      for (int32_t x = 0; x < width; ++x) {
        const uint32_t* from =
            scratch_->accumulators[1] + 3 * (static_cast<size_t>(x) * height + y);
        for (int c = 0; c < 3; ++c) to[3 * x + c] += from[c];
      }
    }
  }

  const StarJob& job_;
  const ViewGrid& grid_;
  StarScratch* scratch_;
};

}  // namespace

void RefocusRectangle(const StarJob& job, StarScratch* scratch) { Star(job, scratch).Run(); }

}  // namespace starfocus
