#include "lib/cells.h"

namespace starfocus {
namespace {

constexpr int32_t kRadiusOne = 1 << kDisparityBits;

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
