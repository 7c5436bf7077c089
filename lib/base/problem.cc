// SPDX-License-Identifier: Apache-2.0
#include "lib/base/problem.h"

namespace starfocus {

starfocus_status Refuse(starfocus_status status, const FieldValue& field, const Allowed& allowed,
                        starfocus_problem* problem) {
  if (problem != nullptr) {
    *problem = {status,       field.index, field.name, allowed.words, field.value, allowed.low,
                allowed.high, -1,          -1};
  }
  return status;
}

void Checker::Stride(bool good, const char* name, size_t stride, int32_t index) {
  Need(good, STARFOCUS_ERROR_STRIDE, {name, static_cast<double>(stride), index},
       {"at least the bytes of a row, and a multiple of the bytes of a value"});
}

starfocus_status TellStatus(starfocus_status status, starfocus_problem* problem) {
  if (status == STARFOCUS_OK || problem == nullptr || problem->status != STARFOCUS_OK)
    return status;
  const char* const field = status == STARFOCUS_ERROR_RUNNER      ? "runner"
                            : status == STARFOCUS_ERROR_CANCELLED ? "progress"
                            : status == STARFOCUS_ERROR_MEMORY    ? "allocator"
                                                                  : "";
  const char* const expected = status == STARFOCUS_ERROR_RUNNER
                                   ? "each job once, with a worker index below max_workers"
                                   : "";
  return Refuse(status, {field}, {expected}, problem);
}

starfocus_status CheckPointers(std::initializer_list<Pointer> pointers,
                               starfocus_problem* problem) {
  if (problem != nullptr) {
    *problem = {STARFOCUS_OK, 0, "", "", kNoNumber, kNoNumber, kNoNumber, -1, -1};
  }
  Checker check(problem);
  for (const Pointer& argument : pointers) check.NotNull(argument.pointer, argument.name);
  return check.status();
}

}  // namespace starfocus
