// SPDX-License-Identifier: Apache-2.0
// Formats the library's errors as one line for users.
#ifndef STARFOCUS_PLATFORM_PROBLEM_H_
#define STARFOCUS_PLATFORM_PROBLEM_H_

#include <cstddef>

#include "starfocus/starfocus.h"

namespace starfocus {

struct ProblemText {
  char text[256];
};

// Returns "<field>: <sentence of the status> (expected <range>, found <value>)" for a call that
// returned `status`. Returns only the sentence of the status if `problem` is null, belongs to
// another call, or names no field.
ProblemText Describe(starfocus_status status, const starfocus_problem* problem);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_PROBLEM_H_
