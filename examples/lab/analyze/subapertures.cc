// SPDX-License-Identifier: Apache-2.0
// Derives the number of views N for subapertures, as rule (9) of the paper does for point samples.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "examples/lab/analysis/aperture.h"
#include "examples/lab/analysis/selection.h"
#include "examples/lab/analysis/subaperture_rule.h"
#include "examples/lab/analyze/figures.h"
#include "lib/optics/rules.h"
#include "platform/progress.h"

namespace starfocus {
namespace {

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
