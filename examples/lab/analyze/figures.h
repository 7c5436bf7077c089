// SPDX-License-Identifier: Apache-2.0
// The tables and figures of the paper's section III, regenerated from its definitions.
#ifndef STARFOCUS_EXAMPLES_LAB_ANALYZE_FIGURES_H_
#define STARFOCUS_EXAMPLES_LAB_ANALYZE_FIGURES_H_

#include <string>

#include "examples/lab/analyze/table.h"
#include "platform/result.h"

namespace starfocus {

// Each prints its part of the summary to stdout.
Figure AnalyseTableOne();
Figure AnalyseViewNumber();  // Fig. 6 and the thresholds of (9)

// Nothing to print.
Figure DrawViewPsfs();         // Fig. 4
Figure DrawViewResponses();    // Fig. 5
Figure DrawSubsampledBlurs();  // Fig. 8

// The subapertures' table and rule, for blur radii up to max_blur.
Figure AnalyseSubapertures(double max_blur);

// The running engine's PSFs of blur radii up to `largest`; *error is set when it could not be
// run.
Result<Figure> AnalyseEngine(int largest);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_LAB_ANALYZE_FIGURES_H_
