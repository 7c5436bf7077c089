// SPDX-License-Identifier: Apache-2.0
// Tests the rules for N and the layer at, just below and just above every step.
#include "lib/optics/rules.h"

#include <doctest/doctest.h>

#include <algorithm>
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

TEST_CASE("rules: N by (9) is the ceiling of the radius below 4, and of 0.787 times larger radii") {
  CHECK(ViewsByPaper(0) == 0);
  CHECK(ViewsByPaper(std::numeric_limits<double>::denorm_min()) == 1);
  // With r in thousandths, the second value is the ceiling of 787 r / 10^6, in integers.
  for (int r = 1; r <= 128000; ++r) {
    const int most = (r + 999) / 1000, fewer = int((int64_t{787} * r + 999999) / 1000000);
    const int expected = most <= 4 ? most : std::max(4, fewer);
    if (ViewsByPaper(r / 1000.0) != expected) {
      CAPTURE(r);
      CHECK(ViewsByPaper(r / 1000.0) == expected);
    }
  }
  for (int n = 1; n <= 100; ++n) {
    CAPTURE(n);
    const double step = n < 4 ? n : n / 0.787;
    CHECK(ViewsByPaper(Below(step)) == n);
    CHECK(ViewsByPaper(step * (1 + 1e-12)) == n + 1);
  }
  CHECK(ViewsByPaper(4 / 0.787) == 4);
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

TEST_CASE("rules: the more an opening demands, the larger is N") {
  ApertureShape opening;
  CHECK(DemandOf(opening) == Demand::kFallOff);
  opening.cats_eye = 1;
  CHECK(DemandOf(opening) == Demand::kPolygon);
  opening.shape = STARFOCUS_SHAPE_RING;
  CHECK(DemandOf(opening) == Demand::kRing);
  opening.cats_eye = 0;
  CHECK(DemandOf(opening) == Demand::kRing);
  opening.shape = STARFOCUS_SHAPE_POLYGON;
  CHECK(DemandOf(opening) == Demand::kPolygon);
  opening.shape = STARFOCUS_SHAPE_DISC;
  CHECK(DemandOf(opening) == Demand::kDisc);
  for (const double r : {0.0, 0.5, 0.6, 5.0, 5.2, 5.5, 11.0, 11.5, 25.0, 30.0, 34.5, 128.0}) {
    CAPTURE(r);
    const int plain = ViewsBySubaperture(r), even = r > 0.5 ? 4 : 0, narrow = r > 5 ? 6 : even;
    CHECK(ViewsBySubaperture(r, Demand::kDisc) == std::max(plain, even));
    CHECK(ViewsBySubaperture(r, Demand::kPolygon) == std::max(plain, narrow));
    CHECK(ViewsBySubaperture(r, Demand::kRing) == ViewsBySubaperture(r, Demand::kPolygon));
  }
}

}  // namespace
}  // namespace rules_test
