// SPDX-License-Identifier: Apache-2.0
// Declares the families of stress cases.
#ifndef STARFOCUS_TESTS_OPERATIONS_FAMILIES_H_
#define STARFOCUS_TESTS_OPERATIONS_FAMILIES_H_

#include "tests/operations/setup.h"
#include "tests/operations/stress.h"

namespace starfocus::stress {

// Describes a failed case.
inline Outcome Fail(const Setup& setup, const std::string& what) {
  return {0, what + ": " + setup.Text()};
}

// Families of pictures whose result is known or bounded.
Outcome Constant(test::Random* random);
Outcome Squares(test::Random* random);
Outcome Limits(test::Random* random);
Outcome Thresholds(test::Random* random);
Outcome FarFocus(test::Random* random);
Outcome Extremes(test::Random* random);
Outcome Noise(test::Random* random);
Outcome Energy(test::Random* random);
Outcome Steps(test::Random* random);

// Families of refocusings that must agree with each other.
Outcome Mirrors(test::Random* random);
Outcome SideViews(test::Random* random);
Outcome Continuity(test::Random* random);
Outcome Differential(test::Random* random);

// Family of disparity maps: planes that a repair must keep, and calls that must agree.
Outcome Maps(test::Random* random);

}  // namespace starfocus::stress

#endif  // STARFOCUS_TESTS_OPERATIONS_FAMILIES_H_
