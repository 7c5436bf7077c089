// SPDX-License-Identifier: Apache-2.0
// Tests the rules for N and the layer at, just below and just above every step.
#include "lib/optics/rules.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>

#include "starfocus/starfocus.h"

namespace rules_test {
namespace {

using namespace starfocus;

double Below(double value) { return std::nextafter(value, 0.0); }
double Above(double value) { return std::nextafter(value, 1e9); }

TEST_CASE("rules: below a radius of 4, N by (9) is the ceiling of the radius") {
  CHECK(ViewsByPaper(0) == 0);
  CHECK(ViewsByPaper(std::numeric_limits<double>::denorm_min()) == 1);
  CHECK(ViewsByPaper(0.5) == 1);
  for (int r = 1; r <= 3; ++r) {
    CAPTURE(r);
    CHECK(ViewsByPaper(Below(r)) == r);
    CHECK(ViewsByPaper(r) == r);
    CHECK(ViewsByPaper(Above(r)) == r + 1);
  }
}

TEST_CASE("rules: from a radius of 4 to 4 / 0.787, N by (9) is 4") {
  CHECK(ViewsByPaper(Below(4)) == 4);
  CHECK(ViewsByPaper(4) == 4);
  CHECK(ViewsByPaper(Above(4)) == 4);
  CHECK(ViewsByPaper(5) == 4);
  CHECK(ViewsByPaper(5.08) == 4);
  const double threshold = 4 / 0.787;
  CHECK(ViewsByPaper(Below(threshold)) == 4);
  CHECK(ViewsByPaper(threshold) == 4);
  CHECK(ViewsByPaper(threshold * (1 + 1e-12)) == 5);
  CHECK(ViewsByPaper(5.09) == 5);
}

TEST_CASE("rules: above a radius of 4 / 0.787, N by (9) is the ceiling of 0.787 times the radius") {
  // With r in thousandths, the expected value is the ceiling of 787 r / 10^6, in integers.
  for (int r = 5083; r <= 128000; ++r) {
    const int expected = int((int64_t{787} * r + 999999) / 1000000);
    if (ViewsByPaper(r / 1000.0) != expected) {
      CAPTURE(r);
      CHECK(ViewsByPaper(r / 1000.0) == expected);
    }
  }
  for (int n = 5; n <= 100; ++n) {
    const double step = n / 0.787;
    CAPTURE(n);
    CHECK(ViewsByPaper(step * (1 - 1e-12)) == n);
    CHECK(ViewsByPaper(step * (1 + 1e-12)) == n + 1);
  }
}

TEST_CASE("rules: N by (9) matches a table") {
  constexpr int kTable[][2] = {{2, 2},   {4, 4},   {5, 4},   {6, 5},   {8, 7},  {10, 8},
                               {12, 10}, {16, 13}, {20, 16}, {24, 19}, {32, 26}};
  for (const auto& row : kTable) CHECK(ViewsByPaper(row[0]) == row[1]);
}

TEST_CASE("rules: N by (9) never decreases with the radius") {
  int last = 0;
  for (double r = 0; r <= STARFOCUS_MAX_BLUR; r += 1.0 / 64) {
    REQUIRE(ViewsByPaper(r) >= last);
    last = ViewsByPaper(r);
  }
}

TEST_CASE("rules: N of the benchmark is twice the ceiling of the radius") {
  CHECK(ViewsOfBenchmark(0) == 0);
  CHECK(ViewsOfBenchmark(0.01) == 2);
  for (int r = 1; r <= 128; ++r) {
    CAPTURE(r);
    CHECK(ViewsOfBenchmark(Below(r)) == 2 * r);
    CHECK(ViewsOfBenchmark(r) == 2 * r);
    CHECK(ViewsOfBenchmark(Above(r)) == 2 * r + 2);
  }
}

TEST_CASE("rules: a scale multiplies N and rounds the product up; N = 0 does not change") {
  for (int n = 0; n <= 102; ++n) {
    CAPTURE(n);
    CHECK(ScaleViews(n, 1) == n);
    CHECK(ScaleViews(n, 0.5) == (n + 1) / 2);
    CHECK(ScaleViews(n, 2) == 2 * n);
    // ScaleViews must round correctly, although factors in tenths are not exact as doubles.
    for (int tenths = 5; tenths <= 20; ++tenths) {
      CAPTURE(tenths);
      CHECK(ScaleViews(n, tenths / 10.0) == (n * tenths + 9) / 10);
    }
  }
}

TEST_CASE("rules: N by the rule for subapertures matches the table") {
  constexpr struct {
    double r_max;
    int n;
  } kTable[] = {{0.5, 0}, {5.5, 3}, {11, 4},  {25, 5},   {34, 6},
                {49, 7},  {68, 9},  {83, 11}, {119, 12}, {128, 13}};
  CHECK(ViewsBySubaperture(0) == 0);
  for (size_t k = 0; k < std::size(kTable); ++k) {
    CAPTURE(kTable[k].r_max);
    CHECK(ViewsBySubaperture(Below(kTable[k].r_max)) == kTable[k].n);
    CHECK(ViewsBySubaperture(kTable[k].r_max) == kTable[k].n);
    if (k + 1 < std::size(kTable))
      CHECK(ViewsBySubaperture(Above(kTable[k].r_max)) == kTable[k + 1].n);
  }
}

TEST_CASE("rules: by (12), layer 1 begins at radius 3 and layer 2 at radius 6") {
  CHECK(LayerByPaper(0) == 0);
  CHECK(LayerByPaper(Below(3)) == 0);
  CHECK(LayerByPaper(3) == 1);
  CHECK(LayerByPaper(Below(6)) == 1);
  CHECK(LayerByPaper(6) == 2);
  CHECK(LayerByPaper(STARFOCUS_MAX_BLUR) == 2);
}

TEST_CASE("rules: by subapertures, layers 1 and 2 begin at radii 7 and 24; edges have no layer 2") {
  CHECK(LayerBySubaperture(0, false) == 0);
  CHECK(LayerBySubaperture(Below(7), false) == 0);
  CHECK(LayerBySubaperture(7, false) == 1);
  CHECK(LayerBySubaperture(Below(24), false) == 1);
  CHECK(LayerBySubaperture(24, false) == 2);
  CHECK(LayerBySubaperture(STARFOCUS_MAX_BLUR, false) == 2);
  CHECK(LayerBySubaperture(0, true) == 0);
  CHECK(LayerBySubaperture(Below(7), true) == 0);
  CHECK(LayerBySubaperture(7, true) == 1);
  CHECK(LayerBySubaperture(STARFOCUS_MAX_BLUR, true) == 1);
}

TEST_CASE("rules: the more an opening demands, the larger are N and the first radii of layers") {
  using starfocus::ApertureShape;
  using starfocus::Demand;
  ApertureShape opening;
  CHECK(starfocus::DemandOf(opening) == Demand::kFallOff);
  opening.shape = STARFOCUS_SHAPE_DISC;
  CHECK(starfocus::DemandOf(opening) == Demand::kDisc);
  opening.shape = STARFOCUS_SHAPE_POLYGON;
  CHECK(starfocus::DemandOf(opening) == Demand::kPolygon);
  opening.shape = STARFOCUS_SHAPE_RING;
  CHECK(starfocus::DemandOf(opening) == Demand::kRing);
  opening.cats_eye = 1;
  CHECK(starfocus::DemandOf(opening) == Demand::kRing);
  opening.shape = STARFOCUS_SHAPE_FALL_OFF;
  CHECK(starfocus::DemandOf(opening) == Demand::kPolygon);
  for (const double r : {0.0, 0.5, 0.6, 5.0, 5.2, 5.5, 11.0, 11.5, 25.0, 30.0, 34.5, 128.0}) {
    CAPTURE(r);
    const int plain = ViewsBySubaperture(r), even = r > 0.5 ? 4 : 0, narrow = r > 5 ? 6 : even;
    CHECK(ViewsBySubaperture(r, Demand::kDisc) == (plain > even ? plain : even));
    CHECK(ViewsBySubaperture(r, Demand::kPolygon) == (plain > narrow ? plain : narrow));
    CHECK(ViewsBySubaperture(r, Demand::kRing) == ViewsBySubaperture(r, Demand::kPolygon));
  }
  constexpr struct {
    Demand demand;
    double paper, subaperture;
  } kFirst[] = {{Demand::kDisc, 4, 12}, {Demand::kPolygon, 5, 14}, {Demand::kRing, 6, 16}};
  for (const auto& first : kFirst) {
    CHECK(LayerByPaper(Below(first.paper), first.demand) == 0);
    CHECK(LayerByPaper(first.paper, first.demand) == 1);
    CHECK(LayerByPaper(Below(2 * first.paper), first.demand) == 1);
    CHECK(LayerByPaper(2 * first.paper, first.demand) == 2);
    CHECK(LayerBySubaperture(Below(first.subaperture), false, first.demand) == 0);
    CHECK(LayerBySubaperture(first.subaperture, true, first.demand) == 1);
    CHECK(LayerBySubaperture(first.subaperture * 3.42, false, first.demand) == 1);
    CHECK(LayerBySubaperture(first.subaperture * 3.43, false, first.demand) == 2);
    CHECK(LayerBySubaperture(STARFOCUS_MAX_BLUR, true, first.demand) == 1);
  }
}

}  // namespace
}  // namespace rules_test
