// SPDX-License-Identifier: Apache-2.0
#include "lib/base/problem.h"

namespace starfocus {

sf_status Refuse(sf_status status, const FieldValue& field, const Allowed& allowed,
                 sf_problem* problem) {
  if (problem != nullptr) {
    *problem = {status,      field.index, field.name,  allowed.words,
                field.value, allowed.low, allowed.high};
  }
  return status;
}

void Checker::Stride(bool good, const char* name, size_t stride, int32_t index) {
  Need(good, SF_ERROR_STRIDE, {name, static_cast<double>(stride), index},
       {"at least the bytes of a row, and a multiple of the bytes of a value"});
}

sf_status TellStatus(sf_status status, sf_problem* problem) {
  if (status == SF_OK || problem == nullptr || problem->status != SF_OK) return status;
  const char* const field = status == SF_ERROR_RUNNER      ? "runner"
                            : status == SF_ERROR_CANCELLED ? "progress"
                            : status == SF_ERROR_MEMORY    ? "allocator"
                                                           : "";
  const char* const expected =
      status == SF_ERROR_RUNNER ? "each job once, by a worker below max_workers" : "";
  return Refuse(status, {field}, {expected}, problem);
}

sf_status CheckPointers(std::initializer_list<Pointer> pointers, sf_problem* problem) {
  if (problem != nullptr) *problem = {SF_OK, 0, "", "", kNoNumber, kNoNumber, kNoNumber};
  Checker check(problem);
  for (const Pointer& argument : pointers) check.NotNull(argument.pointer, argument.name);
  return check.status();
}

}  // namespace starfocus
