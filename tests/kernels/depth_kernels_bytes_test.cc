// SPDX-License-Identifier: Apache-2.0
// Compares every depth kernel with its reference on every SIMD target of this machine. Also
// compares the reference kernels with values computed by hand.
#include <doctest/doctest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "simd/kernels.h"
#include "tests/kernels/check_kernels.h"
#include "tests/kernels/kernel_cases.h"
#include "tests/support/simd_targets.h"

namespace depth_kernels_bytes_test {
namespace {

using namespace starfocus::simd;
using test::CheckValues;

TEST_CASE("depth kernels: every target returns the bits of the reference and writes nothing else") {
  CHECK(test::DepthTargets()[0] == &BestDepthKernels());
  test::CheckKernels<test::DepthCall>(test::depth_cases::kAll, ReferenceDepthKernels(),
                                      test::DepthTargets());
}

TEST_CASE("depth kernels: InterpolateRow and MatchView return values computed by hand") {
  const uint8_t row[] = {10, 20, 99}, next[] = {30, 50, 99};
  uint8_t sample[16];
  // Interpolation a quarter of the way down results in 15, 27.5 (rounded to 28) and 99.
  // Interpolation half of the way across then results in 21.5 (22) and 63.5 (64).
  ReferenceDepthKernels().InterpolateRow(row, next, 64, 32, 2, sample);
  CheckValues("samples", sample, {22, 64});
  // Each array holds two pixels, stored as planes of red, green and blue.
  const uint8_t view[] = {22, 64, 5, 0, 0, 0}, centre[] = {25, 0, 3, 0, 1, 0};
  uint8_t difference[2];
  reference::MatchView(centre, view, 2, 2, difference);
  CheckValues("differences", difference, {3 + 2 + 1, 60});
}

TEST_CASE("depth kernels: CostLabels returns values computed by hand") {
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

TEST_CASE("depth kernels: SeenCost averages the views that see the pixel, on the best side") {
  const uint8_t values[3][2] = {{6, 60}, {9, 60}, {20, 60}};
  const uint8_t* differences[] = {values[0], values[1], values[2]};
  const uint16_t masks[] = {3, 4};
  uint8_t cost[2];
  reference::SeenCost(differences, nullptr, 0, masks, 2, 2, cost);
  CheckValues("all see", cost, {30, 240});
  // The first view hides labels 0 to 4, and the second view shows the first pixel only.
  const uint8_t behind[3][2] = {{5, 5}, {4, kViewEnds}, {5, 5}};
  const uint8_t* hidden[] = {behind[0], behind[1], behind[2]};
  reference::SeenCost(differences, hidden, 4, masks, 2, 2, cost);
  CheckValues("hidden", cost, {36, 192});
  reference::SeenCost(differences, hidden, 5, masks + 1, 1, 2, cost);
  CheckValues("second side", cost, {80, 240});
}

TEST_CASE("depth kernels: StandIn replaces a view that does not see a pixel by the opposite view") {
  const uint8_t hidden_a[] = {5, 6, 5, 6}, hidden_b[] = {5, 5, 6, 6};
  uint8_t a[16] = {1, 2, 3, 4}, b[16] = {11, 12, 13, 14};
  reference::StandIn(hidden_a, hidden_b, 5, 4, a, b);
  CheckValues("a", a, {1, 12, 3, 48});
  CheckValues("b", b, {11, 12, 3, 48});
}

TEST_CASE("depth kernels: LimitHidden limits the differences of views that do not see the pixel") {
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

TEST_CASE(
    "depth kernels: PropagatePrior spreads the prior of a map to neighbours at the expected cost") {
  uint8_t row[2][3][16];
  std::fill_n(row[0][0], sizeof(row), uint8_t{kMostPrior});
  row[0][1][7] = 0;  // cost 0 at label 7 of the previous row's middle pixel
  ReferenceDepthKernels().PropagatePrior(row[1][2], row[0][2], 16, -1, 3);
  CHECK(int(row[1][2][7]) == 4);
  CHECK(int(row[1][1][7]) == 3);
  CHECK(int(row[1][0][7]) == 4);
  CHECK(int(row[1][1][6]) == 24);
}

TEST_CASE("depth kernels: LeastSide and MeanCost return values computed by hand") {
  const uint8_t values[16] = {60, 60, 60, 60, 6, 9, 15, 60, 60, 60, 60, 60, 0, 3, 9, 60};
  const uint8_t* rows[16];
  for (int k = 0; k < 16; ++k) rows[k] = values + k;
  uint8_t cost[16];
  reference::LeastSide(rows, 8, 2, 1, cost);
  CHECK(int(cost[0]) == 42 * 171 / 256);  // sum of arms 4, 5 and 6 of both rings
  reference::LeastSide(rows + 4, 8, 1, 1, cost);
  CHECK(int(cost[0]) == 2 * 30 * 171 / 256);
  reference::LeastSide(rows + 3, 4, 1, 1, cost);
  CHECK(int(cost[0]) == 3 * 15 * 171 / 256);
  reference::MeanCost(rows + 12, 4, 1, cost);
  CHECK(int(cost[0]) == 72);
}

TEST_CASE("depth kernels: SumVotes weighs similar colours of farther and nearer pixels") {
  constexpr size_t kStride = kSliceLanes + 2, kSamples = 3 * kStride;
  std::vector<int16_t> colour(kSamples, 100), surface(kSamples, 0), trust(kSamples, 0);
  const std::vector<int16_t> middle(kSliceLanes, 50), closeness(9, 8 * kClosenessUnit);
  // The first pixel has a nearer sample of its colour above it, and a farther sample whose colour
  // differs by 3 * 10 beside it. The second pixel has both beside it.
  const size_t own = kStride + 1;
  surface[1] = 51;
  trust[1] = kMostTrust;
  surface[own - 1] = 50;
  trust[own - 1] = kMostTrust / 2;
  colour[own - 1] = 110;
  const int16_t* plane = colour.data() + own;
  const int16_t* const colours[] = {plane, plane, plane};
  VoteSums sums;
  ReferenceDepthKernels().SumVotes(colours, surface.data() + own, trust.data() + own, middle.data(),
                                   kStride, 1, 1, closeness.data(), &sums);
  CHECK(sums.weight[1][0] == 8);
  CHECK(sums.similar[1][0] == 8 * kMostSimilar / 16);
  CHECK(sums.weight[0][0] == 4);
  CHECK(sums.similar[0][0] == 4 * (66 * 66 >> 9) / 16);
  CHECK(sums.weight[1][1] == 8);
  CHECK(sums.weight[0][1] == 0);
}

TEST_CASE("depth kernels: SmoothDisparity averages noise within a surface") {
  // The test smooths two rows of four pixels. The disparities of the second row are averaged over
  // both rows.
  constexpr size_t kPlane = 4;
  const int32_t first[4 * kPlane] = {-104, -100, 900, -90, 90, 90, 90, 690};
  const int32_t second[4 * kPlane] = {-100, -101, -100, -100, 90, 90, 130, 90};
  const int32_t* const rows[] = {first + 1, second + 1};
  const auto& kernels = ReferenceDepthKernels();
  int16_t smooth[2];
  kernels.SmoothDisparity(second + 1, rows, 2, kPlane, 1, 1, 10, 2, smooth);
  // In the first expected mean, the values -104, -100, -100 and -101 have weight 64, and the other
  // -100 has weight 54.
  CHECK(smooth[0] == -101);
  // With a tolerance of 9, the value that differs by 10 has no weight. One value of -100 has weight
  // 64, and the values -100, -101 and -100 have weight 54.
  kernels.SmoothDisparity(second + 1, rows, 2, kPlane, 1, 1, 9, 2, smooth);
  CHECK(smooth[1] == -100);
  // Disparities of pixels with another colour have weight 1.
  const int32_t bright[4 * kPlane] = {-96, -96, -96, -96, 690, 690, 690, 690};
  const int32_t* const columns[] = {bright + 1, second + 2};
  kernels.SmoothDisparity(second + 2, columns, 2, kPlane, 0, 1, 9, 1, smooth);
  CHECK(smooth[0] == -100);
}

TEST_CASE(
    "depth kernels: AddPaths continues a path from the previous pixel at the expected costs") {
  constexpr size_t kLabels = 4, kPlaces = PathLabels(kLabels);
  uint8_t cost[kPlaces] = {1, 2, 3, 4};
  int16_t before[1 + kPlaces] = {0, 7, 90, 500, 33};
  for (size_t l = kLabels; l < kPlaces; ++l) before[1 + l] = kNoLabel;
  const int16_t before_least = 7, jump = 100;
  int16_t path[kPlaces], least = 0, sum[kPlaces] = {10, 20, 30, 40};
  const PathRow row = {cost, before + 1, &before_least, &jump, path, &least, sum, true};
  ReferenceDepthKernels().AddPaths(row, kLabels, 1, 1);
  // Label 0 continues the path at no cost, and label 1 at the cost of a slope, 24. Label 3
  // continues the path at cost 26, and label 2 at cost 26 + 24.
  CheckValues("path", path, {1, 2 + 24, 3 + 50, 4 + 26, kNoLabel});
  CHECK(sum[3] == 70);
  CHECK(least == 1);
}

TEST_CASE(
    "depth kernels: ChooseLabels finds the label of the smallest sum, and the margin of this "
    "label") {
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
