// SPDX-License-Identifier: Apache-2.0
// Measures by how much pictures of block mode exceed the range of levels in the views. starfocus.h
// states the limit. The half-band filters of layers 1 and 2 have negative taps. A picture that is
// bright exactly at the negative taps darkens a pixel most.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "examples/lab/analysis/engine_psf.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/test_scene.h"
#include "tests/support/transfer_curve.h"

namespace overshoot_test {
namespace {

using namespace starfocus::analysis;

constexpr int kSide = 128, kMiddle = 64, kLow = 60, kHigh = 200;

EnginePsf Measure(double r, starfocus_renderer renderer, int layer) {
  const EngineProbe probe = {r, r, STARFOCUS_MODE_BLOCK, renderer, layer};
  EnginePsf measured = {SampledPsf(0), 0, 0, 0};
  REQUIRE(starfocus::analysis::MeasureEnginePsf(probe, &measured) == STARFOCUS_OK);
  return measured;
}

// Returns the sum of the negative taps of a PSF: the overshoot of the worst picture of contrast 1.
double NegativeSum(SampledPsf psf) {
  double sum = 0;
  for (int m = -psf.radius(); m <= psf.radius(); ++m) {
    for (int n = -psf.radius(); n <= psf.radius(); ++n) sum -= std::min(0.0, psf.at(n, m));
  }
  return sum;
}

// Refocuses a picture that is bright where the PSF around (x, y) is negative. Returns how far the
// darkest pixel falls below the darker level, as a fraction of the difference of light between both
// levels.
double Undershoot(double r, starfocus_renderer renderer, int layer, starfocus_transfer transfer,
                  SampledPsf psf, int x, int y) {
  test::Scene scene = test::EmptyScene(kSide, kSide, 1, float(r), float(r));
  for (int v = 0; v < kSide; ++v) {
    for (int u = 0; u < kSide; ++u) {
      const int n = x - u, m = y - v;
      const bool inside = std::max(std::abs(n), std::abs(m)) <= psf.radius();
      const bool bright = inside && psf.at(n, m) < 0;
      std::fill_n(scene.Pixel(0, u, v), 3, uint8_t(bright ? kHigh : kLow));
    }
  }
  starfocus::Params params = test::Params(0, 1, STARFOCUS_MODE_BLOCK);
  params.study.renderer = renderer;
  test::Config config = test::ConfigFor(scene, r + 1);
  config.transfer = transfer;
  config.tuning.max_layer = layer;
  config.tuning.gather = 0;
  config.superblock = 128;
  test::Engine engine(config);
  test::Output out(kSide, kSide);
  REQUIRE(test::Refocus(&engine, params, scene, &out) == STARFOCUS_OK);
  const auto light = [&](int level) { return test::LightOf(level, transfer); };
  int darkest = kLow;
  for (const uint8_t level : out.bytes) darkest = std::min(darkest, int(level));
  return (light(kLow) - light(darkest)) / (light(kHigh) - light(kLow));
}

// Returns the largest overshoot at the given radii. For each radius, measures the PSF's negative
// taps, and refocuses the worst picture for each position on the layer's grid.
double Worst(starfocus_renderer renderer, const std::vector<double>& radii) {
  double worst = 0;
  for (const double r : radii) {
    const EnginePsf measured = Measure(r, renderer, 2);
    double worst_here = 0;
    const int step = 1 << measured.layer;
    for (int k = 0; k < step; ++k) {
      for (const starfocus_transfer transfer : {STARFOCUS_TRANSFER_NONE, STARFOCUS_TRANSFER_SRGB}) {
        worst_here = std::max(worst_here, Undershoot(r, renderer, measured.layer, transfer,
                                                     measured.psf, kMiddle + k, kMiddle + k));
      }
    }
    std::printf("rule %d, blur %.2f, layer %d: negative taps %.4f, undershoot %.4f\n",
                int(renderer), r, measured.layer, NegativeSum(measured.psf), worst_here);
    worst = std::max({worst, worst_here, NegativeSum(measured.psf)});
  }
  return worst;
}

}  // namespace

TEST_CASE("overshoot: pictures exceed the range of the views by at most the limit in starfocus.h") {
  const double subapertures = Worst(STARFOCUS_RENDERER_SLICES, {7, 7.5, 8, 10, 24, 26, 30});
  const double paper = Worst(STARFOCUS_RENDERER_LINE_SCAN, {3, 3.25, 3.5, 4, 6, 6.5, 7, 8, 12, 13});
  CHECK(subapertures <= 0.04);
  CHECK(paper <= 0.13);
  // At layer 0, taps are negative only because of rounding.
  CHECK(NegativeSum(Measure(7.5, STARFOCUS_RENDERER_SLICES, 0).psf) < 1e-3);
}

}  // namespace overshoot_test
