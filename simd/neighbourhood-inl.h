// SPDX-License-Identifier: Apache-2.0
// Vector code of the functions in neighbourhood.h. This file is included once per SIMD target.
#if defined(STARFOCUS_SIMD_NEIGHBOURHOOD_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STARFOCUS_SIMD_NEIGHBOURHOOD_INL_H_
#undef STARFOCUS_SIMD_NEIGHBOURHOOD_INL_H_
#else
#define STARFOCUS_SIMD_NEIGHBOURHOOD_INL_H_
#endif

#include "simd/highway-inl.h"
#include "simd/neighbourhood.h"

HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

// The vector code stores vectors in structs, and therefore requires vectors whose size is known at
// compile time.
#if HWY_TARGET == HWY_SCALAR || HWY_HAVE_SCALABLE

using reference::ReachBlock;
using reference::SurroundCells;

#else

// Widths, in pixels, of the gaps between a block and the columns of cells around the block. Lane k
// stands for column first + k; column 0 is `around` cells before the block. Lanes after the last
// column do not reach the block.
struct ColumnGaps {
  ColumnGaps(int32_t around, int32_t first) {
    const LanesTag d16;
    const auto column = CountFrom(d16, static_cast<int16_t>(first));
    const auto before = hn::Sub(hn::Set(d16, static_cast<int16_t>(around - 1)), column);
    const auto behind = hn::Sub(column, hn::Set(d16, static_cast<int16_t>(around + 2)));
    const auto away = hn::Max(before, behind), none = hn::Set(d16, int16_t{-1});
    const auto beyond = hn::Gt(behind, hn::Set(d16, static_cast<int16_t>(around - 1)));
    left = hn::VecFromMask(d16, hn::Gt(before, none));
    right = hn::VecFromMask(d16, hn::Gt(behind, none));
    gap = hn::ShiftLeft<3>(away);
    needed = hn::IfThenElse(hn::Lt(away, hn::Zero(d16)), hn::Set(d16, int16_t{INT16_MIN}), gap);
    needed = hn::IfThenElse(beyond, hn::Set(d16, int16_t{INT16_MAX}), needed);
  }

  LanesVec left, right;  // masks of the columns to the left and to the right of the block
  LanesVec gap;
  // Gap that the reach of a cell must exceed to reach the block; INT16_MIN in the columns of the
  // block.
  LanesVec needed;
};

// Finds how far the blur of cells extends towards a block, for a vector of columns of cells.
class ColumnReach {
 public:
  ColumnReach(const CellPlanes& planes, int32_t around, const int16_t* margins, int32_t first)
      : planes_(planes), around_(around), margins_(margins), first_(first), gaps_(around, first) {}

  // Adds rows [row, end) of cells, which are all above, all below or all level with the block.
  // `from` is the plane of the cells' reach towards the block. If `border` is not null, its side
  // `to` is updated.
  HWY_INLINE void AddRows(int32_t row, int32_t end, CellPlane from, int16_t (*border)[4],
                          CellPlane to) {
    const LanesTag d16;
    auto y0 = hn::Zero(d16), y1 = y0, y2 = y0;
    const auto whole = hn::Set(d16, kCellPixels);
    const auto least = [&](int layer) HWY_ATTR {
      return hn::SaturatedSub(gaps_.needed, hn::Set(d16, margins_[layer]));
    };
    const auto left = hn::MaskFromVec(gaps_.left);
    for (; row < end; ++row) {
      const int16_t* at = planes_.cells + (row - around_) * static_cast<ptrdiff_t>(planes_.stride) +
                          first_ - around_;
      const auto load = [&](int plane) HWY_ATTR {
        return hn::LoadU(d16, at + static_cast<size_t>(plane) * planes_.plane);
      };
      const int16_t gap = GapOfRow(row);
      const auto gap_y = hn::Set(d16, gap);
      const auto reach_x = hn::IfThenElse(left, load(kReachRight), load(kReachLeft));
      const auto reach_y = load(from);
      const auto reaches = [&](int layer) HWY_ATTR {
        const auto needed = hn::SaturatedSub(gap_y, hn::Set(d16, margins_[layer]));
        return hn::And(hn::Gt(reach_x, least(layer)), hn::Gt(reach_y, needed));
      };
      const auto reaches2 = reaches(2);
      if (hn::AllFalse(d16, reaches2)) continue;
      x2_ = hn::Max(x2_, hn::IfThenElseZero(reaches2, hn::Add(gaps_.gap, whole)));
      y2 = hn::Max(y2, hn::IfThenElseZero(reaches2, hn::Add(gap_y, whole)));
      const auto reaches1 = reaches(1);
      if (hn::AllFalse(d16, reaches1)) continue;
      x1_ = hn::Max(x1_, hn::IfThenElseZero(reaches1, hn::Add(gaps_.gap, whole)));
      y1 = hn::Max(y1, hn::IfThenElseZero(reaches1, hn::Add(gap_y, whole)));
      const auto reaches0 = reaches(0);
      if (hn::AllFalse(d16, reaches0)) continue;
      const auto inside_x = hn::IfThenElse(left, load(kInsideRight), load(kInsideLeft));
      const auto inside_y = load(from + kInsideLeft);
      x0_ = hn::Max(x0_, hn::IfThenElseZero(reaches0, hn::Add(gaps_.gap, inside_x)));
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
    Store(hn::And(values, gaps_.left), &border[kReachLeft]);
    Store(hn::And(values, gaps_.right), &border[kReachRight]);
  }

  const CellPlanes& planes_;
  const int32_t around_;
  const int16_t* const margins_;
  const int32_t first_;
  const ColumnGaps gaps_;
  // Largest horizontal distance from the block to pixels that reach the block or the margin of
  // layer 0, 1 or 2.
  LanesVec x0_ = hn::Zero(LanesTag()), x1_ = x0_, x2_ = x0_;
  LanesVec radius_ = x0_, edge_ = x0_;
};

inline void ReachBlock(const CellPlanes& planes, int32_t around, const int16_t margins[3],
                       BlockReach* reach) {
  *reach = {};
  const int32_t side = 2 * around + 2;
  for (int32_t first = 0; first < side; first += static_cast<int32_t>(hn::Lanes(LanesTag()))) {
    ColumnReach columns(planes, around, margins, first);
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

inline void SurroundCells(const CellPlanes& planes, int32_t around, size_t count,
                          const CellRanges& ranges) {
  const LanesTag d16;
  const hn::RebindToUnsigned<LanesTag> du16;
  const auto load = [&](const int16_t* at, int plane)
                        HWY_ATTR { return hn::LoadU(d16, at + plane * planes.plane); };
  for (size_t n = 0; n < SliceSamples(count); n += hn::Lanes(d16)) {
    const int16_t* cell = planes.cells + n;
    const auto own = load(cell, kReachPlane), own_high = load(cell, kHighPlane);
    const int32_t farthest =
        FarthestCells(cell + kReachPlane * planes.plane, planes.stride, around);
    auto low = load(cell, kLowPlane), high = load(cell, kHighPlane), edge = load(cell, kEdgePlane);
    auto widest = hn::BitCast(du16, hn::Sub(high, low));
    for (int32_t y = -farthest; y <= farthest; ++y) {
      for (int32_t x = -farthest; x <= farthest; ++x) {
        const int16_t* at = cell + y * static_cast<ptrdiff_t>(planes.stride) + x;
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
    hn::StoreU(low, d16, ranges.low + n);
    hn::StoreU(high, d16, ranges.high + n);
    hn::StoreU(widest, du16, ranges.widest + n);
    hn::StoreU(edge, d16, ranges.edge + n);
  }
}

#endif

}  // namespace HWY_NAMESPACE
}  // namespace starfocus::simd
HWY_AFTER_NAMESPACE();

#endif
