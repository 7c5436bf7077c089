// SPDX-License-Identifier: Apache-2.0
// Recomputes the tables and figures of section III of the paper from the definitions in that
// section.
#ifndef STARFOCUS_EXAMPLES_LAB_ANALYZE_FIGURES_H_
#define STARFOCUS_EXAMPLES_LAB_ANALYZE_FIGURES_H_

#include <string>

#include "examples/lab/analyze/table.h"
#include "platform/result.h"

namespace starfocus {

// Functions whose names start with Analyse print a part of the summary to stdout.
Figure AnalyseTableOne();
Figure AnalyseViewNumber();  // Fig. 6 and the thresholds of (9)

// Functions whose names start with Draw do not print to stdout.
Figure DrawViewPsfs();         // Fig. 4.
Figure DrawViewResponses();    // Fig. 5.
Figure DrawSubsampledBlurs();  // Fig. 8.

// Returns the table of N for subapertures and checks the rule for N, for blur radii up to
// `max_blur`.
Figure AnalyseSubapertures(double max_blur);

// Measures the engine's PSFs for blur radii up to `largest`. Returns an error if the engine cannot
// be run.
Result<Figure> AnalyseEngine(int largest);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_LAB_ANALYZE_FIGURES_H_
