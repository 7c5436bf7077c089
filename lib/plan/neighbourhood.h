// SPDX-License-Identifier: Apache-2.0
// What lies around cells within reach: the borders it gives to blocks, and which cells are smooth.
#ifndef STARFOCUS_LIB_PLAN_NEIGHBOURHOOD_H_
#define STARFOCUS_LIB_PLAN_NEIGHBOURHOOD_H_

#include <cstddef>
#include <cstdint>

#include "lib/plan/block_stats.h"
#include "simd/kernels.h"

namespace starfocus {

// A rectangle of cells and those up to `around` away, in planes as the kernels read them, with the
// picture's edge repeated around it.
struct Surroundings {
  simd::CellPlanes planes;  // from the first cell of the rectangle on
  int32_t column, row, columns, rows;
  int32_t around;

  simd::CellPlanes At(int32_t of_column, int32_t of_row) const {
    return {planes.cells + (of_row - row) * static_cast<ptrdiff_t>(planes.stride) +
                (of_column - column),
            planes.plane, planes.stride};
  }
};

// Of a square of `side` cells: with what kernels read beyond it.
constexpr size_t SurroundingSamples(int32_t side, int32_t around) {
  const auto all = static_cast<size_t>(side + 2 * around);
  return simd::kCellPlanes * all * all + 2 * simd::kSliceLanes;
}

// Cells of the rectangle may lie outside the picture; those of its rows that are inside, and the
// ones around, must be stored. `scale` is what they were measured with. `samples`:
// SurroundingSamples.
Surroundings LoadSurroundings(const CellGrid& grid, const BlurScale& scale, const Rect& cells,
                              int32_t around, int16_t* samples);

// A cell is smooth when it can be gathered (lib/filter/gather.h): one surface without depth edges
// is all that lies within reach of its pixels, or reaches them from nearer by, and in no cell there
// does the blur, nearer than the focus counted as negative, differ by more than kSlopeRange,
// kDisparityBits. What lies farther may reach them, too: in no view does it show before the
// surface. Where two thirds of what the blur differs by are within one cell, it is a step: then by
// no more than half the largest blur or kSharpSmoothRange, since the blur may be sharp on one side.
// A cell is flat, and one kernel serves all of its pixels, where the blur differs by at most
// kSmoothRange, and half of that within one cell counts as a step.
inline constexpr int32_t kSmoothRange = (5 << kDisparityBits) / 4;
inline constexpr int32_t kSlopeRange = 2 << kDisparityBits;
inline constexpr int32_t kSharpSmoothRange = (1 << kDisparityBits) / 2;
enum class CellKind : uint8_t { kMixed, kSloped, kFlat };

// Stats of the 2x2 cells of the grid at (column, row) of the surroundings.
BlockStats MeasureBlock(const simd::Kernels& kernels, const CellGrid& grid,
                        const Surroundings& surroundings, int32_t column, int32_t row);

// How smooth the cells of a row of the surroundings are, at most kMaxRowCells. `scale` is what they
// were measured with.
inline constexpr int32_t kMaxRowCells = 32;
void FindSmooth(const simd::Kernels& kernels, const Surroundings& surroundings,
                const BlurScale& scale, int32_t row, CellKind* smooth);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_PLAN_NEIGHBOURHOOD_H_
