// SPDX-License-Identifier: Apache-2.0
// Compares reference kernels with values computed by hand, where no test of pictures or of maps has
// an independent result. kernels_bytes_test.cc compares all SIMD targets with the references.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "simd/kernels.h"

namespace kernel_definitions_test {
namespace {

using namespace starfocus::simd;

// Compares an array with the expected values, element by element.
template <class T>
void CheckValues(const char* what, const T* found, const std::vector<int64_t>& expected) {
  CAPTURE(what);
  for (size_t n = 0; n < expected.size(); ++n) {
    CAPTURE(n);
    CHECK(int64_t(found[n]) == expected[n]);
  }
}

TEST_CASE("kernel definitions: MeasureCell returns values computed by hand") {
  // The disparities are flat, except for one pixel inside the cell, one pixel in a corner, and one
  // pixel beyond the left side.
  int16_t values[10][10] = {};
  const int16_t* rows[10];
  for (int k = 0; k < 10; ++k) rows[k] = values[k] + 1;
  values[1 + 3][1 + 4] = 97;
  values[1 + 0][1 + 7] = -20;
  values[1 + 5][0] = 500;
  CellMeasure measure;
  ReferenceKernels().MeasureCell(rows, {100, 96, 15, 90}, &measure);
  CheckValues("columns, low", measure.column_low, {0, 0, 0, 0, 0, 0, 0, -20});
  CheckValues("columns, high", measure.column_high, {0, 0, 0, 0, 97, 0, 0, 0});
  CheckValues("rows, low", measure.row_low, {-20, 0, 0, 0, 0, 0, 0, 0});
  CheckValues("rows, high", measure.row_high, {0, 0, 0, 97, 0, 0, 0, 0});
  CHECK(measure.nearest == 3);
  CHECK(measure.edge_low == 97);
  CHECK(measure.edge_high == 500);
  CheckValues("edges", measure.edges, {2, 2});
  CheckValues("gaps", measure.gaps, {2 * 90, 2 * 90});
  CheckValues("slopes", measure.slopes, {15, 15});
  values[1 + 5][0] = 0;
  values[1 + 3][1 + 4] = 96;
  values[1 + 6][1 + 0] = 4;
  values[1 + 7][1 + 3] = 5;
  ReferenceKernels().MeasureCell(rows, {100, 96, 15, 90}, &measure);
  CheckValues("rows, high", measure.row_high, {0, 0, 0, 96, 0, 0, 4, 5});
  CHECK(measure.edge_low == INT16_MAX);
  CHECK(measure.edge_high == INT16_MIN);
  CheckValues("edges", measure.edges, {0, 0});
  CheckValues("slopes", measure.slopes, {3 * 15 + 4 + 2 * 5, 3 * 15 + 2 * 4 + 5});

  // Edges beyond the right and the lower side do not belong to the cell.
  values[1 + 2][1 + 8] = 300;
  values[1 + 8][1 + 0] = 200;
  ReferenceKernels().MeasureCell(rows, {100, 96, 15, 90}, &measure);
  CHECK(measure.edge_low == 200);
  CHECK(measure.edge_high == 300);
  CheckValues("edges", measure.edges, {0, 0});
}

TEST_CASE("kernel definitions: CostLabels returns values computed by hand") {
  // CostLabels computes the costs of two labels for one pixel of level 100 and four views.
  const uint8_t planes[3 * 3] = {100, 107, 160, 100, 100, 100, 100, 100, 100};
  // At the second label, views 0 and 1 on one side have level 107, and the other views have level
  // 160.
  const ViewMove moves[] = {{0, 0}, {2, 0}, {2, 0}, {2, 0}, {1, 1}, {1, 0}, {2, 0}, {2, 0}};
  uint8_t cost[16];
  LabelRow costs = {};
  costs.pixels = planes;
  costs.plane = 3;
  costs.moves = moves;
  costs.labels = 2;
  costs.views = costs.arms = 4;
  costs.rings = 1;
  costs.one_side = true;
  ReferenceDepthKernels().CostLabels(costs, 1, 16, cost);
  CheckValues("one side", cost, {2 * 60, 4 * 7});
  costs.one_side = false;
  ReferenceDepthKernels().CostLabels(costs, 1, 16, cost);
  CHECK(int(cost[1]) == 7 + 7 + 60 + 60);
  // At the second label, the pixel is hidden in the first view, so the opposite view replaces the
  // first view.
  uint8_t hidden[] = {1, 2};
  costs.hidden = hidden;
  ReferenceDepthKernels().CostLabels(costs, 1, 16, cost);
  CHECK(int(cost[1]) == 60 + 7 + 60 + 60);
  // The opposite view does not replace the first view if the pixel is hidden in both views at the
  // second label.
  hidden[1] = 1;
  ReferenceDepthKernels().CostLabels(costs, 1, 16, cost);
  CHECK(int(cost[1]) == 7 + 7 + 60 + 60);
}

TEST_CASE(
    "kernel definitions: ChooseLabels finds the label of the smallest sum, and the margin of this "
    "label") {
  constexpr size_t kLabels = 5, kPlaces = PathLabels(kLabels);
  const int16_t sum[3][kPlaces] = {{80, 60, 20, 40, 420}, {3, 9, 9, 3, 3}, {50, 40, 30, 20, 10}};
  int16_t choice[3];
  uint8_t margin[3];
  ReferenceDepthKernels().ChooseLabels(sum[0], kLabels, 3, choice, margin);
  CheckValues("choice", choice, {2 * 64 + 32 * (40 - 20) / 40, 0, 4 * 64});
  CheckValues("margin", margin, {(80 - 20) / 8, 0, 2});
}

TEST_CASE("kernel definitions: DepthToDisparity returns values computed by hand") {
  const ImageKernels& kernels = ReferenceImageKernels();
  const DepthRule metres = {4000, -1, 65535, true, -10, 10};
  const float z[] = {1000, 4000, 0, 65535, 500};
  int16_t out[5];
  CHECK(kernels.DepthToDisparity(z, 5, metres, out) == kUnknownDepth);
  // The third depth value is a distance of 0, which has no valid disparity.
  CheckValues("metres", out, {3 * 64, 0, kNoSurface, kNoSurface, 7 * 64});
  const DepthRule linear = {0.5f, 2, NAN, false, -10, 10};
  const float steps[] = {0, 1, 16, 17};
  CHECK(kernels.DepthToDisparity(steps, 3, linear, out) == 0);
  CheckValues("linear", out, {2 * 64, 160, 10 * 64});
  CHECK(kernels.DepthToDisparity(steps, 4, linear, out) == kDepthOutside);
}

TEST_CASE("kernel definitions: BlendRows and UpsampleRow return values computed by hand") {
  const ImageKernels& kernels = ReferenceImageKernels();
  const int16_t a[] = {0, 0, 0, kNoSurface}, b[] = {96, 97, -96, 5};
  int16_t out[4];
  kernels.BlendRows(a, b, 4, 64, out);
  CheckValues("a quarter", out, {24, 0, -24, kNoSurface});
  kernels.BlendRows(a, b, 4, 128, out);
  CheckValues("half", out, {48, 97, -48, 5});
  const int16_t row[] = {0, 80, 1000};
  const uint32_t columns[] = {7 * 256, 7 * 256 + 128, 8 * 256 + 127, 8 * 256 + 128};
  kernels.UpsampleRow(row, columns, 4, 7, out);
  CheckValues("columns", out, {0, 40, 80, 1000});
}

}  // namespace
}  // namespace kernel_definitions_test
