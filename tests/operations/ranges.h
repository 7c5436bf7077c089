// SPDX-License-Identifier: Apache-2.0
// Collects failures of the engine's range checks, in builds that have these checks.
#ifndef STARFOCUS_TESTS_OPERATIONS_RANGES_H_
#define STARFOCUS_TESTS_OPERATIONS_RANGES_H_

#include <string>

namespace starfocus::stress {

// Returns a line about the first value outside its range since ForgetRangeFailure, or an empty
// string.
std::string RangeFailure();
void ForgetRangeFailure();

}  // namespace starfocus::stress

#endif  // STARFOCUS_TESTS_OPERATIONS_RANGES_H_
