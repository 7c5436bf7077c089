// The running engine's kernels beside the theory.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "analyze/figures.h"
#include "lib/analysis/engine_steps.h"
#include "lib/analysis/selection.h"
#include "platform/file.h"
#include "platform/progress.h"

namespace starfocus {
namespace {

using namespace analysis;

constexpr int kLargest = 40;

// Consecutive steps with the same reason.
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

// Measures r = k * increment for k in [0, count], in the direction of `sign`; r_max 0 takes r
// itself.
std::string Measure(int count, double increment, int sign, double r_max, Table* table) {
  std::printf("  r = 0 to %d%s\n", sign * kLargest,
              r_max > 0 ? " in a picture whose r_max is 40" : ", r_max = r");
  Progress progress("the engine's kernels", count);
  std::vector<Stretch> stretches;
  double apart = 0;
  bool joined = false;
  for (int k = 0; k <= count; ++k) {
    const double r = k * increment;
    EngineStep step;
    const sf_status status = MeasureStep({sign * r, std::max(r, r_max)}, &step);
    if (status != SF_OK) {
      return Expected("engine", "a kernel at r = " + std::to_string(r), sf_status_string(status));
    }
    const std::string reason = Explain(step);
    if (!reason.empty()) Extend(step, reason, joined, &stretches);
    joined = !reason.empty();
    apart = std::max(apart, step.apart);
    table->Row().Add(step.r).Add(step.n).Add(step.engine).Add(step.star).Add(step.cells);
    table->Add(step.paper).Add(step.apart).Add(reason);
    progress.Step();
  }
  for (const Stretch& stretch : stretches) {
    std::printf("    |r| %6.3f to %6.3f  SSE up to %.2e (at %.3f)  %s\n", stretch.first,
                stretch.last, stretch.worst, stretch.worst_r, stretch.reason.c_str());
  }
  std::printf("    %s above 1e-3; measured and described kernels differ by at most %.1e\n",
              stretches.empty() ? "no step" : "no other step", apart);
  return "";
}

}  // namespace

Figure AnalyseEngine(std::string* error) {
  const std::vector<std::string> columns = {"r",         "N",         "sse_engine", "sse_star",
                                            "sse_cells", "sse_paper", "apart",      "reason"};
  Table table("engine", columns), wide("engine_r40", columns);
  std::printf(
      "The running engine: SSE of its kernels against (4), and why where above 1e-3 (layer 0)\n");
  for (const int sign : {1, -1}) {
    if (error->empty()) *error = Measure(8 * kLargest, 1.0 / 8, sign, 0, &table);
  }
  if (error->empty()) *error = Measure(2 * kLargest, 1.0 / 2, 1, kLargest, &wide);
  std::printf("\n");
  Figure figure = {"engine", 860, 620, {table, wide}, ""};
  figure.commands =
      "set multiplot layout 2,1 title 'Kernels of the running engine, layer 0'\n"
      "set logscale y\nset format y '%.0e'\nset yrange [1e-7:0.2]\n"
      "set ylabel 'SSE (8)'\nset xlabel 'r = d - d_t'\n"
      "set title 'N from (9) at |r|'\nset xrange [-40:40]\n"
      "set arrow 1 from graph 0, first 1e-3 to graph 1, first 1e-3 nohead dt 2 lc rgb '#888888'\n"
      "plot $engine using 1:6 with lines lt 6 lw 1 title 'paper', "
      "'' using 1:5 with lines lt 3 lw 1 title 'exact cells', "
      "'' using 1:4 with lines lt 1 lw 3 title 'described', "
      "'' using 1:3 with points pt 7 ps 0.2 lt 2 title 'measured'\n"
      "set title 'N = 32, as for r_max = 40'\nset xrange [0:40]\n"
      "plot $engine_r40 using 1:6 with lines lt 6 lw 1 title 'paper', "
      "'' using 1:5 with lines lt 3 lw 1 title 'exact cells', "
      "'' using 1:4 with lines lt 1 lw 3 title 'described', "
      "'' using 1:3 with points pt 7 ps 0.3 lt 2 title 'measured'\nunset multiplot\n";
  return figure;
}

}  // namespace starfocus
