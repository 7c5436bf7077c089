// The engine's constants against the analysis they come from. A failure names the figure of the
// paper that moves: then the analysis, the figure and the documents change together, or the
// constant is wrong.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "lib/analysis/aperture.h"
#include "lib/analysis/engine_steps.h"
#include "lib/analysis/search.h"
#include "lib/analysis/selection.h"
#include "lib/analysis/subsampled.h"
#include "lib/analysis/view_kernel.h"
#include "lib/aperture.h"
#include "lib/fixed.h"
#include "lib/line_scan.h"
#include "lib/rules.h"
#include "starfocus/starfocus.h"

namespace starfocus {
namespace {

using namespace analysis;

TEST_CASE("constants: theta is Table I's at r = 3") {
  sf_config config;
  sf_config_init(&config);
  const double table = OptimiseOnGrid(3).filters.theta;
  CHECK_MESSAGE(config.theta == doctest::Approx(table).epsilon(1e-12),
                "the default of sf_config.theta is " << config.theta / kPi << " pi, Table I has "
                                                     << table / kPi
                                                     << " pi: all figures and rules move");
  CHECK_MESSAGE(config.theta == doctest::Approx(kDefaultTheta).epsilon(1e-12),
                "lib/analysis draws its figures with another theta than the engine's default");
}

TEST_CASE("constants: the views of (9)") {
  // Largest r that gets N = 4, and the slope beyond.
  const auto jump = [](int n) {
    return Cross(0.1, 128, 1e-9, [&](double r) { return ViewsByPaper(r) - n - 0.5; });
  };
  CHECK_MESSAGE(4 / jump(4) == doctest::Approx(0.787).epsilon(1e-6),
                "the under-sampling ratio of Fig. 6 and (9) moves");
  CHECK_MESSAGE(80 / jump(80) == doctest::Approx(0.787).epsilon(1e-6),
                "the under-sampling ratio of Fig. 6 and (9) moves");
  for (int n = 1; n <= 3; ++n) {
    CHECK_MESSAGE(jump(n) == doctest::Approx(n).epsilon(1e-6), "(9) below r = 4 moves");
  }
  for (int n = 4; n <= 32; ++n) {
    const double r = jump(n) - 1e-6, over = WorstOverSampling(n, kDefaultTheta).error;
    CHECK_MESSAGE(PaperError(r, n, kDefaultTheta) <= over,
                  "Fig. 6: N = " << n << " is given out up to r = " << r
                                 << ", where its error exceeds the worst of over-sampling");
  }
  for (const double r : {0.3, 1.0, 2.5, 7.0, 40.0}) {
    CHECK_MESSAGE(ViewsOfBenchmark(r) == 2 * static_cast<int>(std::ceil(r)),
                  "the benchmark's N moves: every PSNR of the paper's section VI");
  }
}

TEST_CASE("constants: aperture weights are a_{d,N} of (5)") {
  for (const int n : {1, 2, 3, 4, 7, 13, 26, 32}) {
    CAPTURE(n);
    std::vector<uint16_t> memory(ApertureSize(n));
    const starfocus::Aperture engine =
        MakeAperture(n, ApertureFallOff(kDefaultTheta), memory.data());
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
    CHECK_MESSAGE(worst < 4, "the aperture (3) moves by " << worst << " units of 2^-"
                                                          << engine.sum_bits
                                                          << ": Figs. 4, 5, 6 and Table I");
  }
}

TEST_CASE("constants: the footprint of a view is its aperture cell") {
  for (const int32_t cell : {1, 13, 64, 128, 200, 256}) {
    double worst = 0;
    for (int32_t offset = -kShiftOne / 2; offset <= kShiftOne / 2; ++offset) {
      const double t = double(kShiftOne - std::abs(offset)) / kShiftOne;
      const double exact = Trapezoid(t, double(cell) / kShiftOne);
      worst = std::max(worst, std::fabs(CellWeight(offset, cell) / double(kShiftOne) - exact));
    }
    CHECK_MESSAGE(worst <= 0.5 / kShiftOne + 1e-12,
                  "h of (6) moves for cells " << cell << "/256 px wide: the aperture cells' table "
                                              << "and rule");
  }
}

TEST_CASE("constants: the running engine has the kernel it is described by") {
  for (int k = 0; k <= (STARFOCUS_EMULATED ? 160 : 320); k = k < 64 ? k + 1 : k + 13) {
    for (const int sign : {1, -1}) {
      const double r = sign * k / 8.0;
      CAPTURE(r);
      EngineStep step;
      REQUIRE(MeasureStep({r, std::fabs(r)}, &step) == SF_OK);
      CHECK_MESSAGE(step.apart <= kExplained,
                    "N = " << step.n << ": the impulse response is not StarKernel's; `starfocus "
                           << "analyze` shows which radii move");
      CHECK(Explain(step).find("unexplained") == std::string::npos);
      // With N from (9) the worst is the half-covered neighbour at r = 1/2.
      CHECK(step.engine < (k <= 8 ? 7e-2 : k <= 24 ? 6e-3 : k <= 64 ? 2e-3 : 1e-3));
    }
  }
}

}  // namespace
}  // namespace starfocus
