// SPDX-License-Identifier: Apache-2.0
// Computes Table I: the filters of subsampled refocusing, and the threshold of (12).
#include <cmath>
#include <cstdio>

#include "examples/lab/analysis/aperture.h"
#include "examples/lab/analysis/half_band.h"
#include "examples/lab/analysis/selection.h"
#include "examples/lab/analysis/subsampled.h"
#include "examples/lab/analyze/figures.h"

namespace starfocus {
namespace {

using analysis::kPi;

struct PaperRow {
  double r, beta_down, theta;  // theta in units of pi
  double error, aliasing;
};
constexpr PaperRow kPaper[] = {{2.0, 0.00, 0.19, 4.3e-3, 1.4e-3},
                               {2.5, 0.61, 0.26, 1.6e-3, 7.4e-4},
                               {3.0, 1.28, 0.26, 6.7e-4, 1.4e-4},
                               {3.5, 1.44, 0.27, 3.0e-4, 5.3e-5},
                               {4.0, 1.49, 0.28, 1.3e-4, 3.0e-5}};

// Returns true if `value`, rounded to two significant digits, equals `printed`, the number in the
// paper's table.
bool SameDigits(double value, double printed) {
  char a[20], b[20];
  std::snprintf(a, sizeof(a), "%.1e", value);
  std::snprintf(b, sizeof(b), "%.1e", printed);
  return std::string(a) == b;
}

bool Agrees(const analysis::Optimum& found, const PaperRow& paper) {
  return std::fabs(found.filters.beta_down - paper.beta_down) < 0.005 &&
         std::fabs(found.filters.theta / kPi - paper.theta) < 0.005 &&
         SameDigits(found.error, paper.error) && SameDigits(found.aliasing, paper.aliasing);
}

}  // namespace

Figure AnalyseTableOne() {
  Figure figure;
  Table table("table1", {"r", "beta_down", "theta_pi", "sse_down2", "sse_alias", "paper_beta_down",
                         "paper_theta_pi", "paper_sse_down2", "paper_sse_alias", "free_beta_down",
                         "free_theta_pi", "free_sse_down2", "free_sse_alias"});
  std::printf(
      "Table I: filters of least SSE_down2 per r, beta_D in steps of 0.01, theta of 0.01 pi\n"
      "    r  beta_D  theta/pi  SSE_down2      SSE_a  paper   unrestricted:  beta_D theta/pi "
      "SSE_down2\n");
  for (const PaperRow& paper : kPaper) {
    const analysis::Optimum found = analysis::OptimiseOnGrid(paper.r);
    const analysis::Optimum free = analysis::Optimise(paper.r);
    std::printf("  %3.1f  %6.2f  %8.2f  %9.2e  %9.2e  %-7s %21.3f %8.4f %9.3e\n", paper.r,
                found.filters.beta_down, found.filters.theta / kPi, found.error, found.aliasing,
                Agrees(found, paper) ? "agrees" : "DIFFERS", free.filters.beta_down,
                free.filters.theta / kPi, free.error);
    table.Row().Add(paper.r);
    table.Add(found.filters.beta_down).Add(found.filters.theta / kPi);
    table.Add(found.error).Add(found.aliasing);
    table.Add(paper.beta_down).Add(paper.theta).Add(paper.error).Add(paper.aliasing);
    table.Add(free.filters.beta_down).Add(free.filters.theta / kPi);
    table.Add(free.error).Add(free.aliasing);
  }
  figure.tables.push_back(table);
  std::printf("  beta_U: 2.17 gives G_U(-1) = %.1e; it is 0 at %.4f\n",
              2 * analysis::GainAtPi(analysis::HalfBand(analysis::kBetaUp)),
              analysis::BetaWithoutPi());
  std::printf("  (12): SSE_down2 falls to 1e-3 at r = %.2f; the next row of Table I is r = 3\n\n",
              analysis::SmallestSubsampledRadius(analysis::kThreshold));
  return figure;
}

}  // namespace starfocus
