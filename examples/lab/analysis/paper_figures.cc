// SPDX-License-Identifier: Apache-2.0
// Computes the paper's figures: frequency responses of 1D PSFs (Figs. 5 and 8), Table I, and the
// number of views (Fig. 6).

#include <cmath>
#include <cstdio>

#include "examples/lab/analysis/figures.h"
#include "examples/lab/analysis/ideal.h"
#include "examples/lab/analysis/subaperture_rule.h"
#include "examples/lab/analysis/subsampled.h"
#include "examples/lab/analysis/view_psf.h"

namespace starfocus::analysis {

// Returns B(e^{j omega}) of a symmetric PSF, which is real.
inline double Response(const Taps& psf, double omega) {
  double sum = psf(0);
  for (int n = 1; n <= psf.radius(); ++n) sum += 2 * psf(n) * std::cos(n * omega);
  return sum;
}

// Returns H(f) = sinc^2(f) of the triangular h.
inline double TriangleResponse(double f) {
  if (f == 0) return 1;
  const double sinc = std::sin(kPi * f) / (kPi * f);
  return sinc * sinc;
}

}  // namespace starfocus::analysis

namespace starfocus {
namespace {

// Computes Figs. 4, 5 and 8: 1D PSFs and their frequency responses.

using namespace analysis;

constexpr double kRadius = 4;  // blur radius r of the paper's Figs. 4 and 5

// Returns b_vi,c(x) of (6).
double Continuous(const Taps& samples, double x) {
  double sum = 0;
  for (int i = -samples.radius(); i <= samples.radius(); ++i) {
    sum += samples(i) * Trapezoid(x - i * kRadius / samples.radius(), 1);
  }
  return sum;
}

// Returns A_vi(f), the spectrum of the views, which repeats every N / r.
double ViewResponse(const Taps& samples, double f) {
  return Response(samples, 2 * kPi * f * kRadius / samples.radius());
}

double Peak(const Taps& psf) {
  double peak = 0;
  for (int n = -psf.radius(); n <= psf.radius(); ++n) peak = std::fmax(peak, psf(n));
  return peak;
}

}  // namespace

Figure DrawViewPsfs() {
  constexpr int kViews[] = {3, 4, 6, 16};
  Table taps("fig4", {"n", "ideal", "N3", "N4", "N6", "N16"});
  Table curves("fig4_curves", {"x", "N3", "N4", "N6", "N16"});
  const Taps ideal = IdealPsf1(kRadius, kDefaultTheta);
  for (int n = -6; n <= 6; ++n) {
    taps.Row().Add(n).Add(ideal(n) / Peak(ideal));
    for (const int views : kViews) {
      const Taps psf = PaperPsf1(kRadius, views, kDefaultTheta);
      taps.Add(psf(n) / Peak(psf));
    }
  }
  for (int k = -240; k <= 240; ++k) {
    curves.Row().Add(k / 40.0);
    for (const int views : kViews) {
      const double peak = Peak(PaperPsf1(kRadius, views, kDefaultTheta));
      curves.Add(Continuous(SampledAperture1(views, kDefaultTheta), k / 40.0) / peak);
    }
  }
  Figure figure = {"fig4", 900, 620, {taps, curves}, ""};
  figure.commands =
      "set multiplot layout 2,2 title 'Fig. 4: view-interpolation PSFs, r = 4, 1D, equal "
      "height'\nset xrange [-6:6]\nset yrange [0:1.5]\nset xtics 2\n"
      "do for [i=1:4] {\nset title sprintf('N = %s', word('3 4 6 16', i))\n"
      "plot $fig4 using 1:2 with boxes lc rgb '#c8d8e8' fs solid 1 title 'b[n] ideal', "
      "$fig4_curves using 1:(column(i + 1)) with lines lt 6 lw 1 title 'b_vi,c(x)', "
      "$fig4 using 1:(column(i + 2)) with impulses lt 2 lw 2, "
      "$fig4 using 1:(column(i + 2)) with points pt 7 ps 0.7 lt 2 title 'b_vi[n]'\n}\n"
      "unset multiplot\n";
  return figure;
}

Figure DrawViewResponses() {
  Table continuous("fig5a", {"f", "H", "A_N3", "B_N3", "A_N6", "B_N6"});
  Table discrete("fig5b", {"omega_pi", "ideal", "N3", "N6"});
  const Taps three = SampledAperture1(3, kDefaultTheta), six = SampledAperture1(6, kDefaultTheta);
  for (int k = 0; k <= 500; ++k) {
    const double f = k / 200.0, h = TriangleResponse(f);
    const double a3 = std::fabs(ViewResponse(three, f)), a6 = std::fabs(ViewResponse(six, f));
    continuous.Row().Add(f).Add(h).Add(a3).Add(h * a3).Add(a6).Add(h * a6);
  }
  const Taps ideal = IdealPsf1(kRadius, kDefaultTheta);
  const Taps b3 = PaperPsf1(kRadius, 3, kDefaultTheta), b6 = PaperPsf1(kRadius, 6, kDefaultTheta);
  for (int k = 0; k <= 400; ++k) {
    const double omega = k * kPi / 400;
    discrete.Row().Add(k / 400.0).Add(std::fabs(Response(ideal, omega)));
    discrete.Add(std::fabs(Response(b3, omega))).Add(std::fabs(Response(b6, omega)));
  }
  Figure figure = {"fig5", 900, 760, {continuous, discrete}, ""};
  figure.commands =
      "set multiplot layout 3,1 title 'Fig. 5: responses of view interpolation, r = 4, 1D'\n"
      "set yrange [0:1.05]\nset xrange [0:2.5]\nset xlabel 'f'\nset key outside right\n"
      "do for [i=0:1] {\n"
      "set title sprintf('(a) before sampling, N = %d', 3 + 3 * i)\n"
      "plot $fig5a using 1:2 with lines lt 6 lw 2 dt 2 title '|H|', "
      "'' using 1:(column(3 + 2 * i)) with lines lt 1 lw 1 title '|A_vi|', "
      "'' using 1:(column(4 + 2 * i)) with filledcurves y1=0 lc rgb '#d9541e' fs solid 0.6 "
      "title '|B_vi,c|'\n}\n"
      "set title '(b) after sampling'\nset xrange [0:1]\nset xlabel 'ω / π'\n"
      "plot $fig5b using 1:2 with lines lt 6 title 'ideal', '' using 1:3 with lines lt 1 "
      "title 'N = 3', '' using 1:4 with lines lt 2 title 'N = 6'\nunset multiplot\n";
  return figure;
}

Figure DrawSubsampledBlurs() {
  constexpr double kRadii[] = {2, 3, 4};
  constexpr Filters kFilters = {kBetaDown, kDefaultTheta};
  std::vector<std::string> columns = {"omega_pi"};
  for (const char* r : {"r2", "r3", "r4"}) {
    for (const char* part : {"_ideal", "_half", "_down2", "_alias"}) {
      columns.push_back(std::string(r) + part);
    }
  }
  Table table("fig8", columns);
  for (int k = 0; k <= 400; ++k) {
    const double omega = k * kPi / 400;
    table.Row().Add(k / 400.0);
    for (const double r : kRadii) {
      table.Add(std::fabs(Response(IdealPsf1(r, kDefaultTheta), omega)));
      table.Add(std::fabs(Response(IdealPsf1(r / 2, kDefaultTheta), 2 * omega)));
      for (const bool alias : {false, true}) {
        table.Add(std::fabs(Response(SubsampledPsf1(r, kFilters, alias), omega)));
      }
    }
  }
  Figure figure = {"fig8", 900, 760, {table}, ""};
  figure.commands =
      "set multiplot layout 3,1 title 'Fig. 8: subsampled-by-two blurs, 1D, β_D = 1.28, θ = "
      "0.26 π'\nset yrange [0:1.05]\nset xrange [0:1]\nset xlabel 'ω / π'\nset key outside right\n"
      "do for [i=0:2] {\nset title sprintf('r = %d', i + 2)\n"
      "plot $fig8 using 1:(column(2 + 4 * i)) with lines lt 6 title '|B(z; r)| ideal', "
      "'' using 1:(column(3 + 4 * i)) with lines lt 5 lw 2 dt 2 title '|B(z²; r/2)|', "
      "'' using 1:(column(4 + 4 * i)) with lines lt 1 title '|B↓2|', "
      "'' using 1:(column(5 + 4 * i)) with lines lt 2 title '|E|'\n}\nunset multiplot\n";
  return figure;
}

namespace {

// Computes Table I: the filters of subsampled refocusing, and the threshold of (12).

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

namespace {

// Computes Fig. 6, SSE as a function of N / r, and the thresholds of (9).

using namespace analysis;

constexpr int kLeast = 2, kMost = 16;

Table Curves() {
  std::vector<std::string> columns = {"ratio"};
  for (int n = kLeast; n <= kMost; ++n) columns.push_back("N" + std::to_string(n));
  Table table("fig6", columns);
  for (int k = 120; k <= 500; ++k) {  // N / r from 0.6 to 2.5
    const double ratio = k / 200.0;
    table.Row().Add(ratio);
    for (int n = kLeast; n <= kMost; ++n) table.Add(PaperError(n / ratio, n, kDefaultTheta));
  }
  return table;
}

Table Points() {
  Table table("fig6_points", {"N", "over_ratio", "sse", "under_ratio"});
  std::printf(
      "Fig. 6: worst over-sampling error of N views, and under-sampling of the same error\n"
      "   N   N/r       SSE   N/r\n");
  for (int n = kLeast; n <= kMost; ++n) {
    const RatioPoint over = WorstOverSampling(n, kDefaultTheta);
    const double under = UnderSamplingRatio(n, kDefaultTheta, over.error);
    std::printf("  %2d  %.3f  %8.2e  %.3f\n", n, over.ratio, over.error, under);
    table.Row().Add(n).Add(over.ratio).Add(over.error).Add(under);
  }
  return table;
}

// Compares the paper's threshold 0.787 with the exact threshold.
void PrintThreshold() {
  constexpr double kPaperRatio = 0.787, kBeside = 1.51;
  const RatioPoint over = WorstOverSampling(4, kDefaultTheta);
  const double at = PaperError(4 / kPaperRatio, 4, kDefaultTheta);
  std::printf("  (9): at N = 4 and N/r = 0.787 the SSE is %.2e, %s %.2e of over-sampling\n", at,
              at <= over.error ? "within the" : "MORE than the", over.error);
  const RatioPoint no_rim = WorstOverSampling(4, kDefaultTheta, Rim::kExcluded);
  const double beside = PaperError(4 / kBeside, 4, kDefaultTheta, Rim::kExcluded);
  std::printf(
      "  By (3)-(8) as written, the point of equal SSE is N/r = %.3f, not 0.787. The curve has a\n"
      "  cusp at N/r = 1.5. The cause of the difference from the paper is unknown. One of the\n"
      "  variants tried gives 0.787: without views on the rim of the aperture, the point of equal\n"
      "  SSE is %.3f, or %.3f if the curve is read next to the cusp, at 1.51 (SSE %.1e).\n"
      "  The threshold 0.787 is safe in all of these cases.\n\n",
      UnderSamplingRatio(4, kDefaultTheta, over.error),
      UnderSamplingRatio(4, kDefaultTheta, no_rim.error, Rim::kExcluded),
      UnderSamplingRatio(4, kDefaultTheta, beside, Rim::kExcluded), beside);
}

}  // namespace

Figure AnalyseViewNumber() {
  Figure figure;
  figure.name = "fig6";
  figure.width = 860, figure.height = 520;
  figure.tables = {Curves(), Points()};
  PrintThreshold();
  figure.commands =
      "set title 'Fig. 6: error of N views along the aperture radius'\n"
      "set logscale y\nset format y '%.0e'\nset xlabel 'N / r'\nset ylabel 'SSE (8)'\n"
      "set xrange [0.6:2.2]\nset yrange [1e-6:1e-2]\nset key outside right\n"
      "set arrow from 0.787, graph 0 to 0.787, graph 1 nohead dt 2 lc rgb '#888888'\n"
      "set label '0.787' at 0.795, 2e-6 tc rgb '#666666'\n"
      "set arrow from 0.6, 1e-3 to 2.2, 1e-3 nohead dt 2 lc rgb '#888888'\n"
      "set palette defined (0 '#d9541e', 1 '#b8860b', 2 '#2a9d4a', 3 '#1f6fb4', 4 '#5a3f90')\n"
      "set cbrange [2:16]\nunset colorbox\n"
      "plot for [i=2:16] $fig6 using 1:(column(i)) with lines lw 1.5 lc palette cb i "
      "title sprintf('N = %d', i), "
      "$fig6_points using 2:3 with points pt 6 ps 1 lc rgb '#222222' title 'worst over', "
      "$fig6_points using 4:3 with points pt 8 ps 1 lc rgb '#222222' title 'same under'\n";
  return figure;
}

}  // namespace starfocus
