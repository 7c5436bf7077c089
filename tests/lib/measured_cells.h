// SPDX-License-Identifier: Apache-2.0
// Measures the cells of a whole disparity map in the same way as the engine.
#ifndef STARFOCUS_TESTS_LIB_MEASURED_CELLS_H_
#define STARFOCUS_TESTS_LIB_MEASURED_CELLS_H_

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lib/plan/cells.h"
#include "lib/plan/smooth_cells.h"
#include "simd/kernels.h"

namespace test {

// Measures the cells of `disparity`, which has width x height values of kDisparityBits in packed
// rows. The returned grid points into `cells`.
inline starfocus::CellGrid MeasureCells(const std::vector<int16_t>& disparity, int width,
                                        int height, const starfocus::BlurScale& scale,
                                        std::vector<starfocus::Cell>* cells) {
  starfocus::Input input;
  input.width = width;
  input.height = height;
  input.disparity = {disparity.data(), size_t(width), 0, 0};
  starfocus::CellGrid grid;
  grid.columns = (width + starfocus::kCellSize - 1) / starfocus::kCellSize;
  grid.rows = grid.last_row = (height + starfocus::kCellSize - 1) / starfocus::kCellSize;
  cells->resize(size_t(grid.columns) * size_t(grid.rows));
  grid.cells = cells->data();
  for (int row = 0; row < grid.rows; ++row) {
    starfocus::MeasureCells(starfocus::simd::BestKernels(), input, scale, row, {0, grid.columns},
                            grid.At(0, row));
  }
  return grid;
}

// Owns the measured surroundings of a block of 2 x 2 cells.
class BlockSurroundings {
 public:
  BlockSurroundings(const starfocus::CellGrid& grid, const starfocus::BlurScale& scale, int column,
                    int row, int around)
      : samples_(starfocus::SurroundingSamples(2, around), int16_t{0x5A5A}),
        surroundings_(starfocus::LoadSurroundings(grid, scale, {column, row, 2, 2}, around,
                                                  samples_.data())) {}
  const starfocus::Surroundings& operator*() const { return surroundings_; }

 private:
  std::vector<int16_t> samples_;
  starfocus::Surroundings surroundings_;
};

inline starfocus::BlockStats MeasureBlock(const starfocus::CellGrid& grid,
                                          const starfocus::BlurScale& scale, int column, int row,
                                          int around) {
  return starfocus::MeasureBlock(starfocus::simd::BestKernels(), grid,
                                 *BlockSurroundings(grid, scale, column, row, around), column, row);
}

inline starfocus::CellKind KindOf(const starfocus::CellGrid& grid,
                                  const starfocus::BlurScale& scale, int column, int row,
                                  int around) {
  starfocus::CellKind smooth[starfocus::kMaxRowCells];
  starfocus::FindSmooth(starfocus::simd::BestKernels(),
                        *BlockSurroundings(grid, scale, column, row, around), scale, row, smooth);
  return smooth[0];
}

}  // namespace test

#endif  // STARFOCUS_TESTS_LIB_MEASURED_CELLS_H_
