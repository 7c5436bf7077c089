// SPDX-License-Identifier: Apache-2.0
// The line that tells people what the library refused.
#ifndef STARFOCUS_PLATFORM_PROBLEM_H_
#define STARFOCUS_PLATFORM_PROBLEM_H_

#include <cstddef>

#include "starfocus/status.h"

namespace starfocus {

struct ProblemText {
  char text[256];
};

// "<field>: <sentence of the status> (expected <range>, found <value>)" of a call that returned
// `status`; the sentence alone if `problem` is null, of another call, or names no field.
ProblemText Describe(starfocus_status status, const starfocus_problem* problem);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_PROBLEM_H_
