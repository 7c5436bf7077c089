// SPDX-License-Identifier: Apache-2.0
// Recomputes the rules of Demand, which are the views and layers that openings without fall-off
// require.
#include <doctest/doctest.h>

#include <algorithm>

#include "examples/lab/analysis/ideal.h"
#include "examples/lab/analysis/subaperture_rule.h"
#include "examples/lab/analysis/subsampled.h"
#include "lib/optics/rules.h"
#include "tests/support/test_scene.h"

namespace starfocus::opening_rules_slow_test {
namespace {

using namespace analysis;

struct Asked {
  const char* name;
  BrightOpening opening;
  Demand demand;
};
const Asked kAsked[] = {{"disc", {0, 0}, Demand::kDisc},
                        {"pentagon", {0, 5}, Demand::kPolygon},
                        {"ring", {0.5, 0}, Demand::kRing}};

// Returns the smallest whole radius in pixels for which the function `layer` does not return layer
// 0.
template <class Layer>
int FirstRadius(const Layer& layer) {
  int r = 0;
  while (layer(double(r)) == 0) ++r;
  return r;
}

TEST_CASE(
    "openings: at its first radius, layer 1 has at most the error of a fall-off lens at r = 7") {
  const double fall_off = SubsampledError(7, {1.28, kDefaultTheta});
  for (const Asked& asked : kAsked) {
    CAPTURES(asked.name);
    const int first =
        FirstRadius([&](double r) { return LayerBySubaperture(r, true, asked.demand); });
    CHECK(LayerError(first, asked.opening) <= fall_off);
    CHECK(LayerError(first - 2, asked.opening) > fall_off);
    // By (12), the layer begins where the error falls below the threshold.
    const int paper = FirstRadius([&](double r) { return LayerByPaper(r, asked.demand); });
    CHECK(LayerError(paper, asked.opening) <= kThreshold);
    CHECK(LayerError(paper - 1, asked.opening) > kThreshold);
  }
}

TEST_CASE("openings: errors meet the threshold, or a quarter of the threshold if N is increased") {
  for (const Asked& asked : kAsked) {
    CAPTURES(asked.name);
    double worst = 0, beyond = 0;
    for (double r = 1.5; r <= 34; r += 0.5) {
      const int n = ViewsBySubaperture(r, asked.demand);
      const double error =
          SquaredError(SubaperturePsf(r, n, asked.opening), IdealPsf(r, asked.opening));
      worst = std::max(worst, error);
      if (r > 5) beyond = std::max(beyond, error);
    }
    CAPTURES(worst, beyond);
    CHECK(worst <= kThreshold);
    if (asked.demand == Demand::kDisc) continue;
    CHECK(beyond <= kThreshold / 4);
    // With N = 4, the error would exceed a quarter of the threshold.
    CHECK(WorstOfSubapertures(4, 5.5, 11, asked.opening) > kThreshold / 4);
  }
}

TEST_CASE("openings: a disc, a ring without a hole and a polygon of many blades are equal") {
  const double r = 6.25;
  const SampledPsf disc = IdealPsf(r, BrightOpening{0, 0});
  CHECK(SquaredError(disc, IdealPsf(r, BrightOpening{1e-9, 0})) < 1e-9);
  CHECK(SquaredError(disc, IdealPsf(r, BrightOpening{0, 60})) < 1e-6);
  CHECK(disc.Sum() == doctest::Approx(1));
  const double area = 3.14159265358979 * r * r;
  CHECK(disc(0, 0) == doctest::Approx(1 / area).epsilon(1e-3));
}

}  // namespace
}  // namespace starfocus::opening_rules_slow_test
