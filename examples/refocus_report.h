// The figures of a refocusing, as JSON for `refocus --report`.
#ifndef STARFOCUS_EXAMPLES_REFOCUS_REPORT_H_
#define STARFOCUS_EXAMPLES_REFOCUS_REPORT_H_

#include <string>

#include "engine_run.h"

namespace starfocus {

// The modes by name, in the order of sf_mode.
inline constexpr const char* kModeNames[] = {"frame", "benchmark", "block", "blur"};

// The task must have been run with ThreadNanoseconds for a clock.
std::string ReportText(const EngineTask& task, const EngineResult& result, double seconds_total);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_REFOCUS_REPORT_H_
