// SPDX-License-Identifier: Apache-2.0
// Least squares for the timing model (14).
#ifndef STARFOCUS_EXAMPLES_LAB_CALIBRATE_TIMING_FIT_H_
#define STARFOCUS_EXAMPLES_LAB_CALIBRATE_TIMING_FIT_H_

#include <vector>

#include "examples/cli/engine/timing_terms.h"

namespace starfocus {

struct Measurement {
  BlockWork work;
  double picoseconds;
};

// The coefficients, none negative, of the least sum of squared errors, each divided by its measured
// time: an error then weighs between an absolute and a relative one, so that small blocks count.
starfocus_timing FitTiming(const std::vector<Measurement>& measurements);

// Coefficient of determination R^2, and the one with the weights of the fit.
struct Agreement {
  double plain, weighted;
};
Agreement Compare(const starfocus_timing& timing, const std::vector<Measurement>& measurements);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_LAB_CALIBRATE_TIMING_FIT_H_
