#include "lib/star.h"

#include <cstring>
#include <initializer_list>

#include "lib/holes.h"
#include "lib/line_scan.h"
#include "lib/span_sink.h"

namespace starfocus {
namespace {

constexpr uint32_t kBlendOne = 256;

Direction DirectionOf(int sign) {
  return sign > 0 ? Direction::kRightToLeft : Direction::kLeftToRight;
}

// Holes of types A and B: from the captured views.
struct CapturedHoles {
  const CapturedLine& line;
  const LineView& view;

  void Fill(int32_t begin, int32_t end, int32_t disparity, const uint8_t* colour,
            uint8_t* out) const {
    FillHole(line, *view.grid, begin, end, disparity, view.grid->Shift(view.move, disparity),
             colour, out);
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
    AddCentre(rows);
    if (grid_.n() == 0) return;
    for (int32_t i = 0; i <= grid_.n(); ++i) scratch_->moves[i] = grid_.Move(i);
    std::memset(scratch_->accumulators[1], 0, samples * sizeof(uint32_t));
    Triangles(rows, scratch_->accumulators[1]);
    TypeB(rows, false);
    TypeB(rows, true);
    Field columns = MakeField(1);
    TransposeField(rows, &columns);
    Triangles(columns, scratch_->accumulators[0]);
    AddTransposed();
  }

 private:
  // Rows of a field, those that some views are rendered in.
  struct Rows {
    int32_t begin, end;
  };

  // The type B view (sign * i, t * i) that fills holes of the type C views between it and the type
  // A view: rendered when the first hole asks for it.
  struct Corner {
    Star* star;
    const Field* field;
    int sign, across_sign;
    int32_t i;
    Rows rows;
    bool rendered;

    const uint8_t* Column(int32_t column) {
      if (!rendered) star->RenderCorner(*this);
      rendered = true;
      return Memory(*star->scratch_) + 3 * static_cast<size_t>(column) * (rows.end - rows.begin);
    }
    uint8_t* Memory(const StarScratch& scratch) const {
      return scratch.corner_rgb[across_sign > 0];
    }
  };

  // Holes of type C along a column.
  struct CornerHoles {
    Corner* corner;
    const LineView& view;
    int64_t corner_move;
    int32_t column;

    void Fill(int32_t begin, int32_t end, int32_t disparity, const uint8_t*, uint8_t* out) const {
      const ViewGrid& grid = *view.grid;
      const int32_t shift = grid.Shift(view.move, disparity) - grid.Shift(corner_move, disparity);
      const auto moved = corner->across_sign * static_cast<int32_t>(RoundShift(shift, kShiftBits));
      const uint8_t* pixels = corner->Column(column);
      const int32_t last = corner->rows.end - corner->rows.begin - 1;
      for (int32_t p = begin; p < end; ++p, out += 3) {
        std::memcpy(out, pixels + 3 * Clamp(p + moved, 0, last), 3);
      }
    }
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
    diagonals_loaded_[0] = diagonals_loaded_[1] = false;
    for (const int sign : {1, -1}) {
      FindAllRuns(field, DirectionOf(sign));
      for (int32_t i = 1; i <= grid_.n(); ++i) {
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

  // Largest j of the type C views (i, j) inside the disc.
  int32_t LastAcross(int32_t i) const {
    const int32_t n = grid_.n();
    int32_t j = i - 1;
    while (j > 0 && i * i + j * j > n * n) --j;
    return j;
  }

  // Rows that the type C views (i, j), j <= last, can reach from.
  Rows RowsFor(const Field& field, int32_t last) const {
    const Rect& inner = field.inner;
    const int32_t n = grid_.n(), above = inner.y, end = inner.y + inner.height;
    const auto reach = [&](int32_t border) {
      return last == 0 ? 0 : Min(border, (border * last + n - 1) / n + 1);
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
    const CapturedLine captured = {job_.window, field.transposed,     field.x, field.y + row, 1, 0,
                                   sign,        i <= grid_.half_views};
    const int32_t strip = strip_row * field.inner.width;
    const CapturedHoles holes{captured, view};
    SpanSink<CapturedHoles> sink(line, view.out_begin - strip, kBlendOne, holes,
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
    Corner corners[2] = {{this, &field, sign, -1, i, rows, false},
                         {this, &field, sign, 1, i, rows, false}};
    for (int32_t x = 0; x < inner.width; ++x) {
      const size_t column = static_cast<size_t>(x) * height;
      const Line line = {scratch_->columns_rgb + 3 * column, scratch_->columns_disparity + column,
                         height};
      SpanList list = Accumulating(accumulators + 3 * static_cast<size_t>(x) * inner.height);
      AddLine(line.rgb + 3 * top, inner.height, grid_.aperture.Weight(i, 0), 0, &list);
      for (const int across : {1, -1}) {
        if (last > 0) AddTypeC(line, x, &corners[across > 0], last, &list);
      }
      list.Flush();
    }
  }

  void AddTypeC(const Line& line, int32_t column, Corner* corner, int32_t last, SpanList* list) {
    const int32_t top = corner->field->inner.y - corner->rows.begin;
    const Direction direction = DirectionOf(corner->across_sign);
    const int32_t runs =
        FindRuns(line.disparity, line.length, direction, grid_.spread, scratch_->line_runs);
    for (int32_t j = 1; j <= last; ++j) {
      const LineView view = MakeView(j, top, top + corner->field->inner.height);
      const CornerHoles holes{corner, view, scratch_->moves[corner->i], column};
      SpanSink<CornerHoles> sink(line, view.out_begin, grid_.aperture.Weight(corner->i, j), holes,
                                 nullptr, list);
      ScanLine(line, direction, scratch_->line_runs, runs, view, &sink);
    }
  }

  Diagonals GetDiagonals(const Field& field, bool anti) {
    Diagonals diagonals;
    diagonals.anti = anti;
    diagonals.rgb = scratch_->diagonal_rgb[anti];
    diagonals.disparity = scratch_->diagonal_disparity[anti];
    diagonals.offsets = scratch_->diagonal_offsets[anti];
    if (!diagonals_loaded_[anti]) LoadDiagonals(field, anti, &diagonals);
    diagonals_loaded_[anti] = true;
    return diagonals;
  }

  static Line GetLine(const Diagonals& diagonals, int32_t index, int32_t length) {
    const size_t offset = diagonals.offsets[index];
    return {diagonals.rgb + 3 * offset, diagonals.disparity + offset, length};
  }

  CapturedLine Captured(const Field& field, const DiagonalLine& at, bool anti, int sign,
                        int32_t i) const {
    return {job_.window, field.transposed, field.x + at.x, field.y + at.y,
            1,           anti ? -1 : 1,    sign,           i <= grid_.half_views};
  }

  // Renders the columns of the rectangle, in the corner's rows, of a type B view.
  // Runs in the middle of a type C scan: it must not touch line_runs or the spans in waiting.
  void RenderCorner(const Corner& corner) {
    const Field& field = *corner.field;
    const bool anti = corner.sign != corner.across_sign;
    const Diagonals diagonals = GetDiagonals(field, anti);
    uint8_t* columns = corner.Memory(*scratch_);
    for (int32_t index = 0; index < Diagonals::Count(field); ++index) {
      const DiagonalLine at = GetDiagonal(field, anti, index);
      const Rows& rows = corner.rows;
      const int32_t top = anti ? at.y - (rows.end - 1) : rows.begin - at.y;
      const int32_t begin = Max(Max(0, field.inner.x - at.x), top);
      const int32_t end = Min(Min(at.length, field.inner.x + field.inner.width - at.x),
                              top + rows.end - rows.begin);
      if (begin >= end) continue;
      const Line line = GetLine(diagonals, index, at.length);
      const int32_t runs = FindRuns(line.disparity, at.length, DirectionOf(corner.sign),
                                    grid_.spread, scratch_->corner_runs);
      const LineView view = MakeView(corner.i, begin, end);
      const CapturedLine captured = Captured(field, at, anti, corner.sign, corner.i);
      const CapturedHoles holes{captured, view};
      SpanList list(*job_.kernels, scratch_->corner_spans, scratch_->line_rgb);
      SpanSink<CapturedHoles> sink(line, begin, kBlendOne, holes, nullptr, &list);
      ScanLine(line, DirectionOf(corner.sign), scratch_->corner_runs, runs, view, &sink);
      list.Flush();
      for (int32_t t = begin; t < end; ++t) {
        const int32_t x = at.x + t - field.inner.x;
        const int32_t y = (anti ? at.y - t : at.y + t) - rows.begin;
        std::memcpy(columns + 3 * (static_cast<size_t>(x) * (rows.end - rows.begin) + y),
                    scratch_->line_rgb + 3 * (t - begin), 3);
      }
    }
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
        const CapturedLine captured = Captured(field, at, diagonals.anti, sign, k);
        const CapturedHoles holes{captured, view};
        SpanSink<CapturedHoles> sink(line, begin, grid_.aperture.Weight(k, k), holes, nullptr,
                                     &list);
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
  bool diagonals_loaded_[2] = {false, false};
};

}  // namespace

void RefocusRectangle(const StarJob& job, StarScratch* scratch) { Star(job, scratch).Run(); }

}  // namespace starfocus
