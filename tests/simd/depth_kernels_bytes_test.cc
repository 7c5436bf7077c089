// SPDX-License-Identifier: Apache-2.0
// Every depth kernel on every SIMD target of this machine against its reference, and what the
// references compute, by hand.
#include <doctest/doctest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "simd/depth_kernels.h"
#include "tests/simd/check_kernels.h"
#include "tests/simd/kernel_cases.h"
#include "tests/support/simd_targets.h"

namespace depth_kernels_bytes_test {
namespace {

using namespace starfocus::simd;
using test::CheckValues;

TEST_CASE("depth kernels: every target gives the bits of the reference and writes nothing else") {
  CHECK(test::DepthTargets()[0] == &BestDepthKernels());
  test::CheckKernels<test::DepthCall>(test::depth_cases::kAll, ReferenceDepthKernels(),
                                      test::DepthTargets());
}

TEST_CASE("depth kernels: samples between pixels, and how much pixels differ, by hand") {
  const uint8_t row[] = {10, 20, 99}, next[] = {30, 50, 99};
  uint8_t sample[16];
  // Down a quarter: 15, 27.5 (28) and 99; across a half: 21.5 (22) and 63.5 (64).
  ReferenceDepthKernels().InterpolateRow(row, next, 64, 32, 2, sample);
  CheckValues("samples", sample, {22, 64});
  // Two pixels, in planes.
  const uint8_t view[] = {22, 64, 5, 0, 0, 0}, centre[] = {25, 0, 3, 0, 1, 0};
  uint8_t difference[2];
  reference::MatchView(centre, view, 2, 2, difference);
  CheckValues("differences", difference, {3 + 2 + 1, 60});
}

TEST_CASE("depth kernels: what labels cost, by hand") {
  // One pixel at 100, four views, two labels.
  const uint8_t planes[3 * 3] = {100, 107, 160, 100, 100, 100, 100, 100, 100};
  // The second label of the views on one side, 0 and 1, is seen at 107; others at 160.
  const ViewMove moves[] = {{0, 0}, {2, 0}, {2, 0}, {2, 0}, {1, 1}, {1, 0}, {2, 0}, {2, 0}};
  uint8_t cost[16];
  LabelRow costs = {};
  costs.pixels = planes;
  costs.plane = 3;
  costs.moves = moves;
  costs.labels = 2;
  costs.arms = 4;
  costs.rings = 1;
  costs.one_side = true;
  ReferenceDepthKernels().CostLabels(costs, 1, 16, cost);
  CheckValues("one side", cost, {2 * 60, 4 * 7});
  costs.one_side = false;
  ReferenceDepthKernels().CostLabels(costs, 1, 16, cost);
  CHECK(int(cost[1]) == 7 + 7 + 60 + 60);
  // The first view does not see the second label: the one opposite stands in for it.
  uint8_t hidden[] = {1, 2};
  costs.hidden = hidden;
  ReferenceDepthKernels().CostLabels(costs, 1, 16, cost);
  CHECK(int(cost[1]) == 60 + 7 + 60 + 60);
  // Not when only the first one is hidden there.
  hidden[1] = 1;
  ReferenceDepthKernels().CostLabels(costs, 1, 16, cost);
  CHECK(int(cost[1]) == 7 + 7 + 60 + 60);
}

TEST_CASE("depth kernels: who sees a pixel stands in for who doesn't, by hand") {
  const uint8_t hidden_a[] = {5, 6, 5, 6}, hidden_b[] = {5, 5, 6, 6};
  uint8_t a[16] = {1, 2, 3, 4}, b[16] = {11, 12, 13, 14};
  reference::StandIn(hidden_a, hidden_b, 5, 4, a, b);
  CheckValues("a", a, {1, 12, 3, 48});
  CheckValues("b", b, {11, 12, 3, 48});
}

TEST_CASE(
    "depth kernels: a hidden view counts little, and more where none sees the pixel, by hand") {
  const uint8_t rows[4][4] = {{5, 6, 6, 6}, {5, 6, 6, 5}, {5, 5, 6, 5}, {5, 6, 6, 5}};
  uint8_t values[4][16] = {{60, 60, 60, 3}, {50, 50, 50, 50}, {40, 40, 40, 40}, {2, 2, 2, 2}};
  const uint8_t* hidden[] = {rows[0], rows[1], rows[2], rows[3]};
  uint8_t* differences[] = {values[0], values[1], values[2], values[3]};
  reference::LimitHidden(hidden, 5, 4, 4, differences);
  CheckValues("first", values[0], {60, 18, 27, 3});
  CheckValues("second", values[1], {50, 18, 27, 50});
  CheckValues("third", values[2], {40, 40, 27, 40});
  CheckValues("fourth", values[3], {2, 2, 2, 2});
}

TEST_CASE("depth kernels: what a map says spreads to neighbours, by hand") {
  uint8_t row[2][3][16];
  std::fill_n(row[0][0], sizeof(row), uint8_t{kMostPrior});
  row[0][1][7] = 0;  // the middle pixel of the row before
  ReferenceDepthKernels().SpreadPrior({row[1][2], row[0][2], 16, -1, 3});
  CHECK(int(row[1][2][7]) == 4);
  CHECK(int(row[1][1][7]) == 3);
  CHECK(int(row[1][0][7]) == 4);
  CHECK(int(row[1][1][6]) == 24);
}

TEST_CASE("depth kernels: costs of views on one side, and of all, by hand") {
  const uint8_t values[16] = {60, 60, 60, 60, 6, 9, 15, 60, 60, 60, 60, 60, 0, 3, 9, 60};
  const uint8_t* rows[16];
  for (int k = 0; k < 16; ++k) rows[k] = values + k;
  uint8_t cost[16];
  reference::LeastSide(rows, 8, 2, 1, cost);
  CHECK(int(cost[0]) == 42 * 171 / 256);  // arms 4, 5 and 6 of both rings
  reference::LeastSide(rows + 4, 8, 1, 1, cost);
  CHECK(int(cost[0]) == 2 * 30 * 171 / 256);
  reference::LeastSide(rows + 3, 4, 1, 1, cost);
  CHECK(int(cost[0]) == 3 * 15 * 171 / 256);
  reference::MeanCost(rows + 12, 4, 1, cost);
  CHECK(int(cost[0]) == 72);
}

TEST_CASE("depth kernels: the best of each group around a pixel, by hand") {
  std::vector<ColourSample> samples(kColourWindow * kColourWindow, {90, 0, 0, kNoColourKey, 0});
  const auto set = [&](int row, int column, const ColourSample& sample) {
    samples[size_t(row * kColourWindow + column)] = sample;
  };
  // Of the first group within reach of the first pixel: one of a grey brighter by 31, and one that
  // differs by more than counts. Beyond its reach: one of the same colour.
  set(0, 16, {121, 0, 0, 5 * 64 + 3, 0});
  set(16, 0, {90, 60, -30, 1 * 64, 0});
  set(8, 17, {90, 0, 0, 2, 0});
  // Of the second group, within reach of the last pixel alone: 3 + 10 + 4 + 14 away.
  set(19, 19, {105, 10, 4, 63, kSliceLanes});
  std::vector<uint16_t> least(2 * kSliceLanes, kNoColourKey);
  ReferenceDepthKernels().CompareColours(samples.data(), kColourWindow, least.data());
  CHECK(least[0] == (7 + 5) * 64 + 3);
  CHECK(least[1] == 2);
  CHECK(least[4] == (100 + 1) * 64);
  CHECK(least[kSliceLanes] == kNoColourKey);
  CHECK(least[2 * kSliceLanes - 1] == 31 * 64 + 63);
}

TEST_CASE("depth kernels: noise is averaged within a surface, by hand") {
  // Two rows of four pixels; the second one is averaged over itself and the first one.
  constexpr size_t kPlane = 4;
  const int32_t first[4 * kPlane] = {-104, -100, 900, -90, 90, 90, 90, 690};
  const int32_t second[4 * kPlane] = {-100, -101, -100, -100, 90, 90, 130, 90};
  SmoothRows rows = {};
  rows.own = second + 1;
  rows.rows[0] = first + 1;
  rows.rows[1] = second + 1;
  rows.count = 2;
  rows.plane = kPlane;
  rows.radius = rows.step = 1;
  rows.tolerance = 10;
  int16_t smooth[2];
  ReferenceDepthKernels().SmoothDisparity(rows, 2, smooth);
  // 64 times -104, -100, -100 and -101, and 54 times -100.
  CHECK(smooth[0] == -101);
  // One beyond the tolerance does not count. 54 times -100 and -101, 64 times -100, 54 times -100.
  rows.tolerance = 9;
  ReferenceDepthKernels().SmoothDisparity(rows, 2, smooth);
  CHECK(smooth[1] == -100);
  // Of another colour: it counts 1.
  const int32_t bright[4 * kPlane] = {-96, -96, -96, -96, 690, 690, 690, 690};
  rows.rows[0] = bright + 1;
  rows.rows[1] = second + 2;
  rows.own = second + 2;
  rows.radius = 0;
  ReferenceDepthKernels().SmoothDisparity(rows, 1, smooth);
  CHECK(smooth[0] == -100);
}

TEST_CASE("depth kernels: a path goes on from the one before, by hand") {
  constexpr size_t kLabels = 4, kPlaces = PathLabels(kLabels);
  uint8_t cost[kPlaces] = {1, 2, 3, 4};
  int16_t before[1 + kPlaces] = {0, 7, 90, 500, 33};
  for (size_t l = kLabels; l < kPlaces; ++l) before[1 + l] = kNoLabel;
  const int16_t before_least = 7, jump = 100;
  int16_t path[kPlaces], least = 0, sum[kPlaces] = {10, 20, 30, 40};
  const PathRow row = {cost, before + 1, &before_least, &jump, path, &least, sum, true};
  ReferenceDepthKernels().AddPaths(row, kLabels, 1, 1);
  // From label 0 at no cost; to label 1 by a slope of 24; from 3 at 26; to 2 by 26 + 24.
  CheckValues("path", path, {1, 2 + 24, 3 + 50, 4 + 26, kNoLabel});
  CHECK(sum[3] == 70);
  CHECK(least == 1);
}

TEST_CASE("depth kernels: the label of the least sum, by hand") {
  constexpr size_t kLabels = 5, kPlaces = PathLabels(kLabels);
  const int16_t sum[3][kPlaces] = {{80, 60, 20, 40, 420}, {3, 9, 9, 3, 3}, {50, 40, 30, 20, 10}};
  int16_t choice[3];
  uint8_t margin[3];
  ReferenceDepthKernels().ChooseLabels(sum[0], kLabels, 3, choice, margin);
  CheckValues("choice", choice, {2 * 64 + 32 * (40 - 20) / 40, 0, 4 * 64});
  CheckValues("margin", margin, {(80 - 20) / 8, 0, 2});
}

}  // namespace
}  // namespace depth_kernels_bytes_test
