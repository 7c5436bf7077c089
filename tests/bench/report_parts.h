// SPDX-License-Identifier: Apache-2.0
// The parts of the report, each HTML.
#ifndef STARFOCUS_TESTS_BENCH_REPORT_PARTS_H_
#define STARFOCUS_TESTS_BENCH_REPORT_PARTS_H_

#include <functional>
#include <string>
#include <vector>

#include "tests/bench/counts.h"
#include "tests/bench/row.h"

namespace starfocus::bench {

using Rows = std::vector<Row>;

std::string TableTwo(const Rows& rows);
std::string TableFour(const Rows& rows);
std::string TruthTable(const Rows& rows);
std::string ScaleTable(const Rows& rows);
std::string TargetTable(const Rows& rows);
std::string WorkerTable(const Rows& rows);
std::string CountTable(const std::vector<Counts>& counts);

std::string PlanePlots(const Rows& rows);
std::string FocusPlots(const Rows& rows);
std::string GrowthPlots(const Rows& rows);
std::string LayerPlot(const Rows& rows);

// What they share.
double Ms(const Row& row);
std::string Escape(const std::string& text);
std::string Fixed(double value, int digits);            // a dash for what was not measured
std::vector<std::string> FieldNames(const Rows& rows);  // in their first order
std::string Method(const Row& row);                     // "block, 9 views"

using Keep = std::function<bool(const Row&)>;
using Value = std::function<double(const Row&)>;
Rows Filter(const Rows& rows, const Keep& keep);
double Mean(const Rows& rows, const Value& value);  // of the finite values; kNone of none

// Rows at a quantile of the disparity map with aperture `aperture`, of the whole star set or one
// of `views`: their mean is the expected value over the distribution of the target disparity.
Rows AtQuantiles(const Rows& rows, const std::string& field, const std::string& mode,
                 double aperture, int views);

}  // namespace starfocus::bench

#endif  // STARFOCUS_TESTS_BENCH_REPORT_PARTS_H_
