// SPDX-License-Identifier: Apache-2.0
// Formats the measurements of refocusing as JSON for --report.
#ifndef STARFOCUS_EXAMPLES_CLI_REFOCUS_REPORT_H_
#define STARFOCUS_EXAMPLES_CLI_REFOCUS_REPORT_H_

#include <cstdint>
#include <string>

#include "examples/cli/engine_run.h"
#include "examples/cli/json.h"
#include "starfocus/experimental.h"

namespace starfocus {

// Names of the modes, in the order of starfocus_mode.
inline constexpr const char* kModeNames[] = {"frame", "benchmark", "block", "blur"};

// Returns the report. The task must have run with ThreadNanoseconds as its clock.
std::string ReportText(const EngineTask& task, const EngineResult& result, double seconds_total);

// Report on several pictures, each with its name.
class SeriesReport {
 public:
  void Add(const std::string& output, const EngineTask& task, const EngineResult& result);
  std::string Text(double seconds_total) const;

 private:
  Json pictures_ = Json::Array();
  uint64_t reused_blocks_ = 0, superblocks_ = 0;
};

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_REFOCUS_REPORT_H_
