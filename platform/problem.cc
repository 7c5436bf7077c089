// SPDX-License-Identifier: Apache-2.0
#include "platform/problem.h"

#include <cmath>
#include <cstdio>
#include <cstring>

namespace starfocus {

ProblemText Describe(starfocus_status status, const starfocus_problem* problem) {
  ProblemText made;
  char* const text = made.text;
  const auto size = static_cast<int>(sizeof made.text);
  const char* const sentence = starfocus_status_string(status);
  if (problem == nullptr || problem->status != status || problem->field[0] == 0) {
    std::snprintf(text, sizeof made.text, "%s", sentence);
    return made;
  }
  int length = 0;
  const auto add = [&](const char* format, auto... values) {
    if (length < size) {
      length += std::snprintf(text + length, static_cast<size_t>(size - length), format, values...);
    }
  };
  if (const char* const bracket = std::strstr(problem->field, "[]")) {
    add("%.*s[%d]%s", static_cast<int>(bracket - problem->field), problem->field,
        static_cast<int>(problem->index), bracket + 2);
  } else {
    add("%s", problem->field);
  }
  add(": %s (expected %s", sentence, problem->expected);
  if (!std::isnan(problem->value)) add(", found %.9g", problem->value);
  if (problem->x >= 0)
    add(" at (%d, %d)", static_cast<int>(problem->x), static_cast<int>(problem->y));
  add("%s", ")");
  return made;
}

}  // namespace starfocus
