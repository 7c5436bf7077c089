// SPDX-License-Identifier: Apache-2.0
// Vector code of the functions in cells.h. This file is included once per SIMD target.
#if defined(STARFOCUS_SIMD_CELLS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STARFOCUS_SIMD_CELLS_INL_H_
#undef STARFOCUS_SIMD_CELLS_INL_H_
#else
#define STARFOCUS_SIMD_CELLS_INL_H_
#endif

#include "simd/cells.h"
#include "simd/highway-inl.h"

HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

// The vector code stores vectors in arrays and structs, and therefore requires vectors whose size
// is known at compile time.
#if HWY_TARGET == HWY_SCALAR || HWY_HAVE_SCALABLE

using reference::MeasureCell;

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
    const auto step = Distance(a, b);
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

// Measures the differences between neighbouring disparities in a cell without depth edges. Returns
// false if the cell has a depth edge. Most cells have no depth edge.
HWY_INLINE bool MeasureSlopes(const int16_t* const rows[10], const CellRow (&here)[8],
                              UnsignedRow all_but_first, const CellLimits& limits,
                              CellMeasure* measure) {
  const CellTag d16;
  const UnsignedTag du16;
  const auto limit = hn::Set(du16, static_cast<uint16_t>(limits.slope_limit));
  auto along_rows = hn::Zero(du16), along_columns = along_rows;
  auto largest = hn::Max(Distance(hn::LoadU(d16, rows[0]), here[0]),
                         Distance(hn::LoadU(d16, rows[9]), here[7]));
  for (int k = 0; k < 8; ++k) {
    const auto left = Distance(hn::LoadU(d16, rows[1 + k] - 1), here[k]);
    const auto right = Distance(hn::LoadU(d16, rows[1 + k] + 1), here[k]);
    largest = hn::Max(largest, hn::Max(left, right));
    along_rows = hn::Add(along_rows, hn::And(all_but_first, hn::Min(left, limit)));
    if (k == 0) continue;
    const auto down = Distance(here[k - 1], here[k]);
    largest = hn::Max(largest, down);
    along_columns = hn::Add(along_columns, hn::Min(down, limit));
  }
  const auto edge = hn::Set(du16, static_cast<uint16_t>(limits.edge));
  if (!hn::AllFalse(du16, hn::Gt(largest, edge))) return false;
  measure->slopes[0] = SumOf(along_rows);
  measure->slopes[1] = SumOf(along_columns);
  for (int along = 0; along < 2; ++along) measure->edges[along] = measure->gaps[along] = 0;
  measure->edge_low = INT16_MAX;
  measure->edge_high = INT16_MIN;
  return true;
}

HWY_INLINE void MeasureSteps(const int16_t* const rows[10], const CellRow (&here)[8],
                             UnsignedRow all_but_first, const CellLimits& limits,
                             CellMeasure* measure) {
  const CellTag d16;
  const UnsignedTag du16;
  const auto all = hn::Set(du16, uint16_t{0xFFFF}), none = hn::Zero(du16);
  Steps along_rows(limits), along_columns(limits);
  along_columns.Add(hn::LoadU(d16, rows[0]), here[0], none);
  along_columns.Add(hn::LoadU(d16, rows[9]), here[7], none);
  for (int k = 0; k < 8; ++k) {
    along_rows.Add(hn::LoadU(d16, rows[1 + k] - 1), here[k], all_but_first);
    along_rows.Add(hn::LoadU(d16, rows[1 + k] + 1), here[k], none);
    if (k > 0) along_columns.Add(here[k - 1], here[k], all);
  }
  measure->edge_low = hn::GetLane(hn::MinOfLanes(d16, hn::Min(along_rows.low, along_columns.low)));
  measure->edge_high =
      hn::GetLane(hn::MaxOfLanes(d16, hn::Max(along_rows.high, along_columns.high)));
  along_rows.Store(0, measure);
  along_columns.Store(1, measure);
}

inline void MeasureCell(const int16_t* const rows[10], const CellLimits& limits,
                        CellMeasure* measure) {
  const CellTag d16;
  const UnsignedTag du16;
  const auto min = [](CellRow a, CellRow b) HWY_ATTR { return hn::Min(a, b); };
  const auto max = [](CellRow a, CellRow b) HWY_ATTR { return hn::Max(a, b); };
  // The difference between columns -1 and 0 crosses the boundary of the cell, and therefore does
  // not count as inside the cell.
  const auto all_but_first = hn::VecFromMask(du16, hn::Gt(hn::Iota(du16, 0), hn::Zero(du16)));
  const auto focus = hn::Set(d16, limits.focus);
  CellRow here[8];
  for (int k = 0; k < 8; ++k) here[k] = hn::LoadU(d16, rows[1 + k]);
  auto low = here[0], high = here[0];
  auto nearest = hn::Set(du16, uint16_t{0xFFFF});
  for (int k = 0; k < 8; ++k) {
    low = hn::Min(low, here[k]);
    high = hn::Max(high, here[k]);
    nearest = hn::Min(nearest, Distance(here[k], focus));
  }
  hn::StoreU(low, d16, measure->column_low);
  hn::StoreU(high, d16, measure->column_high);
  hn::StoreU(ReduceRows(here, min), d16, measure->row_low);
  hn::StoreU(ReduceRows(here, max), d16, measure->row_high);
  measure->nearest = hn::GetLane(hn::MinOfLanes(du16, nearest));
  if (MeasureSlopes(rows, here, all_but_first, limits, measure)) return;
  MeasureSteps(rows, here, all_but_first, limits, measure);
}

#endif

}  // namespace HWY_NAMESPACE
}  // namespace starfocus::simd
HWY_AFTER_NAMESPACE();

#endif
