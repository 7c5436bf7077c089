#include "lib/cells.h"

#include <initializer_list>

namespace starfocus {
namespace {

constexpr int32_t kRadiusOne = 1 << kDisparityBits;

// Pixels that blur of radius r (kDisparityBits) reaches, with half a pixel of rounding.
int32_t ReachOf(int32_t r) { return (r + kRadiusOne / 2 + kRadiusOne - 1) >> kDisparityBits; }

// What the kernel finds, with the picture's edge repeated around it.
simd::CellMeasure Measure(const simd::Kernels& kernels, const Window& window,
                          const simd::CellLimits& limits, int32_t x, int32_t y) {
  const int16_t* rows[kCellSize + 2];
  int16_t copies[kCellSize + 2][kCellSize + 2];
  const bool inside =
      x > 0 && y > 0 && x + kCellSize < window.width && y + kCellSize < window.height;
  for (int32_t row = 0; row < kCellSize + 2; ++row) {
    const int16_t* from = window.disparity.Row(Clamp(y + row - 1, 0, window.height - 1));
    rows[row] = from + x;
    if (inside) continue;
    for (int32_t column = 0; column < kCellSize + 2; ++column) {
      copies[row][column] = from[Clamp(x + column - 1, 0, window.width - 1)];
    }
    rows[row] = copies[row] + 1;
  }
  simd::CellMeasure measure;
  kernels.measure_cell(rows, limits, &measure);
  return measure;
}

// Largest |d - focus| of disparities in [low, high].
int32_t Farthest(int32_t low, int32_t high, int32_t focus) {
  return Max(Abs(low - focus), Abs(high - focus));
}

// By the paper's rule a run ends when its pixels drift apart by a quarter pixel (kRunSpread of
// view_grid.cc). Slices range over more: coefficients tell what a step costs by either rule.
constexpr int32_t kRunDrift = kRadiusOne / 4;
constexpr int32_t kLargestGap = 8;

// Disparity that moves by `distance` (kDisparityBits of a pixel) in the outermost view.
int32_t DisparityOf(int32_t distance, int64_t step) {
  const int64_t disparity = (int64_t{distance} << kStepBits) / step;
  return static_cast<int32_t>(disparity < INT16_MAX ? disparity : INT16_MAX);
}

void StoreContent(const simd::CellMeasure& measure, int32_t slope_limit, int64_t step, Cell* cell) {
  // One step in eight leads out of the cell, and is made up for.
  const auto scaled = [](int64_t sum, int64_t one) {
    return static_cast<uint16_t>(sum * kContentOne * kCellSize / (one * (kCellSize - 1)));
  };
  for (int along = 0; along < 2; ++along) {
    cell->slopes[along] = scaled(measure.slopes[along], Max(1, slope_limit));
    cell->edges[along] = scaled(measure.edges[along], 1);
    cell->gaps[along] = scaled(measure.gaps[along] * step >> kStepBits, kRadiusOne);
  }
}

// Reach beyond either end of a line of 8 columns or rows, and the depth inside.
void MeasureSides(const BlurScale& scale, const int32_t (&distance)[kCellSize], Side low, Side high,
                  Cell* cell) {
  for (int32_t k = 0; k < kCellSize; ++k) {
    const int32_t reach = ReachOf(scale.RadiusAbove(distance[k]));
    const int32_t beyond_low = reach - k, beyond_high = reach - (kCellSize - 1 - k);
    cell->reach[low] =
        static_cast<int16_t>(Max(cell->reach[low], Checked(ranges::kReach, beyond_low)));
    cell->reach[high] =
        static_cast<int16_t>(Max(cell->reach[high], Checked(ranges::kReach, beyond_high)));
    if (beyond_low > 0) cell->inside[low] = static_cast<uint8_t>(Max(cell->inside[low], k + 1));
    if (beyond_high > 0) {
      cell->inside[high] = static_cast<uint8_t>(Max(cell->inside[high], kCellSize - k));
    }
  }
}

// The cell at a position outside the picture: a repetition of the edge, placed anywhere inside.
Cell OutsideCell(const Cell& edge) {
  Cell cell = edge;
  for (int side = 0; side < 4; ++side) {
    cell.reach[side] = static_cast<int16_t>(ReachOf(edge.r_max));
    cell.inside[side] = kCellSize;
  }
  return cell;
}

// Cells between a block of two cells at `block` and the cell at `cell`, in pixels; negative when
// the cell lies on the block's own columns (rows).
int32_t GapOf(int32_t cell, int32_t block) {
  if (cell < block) return (block - cell - 1) * kCellSize;
  if (cell > block + 1) return (cell - block - 2) * kCellSize;
  return -1;
}

// Widens border for a cell `gap` pixels away on one side, if it reaches the block across both gaps.
void Widen(int32_t gap, int32_t inside, bool low, int32_t* low_border, int32_t* high_border) {
  if (gap < 0) return;
  int32_t* border = low ? low_border : high_border;
  *border = Max(*border, gap + inside);
}

// What lies within reach of each of 2x2 cells.
class Surroundings {
 public:
  Surroundings(const CellGrid& grid, int32_t column, int32_t row) {
    for (int32_t k = 0; k < 4; ++k) {
      Around& around = around_[k];
      around.column = column + (k & 1);
      around.row = row + (k >> 1);
      const Cell& cell =
          *grid.At(Min(around.column, grid.columns - 1), Min(around.row, grid.rows - 1));
      around.reach = ReachOf(cell.r_max);
      reach_ = Max(reach_, around.reach);
    }
  }

  // The cell at (column, row), `gap` pixels away from all four; negative: one of them.
  void Add(const Cell& cell, int32_t column, int32_t row, int32_t gap) {
    const int32_t reach = ReachOf(cell.r_max);
    if (gap >= Max(reach_, reach)) return;
    for (Around& around : around_) {
      const int32_t cells = Max(Abs(column - around.column), Abs(row - around.row));
      if ((cells - 1) * kCellSize >= Max(around.reach, reach)) continue;
      around.low = Min(around.low, cell.low);
      around.high = Max(around.high, cell.high);
      around.widest = Max(around.widest, cell.high - cell.low);
      around.edge = around.edge || cell.r_edge != 0;
    }
  }

  uint32_t Smooth(const BlurScale& scale) const {
    uint32_t smooth = 0;
    for (int32_t k = 0; k < 4; ++k) {
      const Around& around = around_[k];
      const int32_t range = around.high - around.low;
      const int32_t blur = Max(Abs(around.low - scale.focus), Abs(around.high - scale.focus));
      // A slope goes on from cell to cell.
      const bool step = 2 * around.widest > range;
      const int32_t limit = step ? Max(scale.Radius(blur) / 2, kSharpSmoothRange) : kSmoothRange;
      const int64_t most = int64_t{Min(limit, kSmoothRange)} << kStepBits;
      if (!around.edge && scale.step * range <= most) smooth |= 1u << k;
    }
    return smooth;
  }

 private:
  struct Around {
    int32_t column, row;  // of the cell itself
    int32_t reach;        // of its blur, pixels
    int32_t low = INT32_MAX, high = INT32_MIN;
    int32_t widest = 0;  // range of a cell
    bool edge = false;
  };
  Around around_[4];
  int32_t reach_ = 0;
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

Cell MeasureCell(const simd::Kernels& kernels, const Window& window, const BlurScale& scale,
                 int32_t column, int32_t row) {
  const int32_t focus = scale.focus;
  const int32_t near_focus = Clamp(focus, INT16_MIN, INT16_MAX);
  const simd::CellLimits limits = {
      static_cast<int16_t>(near_focus), kSurfaceStep,
      static_cast<int16_t>(DisparityOf(kRunDrift, scale.step)),
      static_cast<int16_t>(DisparityOf(kLargestGap * kRadiusOne, scale.step))};
  const simd::CellMeasure found =
      Measure(kernels, window, limits, column * kCellSize, row * kCellSize);
  Cell cell = {};
  cell.low = INT16_MAX;
  cell.high = INT16_MIN;
  int32_t largest = 0, distance_x[kCellSize], distance_y[kCellSize];
  for (int32_t k = 0; k < kCellSize; ++k) {
    distance_x[k] = Farthest(found.column_low[k], found.column_high[k], focus);
    distance_y[k] = Farthest(found.row_low[k], found.row_high[k], focus);
    largest = Max(largest, distance_x[k]);
    if (found.column_low[k] < cell.low) cell.low = found.column_low[k];
    if (found.column_high[k] > cell.high) cell.high = found.column_high[k];
  }
  // A focus beyond int16 lies beyond every disparity, all on one side of it.
  cell.r_min = static_cast<uint16_t>(scale.Radius(found.nearest + Abs(focus - near_focus)));
  cell.r_max = static_cast<uint16_t>(scale.RadiusAbove(largest));
  cell.r_edge = static_cast<uint16_t>(
      found.edge_low > found.edge_high
          ? 0
          : scale.RadiusAbove(Farthest(found.edge_low, found.edge_high, focus)));
  for (int16_t& reach : cell.reach) reach = INT16_MIN;
  MeasureSides(scale, distance_x, kLeft, kRight, &cell);
  MeasureSides(scale, distance_y, kTop, kBottom, &cell);
  StoreContent(found, limits.slope_limit, scale.step, &cell);
  return cell;
}

BlockStats MeasureBlock(const CellGrid& grid, int32_t column, int32_t row, int32_t around) {
  BlockStats stats = {INT32_MAX, 0, 0, {}, {}};
  for (int32_t y = row - around; y <= row + 1 + around; ++y) {
    for (int32_t x = column - around; x <= column + 1 + around; ++x) {
      const int32_t cx = Clamp(x, 0, grid.columns - 1), cy = Clamp(y, 0, grid.rows - 1);
      const Cell& stored = *grid.At(cx, cy);
      const bool outside = cx != x || cy != y;
      const int32_t gap_x = GapOf(x, column), gap_y = GapOf(y, row);
      if (gap_x < 0 && gap_y < 0) {
        stats.r_min = Min(stats.r_min, stored.r_min);
        stats.r_max = Max(stats.r_max, stored.r_max);
        stats.r_edge = Max(stats.r_edge, stored.r_edge);
        if (!outside) AddCell(stored, &stats.content);
        continue;
      }
      if (Max(gap_x, gap_y) >= ReachOf(stored.r_max) + kLayerMargin[2]) continue;
      const Cell cell = outside ? OutsideCell(stored) : stored;
      // Towards the block: a cell on its left reaches to the right.
      const Side side_x = x < column ? kRight : kLeft, side_y = y < row ? kBottom : kTop;
      // What does not reach the wider margin of a layer reaches no narrower one.
      for (int layer = 2; layer >= 0; --layer) {
        const int32_t margin = kLayerMargin[layer];
        if (gap_x >= 0 && cell.reach[side_x] + margin <= gap_x) break;
        if (gap_y >= 0 && cell.reach[side_y] + margin <= gap_y) break;
        if (layer == 0) {
          stats.r_max = Max(stats.r_max, cell.r_max);
          stats.r_edge = Max(stats.r_edge, cell.r_edge);
        }
        Border& border = stats.border[layer];
        const int32_t inside_x = margin == 0 ? cell.inside[side_x] : kCellSize;
        const int32_t inside_y = margin == 0 ? cell.inside[side_y] : kCellSize;
        Widen(gap_x, inside_x, x < column, &border.left, &border.right);
        Widen(gap_y, inside_y, y < row, &border.top, &border.bottom);
      }
    }
  }
  return stats;
}

uint32_t FindSmooth(const CellGrid& grid, const BlurScale& scale, int32_t column, int32_t row,
                    int32_t around) {
  Surroundings surroundings(grid, column, row);
  for (int32_t y = row - around; y <= row + 1 + around; ++y) {
    for (int32_t x = column - around; x <= column + 1 + around; ++x) {
      const Cell& cell = *grid.At(Clamp(x, 0, grid.columns - 1), Clamp(y, 0, grid.rows - 1));
      surroundings.Add(cell, x, y, Max(GapOf(x, column), GapOf(y, row)));
    }
  }
  return surroundings.Smooth(scale);
}

BlockStats MergeBlocks(const BlockStats* const children[4], int32_t side) {
  BlockStats merged = {INT32_MAX, 0, 0, {}, {}};
  for (int child = 0; child < 4; ++child) {
    if (children[child] == nullptr) continue;
    const BlockStats& from = *children[child];
    const int32_t right = child & 1, bottom = child >> 1;
    merged.r_min = Min(merged.r_min, from.r_min);
    merged.r_max = Max(merged.r_max, from.r_max);
    merged.r_edge = Max(merged.r_edge, from.r_edge);
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
