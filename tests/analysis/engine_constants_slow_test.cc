// SPDX-License-Identifier: Apache-2.0
// Compares the constants of the engine with the analysis. A failure names the affected figure of
// the paper. If a test fails, either the constant is wrong, or the analysis, the figure and the
// documents must change together.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "examples/lab/analysis/engine_psf.h"
#include "examples/lab/analysis/ideal.h"
#include "examples/lab/analysis/subaperture_rule.h"
#include "examples/lab/analysis/subsampled.h"
#include "examples/lab/analysis/view_psf.h"
#include "lib/base/fixed.h"
#include "lib/gather/gather.h"
#include "lib/io/layers.h"
#include "lib/line_scan/line_scan.h"
#include "lib/optics/psf.h"
#include "lib/optics/rules.h"
#include "lib/optics/view_weights.h"
#include "lib/plan/partition.h"
#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/test_scene.h"

namespace starfocus::engine_constants_slow_test {
namespace {

using namespace analysis;

TEST_CASE("constants: the default theta is the theta of Table I at r = 3") {
  starfocus::Params params;
  const double theta = params.theta, table = OptimiseOnGrid(3).filters.theta;
  CHECK_MESSAGE(theta == doctest::Approx(table).epsilon(1e-12),
                "the default of starfocus_params.theta is "
                    << theta / kPi << " pi, but Table I has " << table / kPi
                    << " pi, which affects all figures and rules of the paper");
  CHECK_MESSAGE(theta == doctest::Approx(kDefaultTheta).epsilon(1e-12),
                "kDefaultTheta of examples/lab/analysis differs from the engine's default theta");
}

TEST_CASE("constants: the numbers of views follow equation (9)") {
  // Tests the largest r with N = 4, and the slope of N(r) beyond this radius.
  const auto jump = [](int n) {
    return Cross(0.1, 128, 1e-9, [&](double r) { return ViewsByPaper(r) - n - 0.5; });
  };
  for (const int n : {4, 80}) {
    CHECK_MESSAGE(n / jump(n) == doctest::Approx(0.787).epsilon(1e-6),
                  "the under-sampling ratio of Fig. 6 and (9) is not 0.787");
  }
  for (int n = 1; n <= 3; ++n) {
    CHECK_MESSAGE(jump(n) == doctest::Approx(n).epsilon(1e-6),
                  "below r = 4, N by (9) is not the ceiling of r");
  }
  for (int n = 4; n <= 32; ++n) {
    const double r = jump(n) - 1e-6, over = WorstOverSampling(n, kDefaultTheta).error;
    CHECK_MESSAGE(PaperError(r, n, kDefaultTheta) <= over,
                  "Fig. 6: N = " << n << " is selected up to r = " << r
                                 << ", where the error exceeds the largest error of over-sampling");
  }
  for (const double r : {0.3, 1.0, 2.5, 7.0, 40.0}) {
    CHECK_MESSAGE(ViewsOfBenchmark(r) == 2 * static_cast<int>(std::ceil(r)),
                  "N of the benchmark is not 2 ceil(r), which affects every PSNR of section VI");
  }
}

TEST_CASE("constants: aperture weights are a_{d,N} of equation (5)") {
  for (const int n : {1, 2, 3, 4, 7, 13, 26, 32}) {
    CAPTURE(n);
    std::vector<uint16_t> memory(ViewWeightsSize(n));
    const starfocus::ViewWeights engine =
        MakeViewWeights(n, ApertureFallOff(kDefaultTheta), memory.data());
    double sum = 0, worst = 0;
    const auto exact = [&](int i, int j) {
      return analysis::Aperture(double(i * i + j * j) / (double(n) * n), kDefaultTheta);
    };
    for (int i = -n; i <= n; ++i) {
      for (int j = -n; j <= n; ++j) sum += exact(i, j);
    }
    const double one = std::ldexp(1.0, engine.sum_bits);
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; j <= i; ++j) {
        worst = std::max(worst, std::fabs(engine.Weight(i, j) - one * exact(i, j) / sum));
      }
    }
    CHECK_MESSAGE(worst < 4, "the weights differ from the aperture (3) by "
                                 << worst << " units of 2^-" << engine.sum_bits
                                 << ", which affects Figs. 4, 5, 6 and Table I");
  }
}

TEST_CASE("constants: the footprint of a view is its subaperture") {
  for (const int32_t width : {1, 13, 64, 128, 200, 256}) {
    double worst = 0;
    for (int32_t offset = -kShiftOne / 2; offset <= kShiftOne / 2; ++offset) {
      const double t = double(kShiftOne - std::abs(offset)) / kShiftOne;
      const double exact = Trapezoid(t, double(width) / kShiftOne);
      const double weight = SubapertureWeight(offset, width) / double(1 << simd::kBlendBits);
      worst = std::max(worst, std::fabs(weight - exact));
    }
    CHECK_MESSAGE(worst <= 1.0 / (1 << simd::kBlendBits),
                  "the footprint h differs from (6) for subapertures that are "
                      << width << "/256 pixels wide, which affects the rule "
                      << "for subapertures");
  }
}

TEST_CASE("constants: the layer filters have beta_D of Table I at r = 3 and the optimal beta_U") {
  const auto check = [](const simd::HalfBand& taps, double beta, double gain, const char* moves) {
    const Taps exact = HalfBand(beta);
    const double one = gain * (1 << simd::kTapBits);
    CHECK_MESSAGE(std::fabs(taps.near - one * exact(1)) < 1,
                  "tap 1 differs from the exact value of " << moves);
    CHECK_MESSAGE(std::fabs(taps.far - one * exact(3)) < 1,
                  "tap 3 differs from the exact value of " << moves);
    // Both phases of the filter must have a gain of 1. The middle tap therefore differs from the
    // exact value by G(-1), which is not exactly 0.
    CHECK_MESSAGE(std::fabs(taps.centre - one * exact(0)) < 1 + one * std::fabs(GainAtPi(exact)),
                  "tap 0 differs from the exact value of " << moves);
  };
  check(kDownFilter, OptimiseOnGrid(3).filters.beta_down, 1,
        "G_D, which affects Table I, Fig. 8, (12) and the PSFs of the layers");
  check(kUpFilter, std::round(100 * BetaWithoutPi()) / 100, 2,
        "G_U, which affects Table I, Fig. 8 and the PSFs of the layers");
  CHECK(2 * GainAtPi(HalfBand(kBetaUp)) == doctest::Approx(-2e-4).epsilon(0.02));
  CHECK_MESSAGE(kBetaDown == doctest::Approx(OptimiseOnGrid(3).filters.beta_down).epsilon(1e-9),
                "kBetaDown of examples/lab/analysis differs from beta_D of Table I");
}

TEST_CASE("constants: layers begin at the radii of equation (12), or at 7 and 24 by subapertures") {
  CHECK_MESSAGE(OptimiseOnGrid(2.5).error > kThreshold,
                "by Table I, layer 1 could begin at r = 2.5");
  CHECK_MESSAGE(OptimiseOnGrid(3).error < kThreshold, "by Table I, layer 1 must begin above r = 3");
  const auto check = [](const char* rule, int layer, double first, const auto& layer_of) {
    CAPTURES(rule, layer);
    CHECK_MESSAGE(layer_of(first) == layer, "the layer begins above " << first);
    CHECK_MESSAGE(layer_of(std::nextafter(first, 0.0)) == layer - 1,
                  "the layer begins below " << first);
  };
  for (const int layer : {1, 2}) {
    check("LayerByPaper", layer, layer == 1 ? 3 : 6, [](double r) { return LayerByPaper(r); });
    check("LayerBySubaperture", layer, layer == 1 ? 7 : 24,
          [](double r) { return LayerBySubaperture(r, false); });
  }
}

TEST_CASE("constants: layers have the error of equation (10) and the aliasing of equation (11)") {
  for (const double r : {3.0, 4.5, 7.0}) {
    const SampledPsf half = IdealPsf(r / 2, kDefaultTheta);
    const Filters filters = {kBetaDown, kDefaultTheta};
    CHECK(SquaredError(ThroughLayer(half, kBetaDown), SubsampledPsf(r, filters, Alias::kNone)) <
          1e-20);
    CHECK(LayerAliasing(half, 1, kBetaDown) ==
          doctest::Approx(AliasingError(r, filters)).epsilon(1e-9));
    CHECK(MakeLayerTheory(r, 1).error == doctest::Approx(SubsampledError(r, filters)));
  }
  CHECK(std::fabs(LayerAliasing(IdealPsf(2, kDefaultTheta), 0, kBetaDown)) < 1e-15);
}

// Compares the engine with the analysis at positive and negative radii. `least` is the smallest
// radius at which the rule selects the layer.
void CheckEngine(starfocus_renderer renderer, int layer, int least, int most) {
  for (int k = 8 * least; k <= 8 * most; k = k < 64 ? k + 1 : k + 13) {
    for (const int sign : {1, -1}) {
      const double r = sign * k / 8.0;
      CAPTURES(r, renderer, layer);
      EngineStep step;
      REQUIRE(MeasureStep({r, std::fabs(r), STARFOCUS_MODE_BLOCK, renderer, layer}, &step) ==
              STARFOCUS_OK);
      CHECK(step.layer == layer);
      CHECK_MESSAGE(step.apart <= kExplained[layer],
                    "N = " << step.n << ": the impulse response differs from StarPsf; `starfocus "
                           << "analyze` shows the affected radii");
      CHECK(Explain(step).find("unexplained") == std::string::npos);
      if (layer > 0) {
        const LayerTheory theory = MakeLayerTheory(r < 0 ? -r : r, layer);
        // For small radii, (9) selects N = 2 or N = 3. With N = 2 or N = 3, the PSF differs from
        // the ideal PSF, and the aliasing of both PSFs therefore differs as well.
        CHECK(std::fabs(step.aliasing - theory.aliasing) <
              (renderer == STARFOCUS_RENDERER_LINE_SCAN ? 2e-4 : 1e-4));
      }
      if (renderer == STARFOCUS_RENDERER_SLICES) {
        // Below 2 pixels, the PSF is narrower than (4), because pixels are integrals already.
        CHECK_MESSAGE(step.engine <= (k < 16 ? 8e-3 : kThreshold),
                      "the error exceeds the threshold: " << Explain(step));
      } else {
        // If equation (9) selects N, the error is largest at r = 1/2. Views at the rim then shift a
        // point by half a pixel, although the ideal PSF does not reach the adjacent pixels.
        CHECK(step.engine < (k <= 8 ? 8e-2 : k <= 24 ? 6e-3 : k <= 64 ? 2e-3 : 1e-3));
      }
    }
  }
}

TEST_CASE("constants: the PSF of the running engine equals the prediction of the analysis") {
  constexpr int kMost = 40;
  for (const starfocus_renderer renderer :
       {STARFOCUS_RENDERER_LINE_SCAN, STARFOCUS_RENDERER_SLICES}) {
    CheckEngine(renderer, 0, 0, kMost);
    CheckEngine(renderer, 1, renderer == STARFOCUS_RENDERER_LINE_SCAN ? 3 : 7, kMost);
    CheckEngine(renderer, 2, renderer == STARFOCUS_RENDERER_LINE_SCAN ? 6 : 24, kMost);
  }
}

TEST_CASE(
    "constants: for N = 3 to 7, subapertures meet the error threshold at every radius up to "
    "r_max") {
  for (const double r_max : {5.5, 11.0, 25.0, 34.0, 40.0}) {
    const int n = ViewsBySubaperture(r_max);
    double worst = 0, worst_r = 0;
    for (double r = 0.5 + 1.0 / 64; r <= r_max; r += 1.0 / 16) {
      // Below 2 pixels, StarPsf is narrower than (4), because pixels are integrals already.
      const SampledPsf psf = r < 2 ? SubaperturePsf(r, n, kDefaultTheta)
                                   : StarPsf(r, n, kDefaultTheta, Subapertures::kWide);
      const double error = SquaredError(psf, IdealPsf(r, kDefaultTheta));
      if (error > worst) worst = error, worst_r = r;
    }
    CHECK_MESSAGE(worst <= kThreshold,
                  "the PSF for N = " << n << " by the rule for subapertures differs from (4) by "
                                     << worst << " at r = " << worst_r);
  }
}

// Returns the largest error of a lens of the given width for N = 3, over closely spaced radii from
// `first`.
double WorstOfThree(int lens, double first) {
  const SubapertureLights lights = SubapertureLights::OfLens(lens, kDefaultTheta);
  double worst = 0;
  for (double r = first; r <= 5.5; r += 1.0 / 32) {
    worst = std::max(worst, SquaredError(SubaperturePsf(r, lights), IdealPsf(r, kDefaultTheta)));
  }
  return worst;
}

TEST_CASE("constants: no other width of the lens has a smaller error for N = 3") {
  // kFirst is the smallest tested radius above half a pixel, since smaller blurs use the centre
  // view alone. Lenses are compared at radii of at least kWider.
  constexpr double kFirst = 0.5 + 1.0 / 64, kWider = 0.625;
  const int own = LensInSubapertures(3);
  CHECK(WorstOfThree(own, kFirst) < kThreshold);
  for (int lens = 3 * kSubapertureUnits - 11; lens <= 3 * kSubapertureUnits; ++lens) {
    CAPTURE(lens);
    if (WorstOfThree(lens, kFirst) >= kThreshold) continue;
    CHECK(SubapertureLights::OfLens(lens, kDefaultTheta).views() == 29);
    CHECK_MESSAGE(WorstOfThree(lens, kWider) >= WorstOfThree(own, kWider),
                  "another lens with 29 views has a smaller error than that of N = 3");
  }
}

TEST_CASE("constants: the widths of the lens for N = 4, 5 and above meet their error criteria") {
  const auto worst = [](int lens, double r_max) { return WorstOfLens(lens, r_max, kDefaultTheta); };
  const auto views = [](int lens) {
    return SubapertureLights::OfLens(lens, kDefaultTheta).views();
  };
  // N = 5: the lens has the smallest maximal error of all lenses with 69 views.
  const double chosen = worst(LensInSubapertures(5), 25);
  CHECK(views(LensInSubapertures(5)) == 69);
  for (int lens = 5 * kSubapertureUnits - 24; lens <= 5 * kSubapertureUnits; ++lens) {
    if (views(lens) != 69) continue;
    CHECK_MESSAGE(worst(lens, 25) >= chosen,
                  "N = 5: a lens of " << lens << " / 32 subapertures has a smaller error");
  }
  // N = 4: every lens with at most 49 views has more than half of the chosen lens's maximal error.
  CHECK(views(LensInSubapertures(4)) == 49);
  for (int lens = 4 * kSubapertureUnits - 24; lens <= 4 * kSubapertureUnits; ++lens) {
    if (views(lens) > 49) continue;
    CHECK_MESSAGE(worst(lens, 11) > worst(LensInSubapertures(4), 11) / 2,
                  "N = 4: a lens of " << lens << " / 32 subapertures has at most half the error");
  }
  // Tests N = 4 to 7, each at the largest r_max for which the rule selects this N.
  for (const double r_max : {11.0, 25.0, 34.0, 49.0}) {
    const int n = ViewsBySubaperture(r_max);
    CAPTURE(n);
    CHECK_MESSAGE(worst(LensInSubapertures(n), r_max) < kThreshold / 4,
                  "LensInSubapertures: the largest error exceeds a quarter of the threshold");
  }
}

// Weights of the PSFs of equation (4) that blur pixels of the centre view without rendering views.
// Up to the blur radius kMaxGather, the blur mode uses the same weights as block mode.
struct GatherPsfs {
  std::vector<uint16_t> weights = std::vector<uint16_t>(BlurWeightCount(false, kMaxGather));
  std::vector<Psf> psfs = std::vector<Psf>(static_cast<size_t>(PsfCount(kMaxGather)));

  GatherPsfs() {
    MakePsfs(0, PsfCount(kMaxGather), ApertureFallOff(kDefaultTheta), nullptr, weights.data(),
             psfs.data());
  }
  // Returns the PSF of a radius with kDisparityBits fractional bits.
  const Psf& Of(int32_t r) const { return psfs[static_cast<size_t>(PsfIndex(r))]; }
};

// Returns the PSF of exactly radius r > 0 for pixels that are integrals already. Its variance
// exceeds the variance of the blur by a quarter, or by 1/24 of a pixel (lib/optics/psf.cc).
SampledPsf PsfOfPixels(double r) {
  const double mean_square = double(MeanSquare(ApertureFallOff(kDefaultTheta))) / kOpeningOne;
  const double variance = r * r * mean_square;
  if (variance >= 0.5) return IdealPsf(std::sqrt(r * r - 1 / (24 * mean_square)), kDefaultTheta);
  SampledPsf psf = IdealPsf(std::max(r, 0.8), kDefaultTheta);
  double integrals = 0;
  for (int n = -psf.radius(); n <= psf.radius(); ++n) {
    for (int m = -psf.radius(); m <= psf.radius(); ++m) integrals += psf.at(n, m) * n * n;
  }
  const double share = std::min(1.0, (variance + std::min(variance / 4, 1.0 / 24)) / integrals);
  psf.Scale(share);
  psf.at(0, 0) += 1 - share;
  return psf;
}

TEST_CASE(
    "constants: the gathering PSF with the nearest radius differs little from the exact PSF") {
  const GatherPsfs made;
  double near_focus = 0, fine = 0, coarse = 0;
  for (int32_t r = 1; r <= kMaxGather << kDisparityBits; ++r) {
    const Psf& psf = made.Of(r);
    SampledPsf engine(psf.size);
    for (int n = -psf.size; n <= psf.size; ++n) {
      for (int m = -psf.size; m <= psf.size; ++m) {
        engine.at(n, m) = std::ldexp(psf.Weight(n, m), -psf.sum_bits);
      }
    }
    const double radius = double(r) / (1 << kDisparityBits);
    const double error = SquaredError(engine, PsfOfPixels(radius));
    double& worst = radius < 1 ? near_focus : radius < 4 ? fine : coarse;
    worst = std::max(worst, error);
  }
  CHECK_MESSAGE(near_focus < 7.5e-3,
                "kFineSteps: below a radius of 1 pixel, the PSF differs from the exact PSF by "
                    << near_focus);
  CHECK_MESSAGE(
      fine < 2.2e-3,
      "kFineSteps: at radii from 1 to 4 pixels, the PSF differs from the exact PSF by " << fine);
  CHECK_MESSAGE(
      coarse < 1.7e-5,
      "kCoarseSteps: at radii from 4 pixels, the PSF differs from the exact PSF by " << coarse);
}

TEST_CASE("constants: PredictGather counts at least as many taps as the PSF has") {
  constexpr int32_t kOne = 1 << kDisparityBits;
  // PredictGather must not count fewer taps than a PSF has. Except for the smallest PSFs,
  // PredictGather may count at most 50 % too many taps. PredictGather adds the time of 16 taps to
  // each pixel. With timing.upsample = 64, the unit of PredictGather's result is the time of one
  // tap.
  starfocus_timing timing = {};
  timing.upsample = 64;
  const GatherPsfs made;
  for (int32_t r = kOne; r <= kMaxGather * kOne; r += kOne / 4) {
    const Psf& psf = made.Of(r);
    const auto counted = static_cast<int32_t>(PredictGather(timing, 1, r)) - 16;
    int32_t taps = 0;
    for (int32_t n = 0; n <= psf.size; ++n) {
      for (int32_t m = 0; m <= psf.size; ++m) taps += psf.Weight(n, m) != 0 ? 1 : 0;
    }
    CHECK_MESSAGE(counted >= taps, "PredictGather: radius " << r << " / 64 has " << taps);
    CHECK_MESSAGE(counted <= taps + taps / 2 + 6,
                  "PredictGather: radius " << r << " / 64 has " << taps);
  }
}

TEST_CASE("constants: with one N per picture, the PSF equals the prediction of the analysis") {
  const auto check = [](starfocus_renderer renderer, int n) {
    for (const double r : {0.0, 0.5, 3.25, 11.0, 24.5}) {
      EngineStep step;
      REQUIRE(MeasureStep({r, 40, STARFOCUS_MODE_FRAME, renderer, 0}, &step) == STARFOCUS_OK);
      CHECK(step.n == n);
      CHECK(step.apart <= kExplained[0]);
    }
  };
  check(STARFOCUS_RENDERER_LINE_SCAN, ViewsByPaper(40));
  check(STARFOCUS_RENDERER_SLICES, ViewsBySubaperture(40));
}

}  // namespace
}  // namespace starfocus::engine_constants_slow_test
