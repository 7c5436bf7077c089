// SPDX-License-Identifier: Apache-2.0
// Computes Figs. 4, 5 and 8: 1D PSFs and their frequency responses.
#include <cmath>

#include "examples/lab/analysis/aperture.h"
#include "examples/lab/analysis/half_band.h"
#include "examples/lab/analysis/ideal.h"
#include "examples/lab/analysis/spectrum.h"
#include "examples/lab/analysis/subsampled.h"
#include "examples/lab/analysis/view_psf.h"
#include "examples/lab/analyze/figures.h"

namespace starfocus {
namespace {

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

}  // namespace starfocus
