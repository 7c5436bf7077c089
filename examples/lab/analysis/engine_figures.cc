// SPDX-License-Identifier: Apache-2.0
// Computes the figures of the engine: its PSFs, and the number of subapertures.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "examples/lab/analysis/engine_psf.h"
#include "examples/lab/analysis/figures.h"
#include "examples/lab/analysis/ideal.h"
#include "examples/lab/analysis/subaperture_rule.h"
#include "lib/optics/rules.h"
#include "platform/file.h"
#include "platform/progress.h"
#include "starfocus/experimental.h"

namespace starfocus {
namespace {

using namespace analysis;

// A series of measurements at increasing r.
struct Series {
  starfocus_mode mode;
  starfocus_renderer renderer;
  int layer;
  double r_max;      // r_max of the picture; 0 makes r_max equal to r.
  double increment;  // Increment of r between measurements.
  int largest;       // Largest r that is measured.
};

const char* NameOf(starfocus_renderer renderer) {
  return renderer == STARFOCUS_RENDERER_LINE_SCAN ? "line-scan" : "slices";
}

// A range of consecutive values of r whose errors have the same explanation.
struct Stretch {
  double first, last, worst, worst_r;
  std::string reason;
};

void Extend(const EngineStep& step, const std::string& reason, bool joined,
            std::vector<Stretch>* stretches) {
  const double r = std::fabs(step.r);
  if (joined && !stretches->empty() && stretches->back().reason == reason) {
    Stretch& stretch = stretches->back();
    stretch.last = r;
    if (step.engine > stretch.worst) stretch.worst = step.engine, stretch.worst_r = r;
  } else {
    stretches->push_back({r, r, step.engine, r, reason});
  }
}

// Returns the smallest blur radius, a multiple of 0.5, at which the renderer uses the layer. The
// layers of the line scan follow the paper's rule (12). The layers of the slice renderer follow
// LayerBySubaperture for blocks without depth edges.
double LeastRadius(starfocus_renderer renderer, int layer) {
  const auto layer_at = [&](double r) {
    return renderer == STARFOCUS_RENDERER_LINE_SCAN ? LayerByPaper(r)
                                                    : LayerBySubaperture(r, false);
  };
  double least = 0;
  while (layer_at(least) < layer) least += 0.5;
  return least;
}

// Measures one series of values of r with the given sign, starting at the smallest |r| of the
// series' layer.
Error Measure(const Series& series, int sign, Table* table, Table* layers) {
  const double least = LeastRadius(series.renderer, series.layer);
  if (least > series.largest) return {};
  const int count = static_cast<int>((series.largest - least) / series.increment);
  std::printf("  layer %d, renderer %s, r = %g to %d%s\n", series.layer, NameOf(series.renderer),
              least == 0 ? 0 : sign * least, sign * series.largest,
              series.r_max > 0 ? " in a picture with this r_max" : "");
  Progress progress("measuring PSFs", count);
  std::vector<Stretch> stretches;
  double apart = 0, aliasing = 0, aliasing_r = 0;
  bool joined = false;
  for (int k = 0; k <= count; ++k) {
    const double r = least + k * series.increment;
    const EngineProbe probe = {sign * r, std::max(r, series.r_max), series.mode, series.renderer,
                               series.layer};
    EngineStep step;
    const starfocus_status status = MeasureStep(probe, &step);
    if (status != STARFOCUS_OK || step.layer != series.layer) {
      return Expected("engine", "a PSF for a blur radius of " + std::to_string(r),
                      starfocus_status_string(status));
    }
    const std::string reason = Explain(step);
    if (!reason.empty()) Extend(step, reason, joined, &stretches);
    joined = !reason.empty();
    apart = std::max(apart, step.apart);
    if (step.aliasing > aliasing) aliasing = step.aliasing, aliasing_r = r;
    table->Row().Add(step.r).Add(step.layer).Add(NameOf(series.renderer)).Add(step.n);
    table->Add(step.engine).Add(step.star).Add(step.subapertures).Add(step.paper).Add(step.apart);
    table->Add(reason);
    if (series.layer > 0) {
      const LayerTheory theory = MakeLayerTheory(r, series.layer);
      layers->Row().Add(step.r).Add(step.layer).Add(NameOf(series.renderer)).Add(step.n);
      layers->Add(step.engine).Add(theory.error).Add(step.aliasing).Add(theory.aliasing);
    }
    progress.Step();
  }
  for (const Stretch& stretch : stretches) {
    std::printf("    |r| %6.3f to %6.3f  SSE up to %.2e (at %.3f)  %s\n", stretch.first,
                stretch.last, stretch.worst, stretch.worst_r, stretch.reason.c_str());
  }
  std::printf("    %s above 1e-3; measured and described PSFs differ by at most %.1e\n",
              stretches.empty() ? "no radius" : "no other radius", apart);
  if (series.layer > 0) {
    std::printf("    aliasing up to %.2e (at %.3f; theory %.2e)\n", aliasing, aliasing_r,
                MakeLayerTheory(aliasing_r, series.layer).aliasing);
  }
  return {};
}

// Returns the gnuplot commands that plot a table of PSFs at layer 0.
std::string Panel(const std::string& title, const std::string& table, const std::string& range) {
  return "set title '" + title + "'\nset xrange [" + range + "]\nplot $" + table +
         " using 1:8 with lines lt 6 lw 1 title 'paper', "
         "'' using 1:7 with lines lt 3 lw 1 title 'exact subapertures', "
         "'' using 1:6 with lines lt 1 lw 3 title 'described', "
         "'' using 1:5 with points pt 7 ps 0.2 lt 2 title 'measured'\n";
}

// Tables with the measurements of one renderer.
struct RuleTables {
  Table engine, r_max, engine_layers, layers;
};

RuleTables MakeTables(starfocus_renderer renderer) {
  const std::string suffix = renderer == STARFOCUS_RENDERER_LINE_SCAN ? "" : "_subapertures";
  const std::vector<std::string> columns = {
      "r",         "L",     "renderer", "N", "sse_engine", "sse_star", "sse_subapertures",
      "sse_paper", "apart", "reason"};
  return {Table("engine" + suffix, columns), Table("engine_rmax" + suffix, columns),
          Table("engine_layers" + suffix, columns),
          Table("layers" + suffix, {"r", "L", "renderer", "N", "sse_engine", "sse_theory",
                                    "alias_engine", "alias_theory"})};
}

}  // namespace

Result<Figure> AnalyseEngine(int largest) {
  Figure figure = {"engine", 860, 1240, {}, ""};
  std::printf("The running engine: SSE of its PSFs against (4), and why where above 1e-3\n");
  for (const starfocus_renderer renderer :
       {STARFOCUS_RENDERER_LINE_SCAN, STARFOCUS_RENDERER_SLICES}) {
    RuleTables tables = MakeTables(renderer);
    for (int layer = 0; layer < STARFOCUS_LAYERS; ++layer) {
      const Series series = {STARFOCUS_MODE_BLOCK, renderer, layer, 0, 1.0 / 8, largest};
      Table* table = layer == 0 ? &tables.engine : &tables.engine_layers;
      for (const int sign : {1, -1}) {
        if (Error error = Measure(series, sign, table, &tables.layers)) return error;
      }
    }
    const Series series = {STARFOCUS_MODE_FRAME, renderer, 0, double(largest), 1.0 / 2, largest};
    if (Error error = Measure(series, 1, &tables.r_max, &tables.layers)) return error;
    for (const Table& table : {tables.engine, tables.r_max, tables.engine_layers, tables.layers}) {
      figure.tables.push_back(table);
    }
  }
  std::printf("\n");
  const std::string to = std::to_string(largest), range = "-" + to + ":" + to;
  figure.commands =
      "set multiplot layout 4,1 title 'PSFs of the running engine'\n"
      "set logscale y\nset format y '%.0e'\nset yrange [1e-7:0.2]\n"
      "set ylabel 'SSE (8)'\nset xlabel 'r = d - d_t'\n"
      "set arrow 1 from graph 0, first 1e-3 to graph 1, first 1e-3 nohead dt 2 lc rgb '#888888'\n" +
      Panel("layer 0, N from (9) at |r|", "engine", range) +
      Panel("layer 0, N by the rule for subapertures at |r|", "engine_subapertures", range) +
      Panel("layer 0, N by (9) for r_max = " + to, "engine_rmax", "0:" + to) +
      "set title 'layers, N by the rule for subapertures'\nset xrange [0:" + to +
      "]\n"
      "plot for [L=1:2] $layers_subapertures using (column(2) == L && $1 > 0 ? $1 : NaN):6 with "
      "lines lt "
      "L "
      "title sprintf('L = %d, theory (10)', L), "
      "for [L=1:2] $layers_subapertures using (column(2) == L ? abs($1) : NaN):5 with points pt 7 "
      "ps 0.2 lt L title sprintf('L = %d, measured', L)\nunset multiplot\n";
  return figure;
}

namespace {

// Derives the number of views N for subapertures, as rule (9) of the paper does for point samples.

using namespace analysis;

constexpr double kStep = 1.0 / 8;

Table SameRadius() {
  constexpr int kRadii[] = {2, 4, 5, 6, 8, 10, 12, 16, 20, 24, 32};
  Table table("subapertures_same_r",
              {"r", "N_paper", "sse_paper", "N_subapertures", "sse_subapertures"});
  std::printf(
      "subapertures: least N whose error is no larger than the paper's at the same r\n"
      "     r  N by (9)       SSE  N of ours       SSE\n");
  for (const int r : kRadii) {
    const int paper = ViewsByPaper(r), fewest = FewestSubapertures(r, kDefaultTheta);
    const double paper_error = PaperError(r, paper, kDefaultTheta),
                 error = SubapertureError(r, fewest, kDefaultTheta);
    std::printf("  %4d  %8d  %8.2e  %9d  %8.2e\n", r, paper, paper_error, fewest, error);
    table.Row().Add(r).Add(paper).Add(paper_error).Add(fewest).Add(error);
  }
  return table;
}

// Prints the ranges of r_max with the same N.
void PrintRule(const std::vector<int>& fewest, double limit) {
  std::printf("  Rule for a block: r_max and N, which holds for every r <= r_max\n   ");
  for (size_t k = 0; k < fewest.size(); ++k) {
    const double r = double(k + 1) * kStep;
    const bool last = k + 1 == fewest.size();
    if (last || starfocus::ViewsBySubaperture(r) != starfocus::ViewsBySubaperture(r + kStep)) {
      std::printf(" %g:%d", r, starfocus::ViewsBySubaperture(r));
    }
  }
  std::printf("\n  Least N that could do, from each r_max up to %g\n   ", limit);
  for (size_t k = 0; k < fewest.size(); ++k) {
    if (k == 0 || fewest[k] != fewest[k - 1]) std::printf(" %g:%d", (k + 1) * kStep, fewest[k]);
  }
  std::printf("\n");
}

}  // namespace

Figure AnalyseSubapertures(double max_blur) {
  Figure figure = {"subapertures", 860, 480, {SameRadius()}, ""};
  Table table("subapertures", {"r_max", "N_paper", "N_fewest", "N_rule", "margin", "worst_r"});
  SubapertureStudy study(max_blur, kStep, kDefaultTheta);
  Progress progress("analyzing subapertures", study.count());
  std::vector<int> fewest;
  double largest = 0, largest_at = 0;
  for (int k = 0; k < study.count(); ++k) {
    const double r = study.Radius(k);
    double worst = 0;
    const double margin = study.Margin(k, starfocus::ViewsBySubaperture(r), &worst);
    if (margin > largest) largest = margin, largest_at = r;
    fewest.push_back(study.Fewest(k));
    table.Row().Add(r).Add(ViewsByPaper(r)).Add(fewest.back());
    table.Add(starfocus::ViewsBySubaperture(r)).Add(margin).Add(worst);
    progress.Step();
  }
  PrintRule(fewest, max_blur);
  std::printf("  The rule %s: its error is at most %.3f of the limit (at r_max = %g)\n\n",
              largest <= 1 ? "holds" : "FAILS", largest, largest_at);
  figure.tables.push_back(table);
  figure.commands =
      "set title 'Views along the aperture radius'\nset xlabel 'r_max'\nset ylabel 'N'\n"
      "set key top left\n"
      "plot $subapertures using 1:2 with steps lt 6 title 'N by (9)', "
      "'' using 1:4 with steps lt 2 title 'N by the rule for subapertures', "
      "'' using 1:3 with steps lt 1 lw 1 title 'least N for every r up to r_max', "
      "$subapertures_same_r using 1:4 with points pt 7 ps 0.7 lt 3 title 'least N at r alone'\n";
  return figure;
}

}  // namespace starfocus
