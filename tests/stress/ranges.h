// SPDX-License-Identifier: Apache-2.0
// Listens to the engine's range checks, in builds that have them.
#ifndef STARFOCUS_TESTS_STRESS_RANGES_H_
#define STARFOCUS_TESTS_STRESS_RANGES_H_

#include <string>

namespace starfocus::stress {

// The first value outside its range since ForgetRangeFailure, in a line; empty for none.
std::string RangeFailure();
void ForgetRangeFailure();

}  // namespace starfocus::stress

#endif  // STARFOCUS_TESTS_STRESS_RANGES_H_
