// SPDX-License-Identifier: Apache-2.0
// Vector code of the functions in cells.h. This file is included once per SIMD target.
#include "simd/cells.h"
#include "simd/highway-inl.h"

HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

// The vector code stores vectors in arrays and structs, and therefore requires vectors whose size
// is known at compile time.
#if HWY_TARGET == HWY_SCALAR || HWY_HAVE_SCALABLE

using reference::MeasureCell;
using reference::MeasureLines;
using reference::ReachBlock;
using reference::SurroundCells;

#else

// Each vector holds one row of a cell.
using CellTag = hn::FixedTag<int16_t, 8>;
using CellRow = hn::Vec<CellTag>;
using UnsignedTag = hn::RebindToUnsigned<CellTag>;
using UnsignedRow = hn::Vec<UnsignedTag>;

// Returns |a - b|, which may require all 16 bits.
HWY_INLINE UnsignedRow Distance(CellRow a, CellRow b) {
  const UnsignedTag du16;
  return hn::Sub(hn::BitCast(du16, hn::Max(a, b)), hn::BitCast(du16, hn::Min(a, b)));
}

// Returns |a - b|, or a number from 32767 on if |a - b| is larger. All limits of steps are smaller.
HWY_INLINE UnsignedRow StepOf(CellRow a, CellRow b) {
#if HWY_ARCH_ARM  // compilers use one instruction for Distance
  return Distance(a, b);
#else
  return hn::BitCast(UnsignedTag(), hn::Abs(hn::SaturatedSub(a, b)));
#endif
}

// Reduces each of eight vectors to its minimum or maximum; `take` is hn::Min or hn::Max. Lane k of
// the result is the reduction of vector k.
template <class Take>
HWY_INLINE CellRow ReduceRows(const CellRow (&rows)[8], const Take& take) {
  const CellTag d16;
  const hn::Repartition<int32_t, CellTag> d32;
  const hn::Repartition<int64_t, CellTag> d64;
  CellRow pairs[4];
  for (int k = 0; k < 4; ++k) {
    const auto a = rows[2 * k], b = rows[2 * k + 1];
    pairs[k] = take(hn::InterleaveLower(d16, a, b), hn::InterleaveUpper(d16, a, b));
  }
  CellRow quads[2];
  for (int k = 0; k < 2; ++k) {
    const auto a = hn::BitCast(d32, pairs[2 * k]), b = hn::BitCast(d32, pairs[2 * k + 1]);
    quads[k] = take(hn::BitCast(d16, hn::InterleaveLower(d32, a, b)),
                    hn::BitCast(d16, hn::InterleaveUpper(d32, a, b)));
  }
  const auto a = hn::BitCast(d64, quads[0]), b = hn::BitCast(d64, quads[1]);
  return take(hn::BitCast(d16, hn::InterleaveLower(d64, a, b)),
              hn::BitCast(d16, hn::InterleaveUpper(d64, a, b)));
}

HWY_INLINE uint32_t SumOf(UnsignedRow row) {
  const hn::Repartition<uint32_t, UnsignedTag> d32;
  const auto wide = hn::BitCast(d32, row);
  const auto pairs = hn::Add(hn::And(wide, hn::Set(d32, 0xFFFFu)), hn::ShiftRight<16>(wide));
  return hn::GetLane(hn::SumOfLanes(d32, pairs));
}

// Sums of steps. Sums that may exceed 16 bits have 32-bit lanes.
struct Steps {
  explicit Steps(const CellLimits& limits)
      : edge(hn::Set(UnsignedTag(), static_cast<uint16_t>(limits.edge))),
        slope_limit(hn::Set(UnsignedTag(), static_cast<uint16_t>(limits.slope_limit))),
        gap_limit(hn::Set(UnsignedTag(), static_cast<uint16_t>(limits.gap_limit))) {}

  // Adds the absolute differences between the disparities of vectors a and b. A difference counts
  // as inside the cell if all bits of its lane of `inside` are set.
  HWY_INLINE void Add(CellRow a, CellRow b, UnsignedRow inside) {
    const CellTag d16;
    const UnsignedTag du16;
    const auto step = StepOf(a, b);
    const auto beyond = hn::Gt(step, edge);
    const auto at_edge = hn::VecFromMask(du16, beyond);
    const auto nearer = hn::Max(a, b);
    const auto edge_mask = hn::MaskFromVec(hn::BitCast(d16, at_edge));
    low = hn::Min(low, hn::IfThenElse(edge_mask, nearer, hn::Set(d16, int16_t{INT16_MAX})));
    high = hn::Max(high, hn::IfThenElse(edge_mask, nearer, hn::Set(d16, int16_t{INT16_MIN})));
    const auto counted = hn::And(at_edge, inside);
    edges = hn::Sub(edges, counted);
    slopes = hn::Add(slopes, hn::And(hn::AndNot(at_edge, inside), hn::Min(step, slope_limit)));
    const auto gap = hn::And(counted, hn::Min(step, gap_limit));
    const hn::Repartition<uint32_t, UnsignedTag> d32;
    const auto wide = hn::BitCast(d32, gap);
    gaps = hn::Add(gaps, hn::Add(hn::And(wide, hn::Set(d32, 0xFFFFu)), hn::ShiftRight<16>(wide)));
  }

  HWY_INLINE void Store(int along, CellMeasure* measure) const {
    measure->slopes[along] = SumOf(slopes);
    measure->edges[along] = SumOf(edges);
    measure->gaps[along] =
        hn::GetLane(hn::SumOfLanes(hn::Repartition<uint32_t, UnsignedTag>(), gaps));
  }

  UnsignedRow edge, slope_limit, gap_limit;
  CellRow low = hn::Set(CellTag(), int16_t{INT16_MAX});
  CellRow high = hn::Set(CellTag(), int16_t{INT16_MIN});
  UnsignedRow slopes = hn::Zero(UnsignedTag()), edges = hn::Zero(UnsignedTag());
  hn::Vec<hn::Repartition<uint32_t, UnsignedTag> > gaps =
      hn::Zero(hn::Repartition<uint32_t, UnsignedTag>());
};

// Returns the mask of the steps between a pixel of the cell and the pixel to the left that lie
// inside the cell.
HWY_INLINE UnsignedRow AllButFirst() {
  const UnsignedTag du16;
  return hn::VecFromMask(du16, hn::Gt(hn::Iota(du16, 0), hn::Zero(du16)));
}

// Measures the differences between neighbouring disparities in a cell with depth edges.
HWY_INLINE void MeasureSteps(const int16_t* const rows[10], size_t column, const CellLimits& limits,
                             CellMeasure* measure) {
  const CellTag d16;
  const UnsignedTag du16;
  const auto all = hn::Set(du16, uint16_t{0xFFFF}), none = hn::Zero(du16);
  const auto all_but_first = AllButFirst();
  Steps along_rows(limits), along_columns(limits);
  auto above = hn::LoadU(d16, rows[0] + column);
  for (int k = 0; k < 8; ++k) {
    const int16_t* row = rows[1 + k] + column;
    const auto own = hn::LoadU(d16, row);
    along_rows.Add(hn::LoadU(d16, row - 1), own, all_but_first);
    along_rows.Add(hn::LoadU(d16, row + 1), own, none);
    along_columns.Add(above, own, k == 0 ? none : all);
    above = own;
  }
  along_columns.Add(above, hn::LoadU(d16, rows[9] + column), none);
  measure->edge_low = hn::GetLane(hn::MinOfLanes(d16, hn::Min(along_rows.low, along_columns.low)));
  measure->edge_high =
      hn::GetLane(hn::MaxOfLanes(d16, hn::Max(along_rows.high, along_columns.high)));
  along_rows.Store(0, measure);
  along_columns.Store(1, measure);
}

// Returns the smallest distance between `focus` and a disparity of the cell, in [low, high].
HWY_INLINE uint16_t NearestOf(const int16_t* const rows[10], size_t column, int low, int high,
                              int16_t focus) {
  if (focus <= low) return static_cast<uint16_t>(low - focus);
  if (focus >= high) return static_cast<uint16_t>(focus - high);
  const CellTag d16;
  auto nearest = hn::Set(UnsignedTag(), uint16_t{0xFFFF});
  for (int k = 1; k < 9; ++k) {
    nearest = hn::Min(nearest, Distance(hn::LoadU(d16, rows[k] + column), hn::Set(d16, focus)));
  }
  return hn::GetLane(hn::MinOfLanes(UnsignedTag(), nearest));
}

// Measures the cell as if it had no depth edges, which is true for most cells, and finds the
// largest difference between neighbours.
inline void MeasureCell(const int16_t* const rows[10], size_t column, const CellLimits& limits,
                        CellMeasure* measure) {
  const CellTag d16;
  const UnsignedTag du16;
  const auto limit = hn::Set(du16, static_cast<uint16_t>(limits.slope_limit));
  const auto limit_inside = hn::And(AllButFirst(), limit);
  auto above = hn::LoadU(d16, rows[0] + column);
  auto low = hn::LoadU(d16, rows[1] + column), high = low;
  auto largest = StepOf(hn::LoadU(d16, rows[8] + column), hn::LoadU(d16, rows[9] + column));
  auto along_rows = hn::Zero(du16);
  // The step from the row above leads into the cell, and is therefore subtracted.
  auto along_columns = hn::Sub(along_rows, hn::Min(StepOf(above, low), limit));
  for (int k = 1; k < 9; ++k) {
    const int16_t* row = rows[k] + column;
    const auto own = hn::LoadU(d16, row);
    const auto left = StepOf(hn::LoadU(d16, row - 1), own);
    const auto right = StepOf(hn::LoadU(d16, row + 1), own), down = StepOf(above, own);
    low = hn::Min(low, own);
    high = hn::Max(high, own);
    largest = hn::Max(hn::Max(largest, down), hn::Max(left, right));
    along_rows = hn::Add(along_rows, hn::Min(left, limit_inside));
    along_columns = hn::Add(along_columns, hn::Min(down, limit));
    above = own;
  }
  measure->low = hn::GetLane(hn::MinOfLanes(d16, low));
  measure->high = hn::GetLane(hn::MaxOfLanes(d16, high));
  measure->nearest = NearestOf(rows, column, measure->low, measure->high, limits.focus);
  const auto edge = hn::Set(du16, static_cast<uint16_t>(limits.edge));
  if (!hn::AllFalse(du16, hn::Gt(largest, edge))) {
    MeasureSteps(rows, column, limits, measure);
    return;
  }
  measure->slopes[0] = SumOf(along_rows);
  measure->slopes[1] = SumOf(along_columns);
  for (int along = 0; along < 2; ++along) measure->edges[along] = measure->gaps[along] = 0;
  measure->edge_low = INT16_MAX;
  measure->edge_high = INT16_MIN;
}

inline void MeasureLines(const int16_t* const rows[10], size_t column, CellLines* lines) {
  const CellTag d16;
  const auto min = [](CellRow a, CellRow b) HWY_ATTR { return hn::Min(a, b); };
  const auto max = [](CellRow a, CellRow b) HWY_ATTR { return hn::Max(a, b); };
  CellRow here[8];
  for (int k = 0; k < 8; ++k) here[k] = hn::LoadU(d16, rows[1 + k] + column);
  auto low = here[0], high = here[0];
  for (int k = 1; k < 8; ++k) {
    low = hn::Min(low, here[k]);
    high = hn::Max(high, here[k]);
  }
  hn::StoreU(low, d16, lines->column_low);
  hn::StoreU(high, d16, lines->column_high);
  hn::StoreU(ReduceRows(here, min), d16, lines->row_low);
  hn::StoreU(ReduceRows(here, max), d16, lines->row_high);
}

// Finds how far the blur of cells extends towards a block, for a vector of columns of cells. Lane k
// stands for column first + k; column 0 is `around` cells before the block. Lanes after the last
// column do not reach the block.
class ColumnReach {
 public:
  ColumnReach(const int16_t* cells, size_t plane, size_t stride, int32_t around,
              const int16_t* borders, int32_t first)
      : cells_(cells),
        plane_(plane),
        stride_(static_cast<ptrdiff_t>(stride)),
        around_(around),
        borders_(borders),
        first_(first) {
    const LanesTag d16;
    const auto column = CountFrom(d16, static_cast<int16_t>(first));
    const auto before = hn::Sub(hn::Set(d16, static_cast<int16_t>(around - 1)), column);
    const auto behind = hn::Sub(column, hn::Set(d16, static_cast<int16_t>(around + 2)));
    const auto away = hn::Max(before, behind), none = hn::Set(d16, int16_t{-1});
    const auto beyond = hn::Gt(behind, hn::Set(d16, static_cast<int16_t>(around - 1)));
    left_ = hn::VecFromMask(d16, hn::Gt(before, none));
    right_ = hn::VecFromMask(d16, hn::Gt(behind, none));
    gap_ = hn::ShiftLeft<3>(away);
    needed_ = hn::IfThenElse(hn::Lt(away, hn::Zero(d16)), hn::Set(d16, int16_t{INT16_MIN}), gap_);
    needed_ = hn::IfThenElse(beyond, hn::Set(d16, int16_t{INT16_MAX}), needed_);
  }

  // Adds rows [row, end) of cells, which are all above, all below or all level with the block.
  // `from` is the plane of the cells' reach towards the block. If `border` is not null, its side
  // `to` is updated.
  HWY_INLINE void AddRows(int32_t row, int32_t end, int from, int16_t (*border)[4], int to) {
    const LanesTag d16;
    auto y0 = hn::Zero(d16), y1 = y0, y2 = y0;
    const auto whole = hn::Set(d16, kCellPixels);
    const auto least = [&](int layer) HWY_ATTR {
      return hn::SaturatedSub(needed_, hn::Set(d16, borders_[layer]));
    };
    const auto left = hn::MaskFromVec(left_);
    for (; row < end; ++row) {
      const int16_t* at = cells_ + (row - around_) * stride_ + first_ - around_;
      const auto load = [&](int of) HWY_ATTR {
        return hn::LoadU(d16, at + static_cast<size_t>(of) * plane_);
      };
      const int16_t gap = GapOfRow(row);
      const auto gap_y = hn::Set(d16, gap);
      const auto reach_x = hn::IfThenElse(left, load(kReachRight), load(kReachLeft));
      const auto reach_y = load(from);
      const auto reaches = [&](int layer) HWY_ATTR {
        const auto needed = hn::SaturatedSub(gap_y, hn::Set(d16, borders_[layer]));
        return hn::And(hn::Gt(reach_x, least(layer)), hn::Gt(reach_y, needed));
      };
      const auto reaches2 = reaches(2);
      if (hn::AllFalse(d16, reaches2)) continue;
      x2_ = hn::Max(x2_, hn::IfThenElseZero(reaches2, hn::Add(gap_, whole)));
      y2 = hn::Max(y2, hn::IfThenElseZero(reaches2, hn::Add(gap_y, whole)));
      const auto reaches1 = reaches(1);
      if (hn::AllFalse(d16, reaches1)) continue;
      x1_ = hn::Max(x1_, hn::IfThenElseZero(reaches1, hn::Add(gap_, whole)));
      y1 = hn::Max(y1, hn::IfThenElseZero(reaches1, hn::Add(gap_y, whole)));
      const auto reaches0 = reaches(0);
      if (hn::AllFalse(d16, reaches0)) continue;
      const auto inside_x = hn::IfThenElse(left, load(kInsideRight), load(kInsideLeft));
      const auto inside_y = load(from + kInsideLeft);
      x0_ = hn::Max(x0_, hn::IfThenElseZero(reaches0, hn::Add(gap_, inside_x)));
      y0 = hn::Max(y0, hn::IfThenElseZero(reaches0, hn::Add(gap_y, inside_y)));
      radius_ = hn::Max(radius_, hn::IfThenElseZero(reaches0, load(kRadiusPlane)));
      edge_ = hn::Max(edge_, hn::IfThenElseZero(reaches0, load(kEdgePlane)));
    }
    if (border == nullptr) return;
    Store(y0, &border[0][to]);
    Store(y1, &border[1][to]);
    Store(y2, &border[2][to]);
  }

  HWY_INLINE void StoreColumns(BlockReach* reach) const {
    Store(radius_, &reach->radius);
    Store(edge_, &reach->edge);
    StoreSides(x0_, reach->border[0]);
    StoreSides(x1_, reach->border[1]);
    StoreSides(x2_, reach->border[2]);
  }

 private:
  int16_t GapOfRow(int32_t row) const {
    if (row < around_) return static_cast<int16_t>((around_ - 1 - row) * kCellPixels);
    if (row > around_ + 1) return static_cast<int16_t>((row - around_ - 2) * kCellPixels);
    return INT16_MIN;
  }

  static HWY_INLINE void Store(LanesVec values, int16_t* largest) {
    const int16_t value = hn::GetLane(hn::MaxOfLanes(LanesTag(), values));
    if (value > *largest) *largest = value;
  }

  HWY_INLINE void StoreSides(LanesVec values, int16_t (&border)[4]) const {
    Store(hn::And(values, left_), &border[kReachLeft]);
    Store(hn::And(values, right_), &border[kReachRight]);
  }

  const int16_t* const cells_;
  const size_t plane_;
  const ptrdiff_t stride_;
  const int32_t around_;
  const int16_t* const borders_;
  const int32_t first_;
  LanesVec left_, right_;  // Masks of the columns to the left and to the right of the block.
  LanesVec gap_;           // Widths, in pixels, of the gaps between the block and the columns.
  // Gap that the reach of a cell must exceed to reach the block; INT16_MIN in the columns of the
  // block.
  LanesVec needed_;
  // Largest horizontal distance from the block to pixels that reach the block or the border of
  // layer 0, 1 or 2.
  LanesVec x0_ = hn::Zero(LanesTag()), x1_ = x0_, x2_ = x0_;
  LanesVec radius_ = x0_, edge_ = x0_;
};

inline void ReachBlock(const int16_t* cells, size_t plane, size_t stride, int32_t around,
                       const int16_t borders[3], BlockReach* reach) {
  *reach = {};
  const int32_t side = 2 * around + 2;
  for (int32_t first = 0; first < side; first += static_cast<int32_t>(hn::Lanes(LanesTag()))) {
    ColumnReach columns(cells, plane, stride, around, borders, first);
    columns.AddRows(0, around, kReachBottom, reach->border, kReachTop);
    columns.AddRows(around, around + 2, kReachTop, nullptr, kReachTop);
    columns.AddRows(around + 2, side, kReachTop, reach->border, kReachBottom);
    columns.StoreColumns(reach);
  }
}

// Returns the largest reach, in cells, of the cells of a vector and of all cells up to `around`
// cells away; limited to `around`. `at` points to the reach of the first cell of the vector.
HWY_INLINE int32_t FarthestCells(const int16_t* at, size_t stride, int32_t around) {
  const LanesTag d16;
  const auto lanes = static_cast<int32_t>(hn::Lanes(d16));
  auto most = hn::Zero(d16);
  for (int32_t y = -around; y <= around; ++y) {
    const int16_t* row = at + y * static_cast<ptrdiff_t>(stride);
    for (int32_t x = -around; x < lanes + around; x += lanes) {
      most = hn::Max(most, hn::LoadU(d16, row + x));
    }
  }
  const int32_t reach = hn::GetLane(hn::MaxOfLanes(d16, most));
  const int32_t cells = (reach + kCellPixels - 1) / kCellPixels;
  return cells < around ? cells : around;
}

inline void SurroundCells(const int16_t* cells, size_t plane, size_t stride, int32_t around,
                          size_t count, int16_t* HWY_RESTRICT lows, int16_t* HWY_RESTRICT highs,
                          uint16_t* HWY_RESTRICT ranges, int16_t* HWY_RESTRICT edges) {
  const LanesTag d16;
  const hn::RebindToUnsigned<LanesTag> du16;
  const auto load = [&](const int16_t* at, size_t of)
                        HWY_ATTR { return hn::LoadU(d16, at + of * plane); };
  for (size_t n = 0; n < SliceSamples(count); n += hn::Lanes(d16)) {
    const int16_t* cell = cells + n;
    const auto own = load(cell, kReachPlane), own_high = load(cell, kHighPlane);
    const int32_t farthest = FarthestCells(cell + kReachPlane * plane, stride, around);
    auto low = load(cell, kLowPlane), high = load(cell, kHighPlane), edge = load(cell, kEdgePlane);
    auto widest = hn::BitCast(du16, hn::Sub(high, low));
    for (int32_t y = -farthest; y <= farthest; ++y) {
      for (int32_t x = -farthest; x <= farthest; ++x) {
        const int16_t* at = cell + y * static_cast<ptrdiff_t>(stride) + x;
        const int32_t rows = y < 0 ? -y : y, columns = x < 0 ? -x : x;
        const int32_t away = ((rows > columns ? rows : columns) - 1) * kCellPixels;
        const auto first = load(at, kLowPlane), last = load(at, kHighPlane);
        const auto other = hn::IfThenElseZero(hn::Gt(last, own_high), load(at, kNearPlane));
        const auto reached = hn::Gt(hn::Max(own, other), hn::Set(d16, static_cast<int16_t>(away)));
        low = hn::Min(low, hn::IfThenElse(reached, first, low));
        high = hn::Max(high, hn::IfThenElse(reached, last, high));
        const auto range = hn::IfThenElseZero(reached, hn::Sub(last, first));
        widest = hn::Max(widest, hn::BitCast(du16, range));
        edge = hn::Max(edge, hn::IfThenElseZero(reached, load(at, kEdgePlane)));
      }
    }
    hn::StoreU(low, d16, lows + n);
    hn::StoreU(high, d16, highs + n);
    hn::StoreU(widest, du16, ranges + n);
    hn::StoreU(edge, d16, edges + n);
  }
}

#endif

}  // namespace HWY_NAMESPACE
}  // namespace starfocus::simd
HWY_AFTER_NAMESPACE();
