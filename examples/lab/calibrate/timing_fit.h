// SPDX-License-Identifier: Apache-2.0
// Fits the timing model (14) by least squares.
#ifndef STARFOCUS_EXAMPLES_LAB_CALIBRATE_TIMING_FIT_H_
#define STARFOCUS_EXAMPLES_LAB_CALIBRATE_TIMING_FIT_H_

#include <vector>

#include "examples/cli/engine_run.h"
#include "starfocus/experimental.h"

namespace starfocus {

struct Measurement {
  BlockWork work;
  double picoseconds;
};

// Returns the non-negative coefficients that minimize the weighted sum of squared errors. The
// weight of a block is the reciprocal of its measured time. This weight is a compromise between
// absolute and relative errors, so that small blocks have an influence.
starfocus_timing FitTiming(const std::vector<Measurement>& measurements);

// Coefficients of determination R^2: without weights, and with the weights of the fit.
struct Agreement {
  double plain, weighted;
};
Agreement Compare(const starfocus_timing& timing, const std::vector<Measurement>& measurements);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_LAB_CALIBRATE_TIMING_FIT_H_
