// SPDX-License-Identifier: Apache-2.0
// The case of the kernel of simd/cells.h.
#include <algorithm>
#include <cstdlib>

#include "tests/simd/kernel_cases.h"

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

// Disparities of all sizes; in the bench a surface without edges, as most cells are.
std::vector<int16_t> CellDisparities(size_t count, Draw* draw) {
  const int kind = draw->timed() ? 5 : draw->Int(0, 5);
  const int most = kind == 0 ? 32000 : kind == 1 ? 7000 : kind == 2 ? 200 : kind == 5 ? 0 : 60;
  return Filled<int16_t>(count, [&] {
    const int any = draw->Int(-most, most);
    return kind != 4 ? any : draw->Int(0, 1) == 0 ? -32000 : 32000;
  });
}

using Rows = const int16_t* const*;

// The step from pixel (x, y) of the cell to the next one, to the right or below, once more by the
// definition.
void AddStep(Rows rows, int x, int y, bool right, const CellLimits& limits, CellMeasure* measure) {
  const auto inside = [](int u, int v) { return u >= 0 && u < 8 && v >= 0 && v < 8; };
  const int to_x = x + right, to_y = y + !right, along = right ? 0 : 1;
  if (!inside(x, y) && !inside(to_x, to_y)) return;
  const bool both = inside(x, y) && inside(to_x, to_y);
  const int from = rows[y + 1][x], to = rows[to_y + 1][to_x], step = std::abs(from - to);
  if (step <= limits.edge) {
    measure->slopes[along] += both ? uint32_t(std::min<int>(step, limits.slope_limit)) : 0;
    return;
  }
  measure->edge_low = std::min(measure->edge_low, int16_t(std::max(from, to)));
  measure->edge_high = std::max(measure->edge_high, int16_t(std::max(from, to)));
  measure->edges[along] += both;
  measure->gaps[along] += both ? uint32_t(std::min<int>(step, limits.gap_limit)) : 0;
}

CellMeasure Measured(Rows rows, const CellLimits& limits) {
  CellMeasure measure = {};
  int nearest = 65535;
  for (int k = 0; k < 8; ++k) {
    int low[2] = {32767, 32767}, high[2] = {-32768, -32768};
    for (int other = 0; other < 8; ++other) {
      const int values[2] = {rows[other + 1][k], rows[k + 1][other]};
      for (int way = 0; way < 2; ++way) {
        low[way] = std::min(low[way], values[way]);
        high[way] = std::max(high[way], values[way]);
      }
      nearest = std::min(nearest, std::abs(values[0] - limits.focus));
    }
    measure.column_low[k] = int16_t(low[0]), measure.column_high[k] = int16_t(high[0]);
    measure.row_low[k] = int16_t(low[1]), measure.row_high[k] = int16_t(high[1]);
  }
  measure.nearest = uint16_t(nearest);
  measure.edge_low = INT16_MAX;
  measure.edge_high = INT16_MIN;
  for (int y = -1; y <= 7; ++y) {
    for (int x = -1; x <= 7; ++x) {
      if (y >= 0) AddStep(rows, x, y, true, limits, &measure);
      if (x >= 0) AddStep(rows, x, y, false, limits, &measure);
    }
  }
  return measure;
}

// All that is measured, as what lies between the fields is nothing.
template <class Take>
void ForFields(const CellMeasure& m, const Take& take) {
  for (const auto* ends : {m.column_low, m.column_high, m.row_low, m.row_high}) take(ends, 8);
  take(&m.nearest, 1);
  take(&m.edge_low, 1);
  take(&m.edge_high, 1);
  for (const auto* sums : {m.slopes, m.edges, m.gaps}) take(sums, 2);
}

std::vector<int64_t> Fields(const CellMeasure& measure) {
  std::vector<int64_t> all;
  ForFields(measure,
            [&](const auto* first, int count) { all.insert(all.end(), first, first + count); });
  return all;
}

}  // namespace

void MeasureCell(Draw* draw, KernelCall* call) {
  const size_t cells = draw->Size(1, 3, kTimedSamples / 64);  // beside each other
  const size_t width = 8 * cells + 2, stride = width + draw->Size(0, 9, 0);
  const int16_t* in = call->Input("disparity", CellDisparities(9 * stride + width, draw), kPadding);
  call->IgnoreRows(in + width, 9, stride, stride - width);
  std::vector<const int16_t*> all_rows;
  for (size_t n = 0; n < 10 * cells; ++n) {
    all_rows.push_back(in + 1 + n % 10 * stride + 8 * (n / 10));
  }
  const Rows rows = call->Input("rows", all_rows);
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
    return AllRight(cells, [&](size_t cell) {
      const CellMeasure& measure = measures[cell];
      (*met)[measure.edge_low > measure.edge_high ? "no edge" : "edges"] += 1;
      return Fields(measure) == Fields(Measured(rows + 10 * cell, limits));
    });
  };
}

}  // namespace test::kernel_cases
