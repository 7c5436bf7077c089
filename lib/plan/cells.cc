// SPDX-License-Identifier: Apache-2.0
#include "lib/plan/cells.h"

#include <initializer_list>

#include "lib/matting/coverage.h"

namespace starfocus {
namespace {

constexpr int32_t kRadiusOne = 1 << kDisparityBits;

// Returns the largest |d - focus| of all disparities d in [low, high].
int32_t Farthest(int32_t low, int32_t high, int32_t focus) {
  return Max(Abs(low - focus), Abs(high - focus));
}

// In a line scan, a run ends when its pixels drift apart by a quarter pixel (kRunDrift of
// lib/line_scan). A slice covers a larger range of disparities than a run. The timing coefficients
// account for the difference between runs and slices.
constexpr int32_t kRunDrift = kRadiusOne / 4;
constexpr int32_t kLargestGap = 8;

// Returns the disparity that moves a pixel by `distance` (kDisparityBits) in the outermost view.
int32_t DisparityOf(int32_t distance, int64_t step) {
  const int64_t disparity = (int64_t{distance} << kStepBits) / step;
  return static_cast<int32_t>(disparity < INT16_MAX ? disparity : INT16_MAX);
}

void StoreContent(const simd::CellMeasure& measure, int32_t slope_limit, int64_t step, Cell* cell) {
  // The last of the eight steps between pixels of a line leads out of the cell. MeasureCell counts
  // the seven steps inside the cell, so its sums are scaled from seven to eight steps.
  const auto scaled = [](uint32_t sum, uint32_t one) {
    return static_cast<uint16_t>(sum * kContentOne * kCellSize / (one * (kCellSize - 1)));
  };
  const auto slope = static_cast<uint32_t>(Max(1, slope_limit));
  for (int along = 0; along < 2; ++along) {
    cell->slopes[along] = scaled(measure.slopes[along], slope);
    if (measure.edges[along] == 0) continue;
    cell->edges[along] = scaled(measure.edges[along], 1);
    const int64_t gaps = measure.gaps[along] * step >> kStepBits;
    cell->gaps[along] = scaled(static_cast<uint32_t>(gaps), kRadiusOne);
  }
}

uint8_t BeyondOf(int32_t reach) {
  return static_cast<uint8_t>(Checked(ranges::kReach, reach) + kCellSize);
}

// Stores the reach of a cell in which all pixels have equal reach.
void StoreSides(int32_t reach, Cell* cell) {
  for (int side = 0; side < 4; ++side) {
    cell->beyond[side] = BeyondOf(reach);
    cell->inside[side] = static_cast<uint8_t>(Min(reach, kCellSize));
  }
}

// Measures how far 8 columns or rows of disparities splat beyond two opposite sides of the cell,
// and how deep inside the cell the splatting pixels lie.
void MeasureSides(const BlurScale& scale, const int16_t (&lows)[kCellSize],
                  const int16_t (&highs)[kCellSize], Side low, Side high, Cell* cell) {
  for (int32_t k = 0; k < kCellSize; ++k) {
    const int32_t distance = Farthest(lows[k], highs[k], scale.focus.far);
    const int32_t reach = ReachOf(scale.RadiusAbove(distance));
    const int32_t beyond_low = reach - k, beyond_high = reach - (kCellSize - 1 - k);
    cell->beyond[low] = Max(cell->beyond[low], BeyondOf(beyond_low));
    cell->beyond[high] = Max(cell->beyond[high], BeyondOf(beyond_high));
    if (beyond_low > 0) cell->inside[low] = static_cast<uint8_t>(Max(cell->inside[low], k + 1));
    if (beyond_high > 0) {
      cell->inside[high] = static_cast<uint8_t>(Max(cell->inside[high], kCellSize - k));
    }
  }
}

// Measures the cells of one row.
class CellRow {
 public:
  CellRow(const simd::Kernels& kernels, const Input& input, const BlurScale& scale, int32_t row)
      : kernels_(kernels),
        input_(input),
        scale_(scale),
        y_(row * kCellSize),
        near_focus_(Clamp(scale.focus.far, INT16_MIN, INT16_MAX)),
        limits_{static_cast<int16_t>(near_focus_), kSurfaceStep,
                static_cast<int16_t>(DisparityOf(kRunDrift, scale.step)),
                static_cast<int16_t>(DisparityOf(kLargestGap * kRadiusOne, scale.step))} {
    for (int32_t k = 0; k < kRows; ++k) {
      rows_[k] = input.disparity.Row(Clamp(row * kCellSize + k - 1, 0, input.height - 1));
    }
  }

  // Writes the measure of a cell to `cell`, which is zero.
  void Measure(int32_t column, Cell* cell) const {
    const int32_t x = column * kCellSize;
    Pixels pixels;
    LoadPixels(x, &pixels);
    simd::CellMeasure found;
    kernels_.MeasureCell(pixels.rows, pixels.column, limits_, &found);
    const CoverageTile* const thin = input_.coverage != nullptr ? ThinTile(x) : nullptr;
    if (thin != nullptr) AddThin(*thin, &found);
    cell->low = found.low;
    cell->high = found.high;
    // The SIMD kernel measures distances from a focus that is clamped to int16. A focus outside
    // int16 lies on one side of all disparities, so the clamped part of the distance is added.
    const int32_t focus = scale_.focus.far;
    const int32_t nearest = found.nearest + Abs(focus - near_focus_);
    const int32_t farthest = Farthest(found.low, found.high, focus);
    const int32_t r_min = scale_.Radius(nearest), r_max = scale_.RadiusAbove(farthest);
    cell->r_min = static_cast<uint16_t>(r_min);
    cell->r_max = static_cast<uint16_t>(r_max);
    int32_t shown = r_min;
    if (found.edge_low <= found.edge_high) {
      const int32_t sharpest = Abs(focus - Clamp(focus, found.edge_low, found.edge_high));
      shown = Min(shown, scale_.Radius(sharpest));
      cell->has_edge = 1;
    }
    cell->r_shown = static_cast<uint16_t>(shown) & 0x7FFF;
    const int32_t reach = ReachOf(r_max);
    if (reach == ReachOf(scale_.RadiusAbove(nearest))) {
      StoreSides(reach, cell);
    } else {
      simd::CellLines lines;
      kernels_.MeasureLines(pixels.rows, pixels.column, &lines);
      if (thin != nullptr) WidenLines(*thin, &lines);
      MeasureSides(scale_, lines.column_low, lines.column_high, kLeft, kRight, cell);
      MeasureSides(scale_, lines.row_low, lines.row_high, kTop, kBottom, cell);
    }
    StoreContent(found, limits_.slope_limit, scale_.step, cell);
  }

 private:
  static constexpr int32_t kRows = kCellSize + 2;

  // Disparities without the range in focus of a cell and its neighbours, which begin at `column` of
  // the rows.
  struct Pixels {
    const int16_t* const* rows;
    size_t column;
    const int16_t* copied_rows[kRows];
    int16_t copies[kRows][kRows];
  };

  // Loads the cell at column x of the picture. Pixels outside the picture repeat its edge.
  void LoadPixels(int32_t x, Pixels* pixels) const {
    pixels->rows = rows_;
    pixels->column = static_cast<size_t>(x);
    if (x > 0 && x + kCellSize < input_.width && scale_.focus.IsSingle()) return;
    for (int32_t k = 0; k < kRows; ++k) {
      for (int32_t column = 0; column < kRows; ++column) {
        const int32_t from = Clamp(x + column - 1, 0, input_.width - 1);
        pixels->copies[k][column] = scale_.focus.WithoutRange(rows_[k][from]);
      }
      pixels->copied_rows[k] = pixels->copies[k];
    }
    pixels->rows = pixels->copied_rows;
    pixels->column = 1;
  }

  // Returns the tile of the coverage at column x of the picture if it has thin structures,
  // otherwise null.
  const CoverageTile* ThinTile(int32_t x) const {
    const CoverageTile& tile = input_.coverage->Tile(x / kCoverageTile, y_ / kCoverageTile);
    return tile.thin == 0 || tile.low > tile.high ? nullptr : &tile;
  }

  // Adds the disparities of thin structures to the range of disparities [*low, *high].
  void Widen(const CoverageTile& thin, int16_t* low, int16_t* high) const {
    *low = static_cast<int16_t>(Min(*low, scale_.focus.WithoutRange(thin.low)));
    *high = static_cast<int16_t>(Max(*high, scale_.focus.WithoutRange(thin.high)));
  }

  // A cell with thin structures contains a near and a far surface, and therefore a depth edge.
  void AddThin(const CoverageTile& thin, simd::CellMeasure* found) const {
    Widen(thin, &found->low, &found->high);
    Widen(thin, &found->edge_low, &found->edge_high);
    for (const int16_t of_thin : {thin.low, thin.high}) {
      const int32_t distance = Abs(scale_.focus.WithoutRange(of_thin) - near_focus_);
      found->nearest = static_cast<uint16_t>(Min(found->nearest, Min(distance, UINT16_MAX)));
    }
  }

  void WidenLines(const CoverageTile& thin, simd::CellLines* lines) const {
    for (int32_t k = 0; k < kCellSize; ++k) {
      Widen(thin, &lines->column_low[k], &lines->column_high[k]);
      Widen(thin, &lines->row_low[k], &lines->row_high[k]);
    }
  }

  const simd::Kernels& kernels_;
  const Input& input_;
  const BlurScale& scale_;
  const int32_t y_;  // first row of pixels of the cells
  const int32_t near_focus_;
  const simd::CellLimits limits_;
  // Rows of disparities in the cells, plus one row above and one row below.
  const int16_t* rows_[kRows];
};

void AddContent(const Content (&part)[2], Content (*sum)[2]) {
  for (int along = 0; along < 2; ++along) {
    (*sum)[along].slopes += part[along].slopes;
    (*sum)[along].edges += part[along].edges;
    (*sum)[along].gaps += part[along].gaps;
  }
}

}  // namespace

void AddCell(const Cell& cell, Content (*sum)[2]) {
  const Content part[2] = {{cell.slopes[0], cell.edges[0], cell.gaps[0]},
                           {cell.slopes[1], cell.edges[1], cell.gaps[1]}};
  AddContent(part, sum);
}

void MeasureCells(const simd::Kernels& kernels, const Input& input, const BlurScale& scale,
                  int32_t row, const Range& columns, Cell* cells) {
  const CellRow measure(kernels, input, scale, row);
  for (int32_t column = columns.first; column < columns.last; ++column) {
    *cells = {};
    measure.Measure(column, cells++);
  }
}

bool IsUneven(const Input& input, const BlurScale& scale, const Rect& rect) {
  int32_t low = INT32_MAX, high = INT32_MIN;
  ForPixels(rect, [&](int32_t x, int32_t y) {
    const int32_t disparity = scale.focus.WithoutRange(input.disparity.Row(y)[x]);
    low = Min(low, disparity);
    high = Max(high, disparity);
  });
  return scale.step * (high - low) > int64_t{kLampRange} << kStepBits;
}

BlockStats MergeBlocks(const BlockStats* const children[4], int32_t side) {
  BlockStats merged = {INT32_MAX, INT32_MAX, 0, false, {}, {}};
  for (int child = 0; child < 4; ++child) {
    if (children[child] == nullptr) continue;
    const BlockStats& from = *children[child];
    const int32_t right = child & 1, bottom = child >> 1;
    merged.r_min = Min(merged.r_min, from.r_min);
    merged.r_shown = Min(merged.r_shown, from.r_shown);
    merged.r_max = Max(merged.r_max, from.r_max);
    merged.has_edge = merged.has_edge || from.has_edge;
    AddContent(from.content, &merged.content);
    for (int layer = 0; layer < 3; ++layer) {
      Border& border = merged.border[layer];
      const Border& part = from.border[layer];
      border.left = Max(border.left, part.left - right * side);
      border.right = Max(border.right, part.right - (1 - right) * side);
      border.top = Max(border.top, part.top - bottom * side);
      border.bottom = Max(border.bottom, part.bottom - (1 - bottom) * side);
    }
  }
  return merged;
}

}  // namespace starfocus
