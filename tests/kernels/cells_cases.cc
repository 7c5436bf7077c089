// SPDX-License-Identifier: Apache-2.0
// Test and benchmark calls of the kernel in simd/cells.h.
#include "tests/kernels/kernel_cases.h"

namespace test::kernel_cases {
namespace {

CellLimits DrawCellLimits(Draw* draw) {
  CellLimits limits;
  limits.focus = int16_t(draw->Rarely(3) ? draw->Int(-32768, 32767) : draw->Int(-200, 200));
  limits.edge = int16_t(draw->Rarely(4) ? draw->Int(0, 4369) : draw->Int(0, 96));
  limits.slope_limit = int16_t(draw->Rarely(4) ? 32767 : draw->Int(1, 96));
  limits.gap_limit = int16_t(draw->Rarely(4) ? 32767 : draw->Int(0, 2000));
  return limits;
}

// Returns disparities of all sizes. The benchmark uses a surface without edges, which is the common
// case.
std::vector<int16_t> CellDisparities(size_t count, Draw* draw) {
  const int kind = draw->timed() ? 5 : draw->Int(0, 5);
  const int most = kind == 0 ? 32000 : kind == 1 ? 7000 : kind == 2 ? 200 : kind == 5 ? 0 : 60;
  return Filled<int16_t>(count, [&] {
    const int any = draw->Int(-most, most);
    return kind != 4 ? any : draw->Int(0, 1) == 0 ? -32000 : 32000;
  });
}

// Calls `take` for each field of a cell's measure. The fields are compared separately, so that the
// padding between fields is not compared.
template <class Take>
void ForFields(const CellMeasure& m, const Take& take) {
  for (const auto* ends : {m.column_low, m.column_high, m.row_low, m.row_high}) take(ends, 8);
  take(&m.nearest, 1);
  take(&m.edge_low, 1);
  take(&m.edge_high, 1);
  for (const auto* sums : {m.slopes, m.edges, m.gaps}) take(sums, 2);
}

}  // namespace

void MeasureCell(Draw* draw, KernelCall* call) {
  const size_t cells = draw->Size(1, 3, kTimedSamples / 64);  // in one row
  const size_t width = 8 * cells + 2, stride = width + draw->Size(0, 9, 0);
  const int16_t* in = call->Input("disparity", CellDisparities(9 * stride + width, draw), kPadding);
  call->IgnoreRows(in + width, 9, stride, stride - width);
  std::vector<const int16_t*> all_rows;
  for (size_t n = 0; n < 10 * cells; ++n) {
    all_rows.push_back(in + 1 + n % 10 * stride + 8 * (n / 10));
  }
  const int16_t* const* rows = call->Input("rows", all_rows);
  const CellLimits limits = DrawCellLimits(draw);
  auto* measures = call->Output<CellMeasure>("measure", cells);
  for (size_t cell = 0; cell < cells; ++cell) {
    call->Free(&measures[cell], 1);
    ForFields(measures[cell],
              [&](const auto* first, int count) { call->Result(first, size_t(count)); });
  }
  call->Runs([=](const Kernels& kernels) {
    for (size_t cell = 0; cell < cells; ++cell) {
      kernels.MeasureCell(rows + 10 * cell, limits, &measures[cell]);
    }
  });
  call->is_right = [=](uint64_t, Met* met) {
    for (size_t cell = 0; cell < cells; ++cell) {
      ++(*met)[measures[cell].edge_low > measures[cell].edge_high ? "no edge" : "edges"];
    }
    return true;
  };
}

}  // namespace test::kernel_cases
