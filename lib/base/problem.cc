// SPDX-License-Identifier: Apache-2.0
#include "lib/base/problem.h"

namespace starfocus {

void Checker::Stride(bool good, const char* name, size_t stride, int32_t index) {
  Need(good, STARFOCUS_ERROR_STRIDE, {name, static_cast<double>(stride), index},
       {"at least the bytes of a row, and a multiple of the bytes of a value"});
}

void Checker::NotNull(const void* pointer, const char* name, int32_t index) {
  Need(pointer != nullptr, STARFOCUS_ERROR_NULL, {name, kNoNumber, index}, {"not null"});
}

starfocus_status Checker::Add(starfocus_status status) {
  if (passed()) status_ = status;
  if (passed() || problem_ == nullptr || problem_->status != STARFOCUS_OK) return status_;
  const char* const field = status_ == STARFOCUS_ERROR_RUNNER      ? "runner"
                            : status_ == STARFOCUS_ERROR_CANCELLED ? "progress"
                            : status_ == STARFOCUS_ERROR_MEMORY    ? "allocator"
                                                                   : "";
  const char* const expected = status_ == STARFOCUS_ERROR_RUNNER
                                   ? "each job once, with a worker index below max_workers"
                                   : "";
  Refuse(status_, {field}, {expected});
  return status_;
}

void Checker::Refuse(starfocus_status status, const FieldValue& field, const Allowed& allowed) {
  status_ = status;
  if (problem_ == nullptr) return;
  *problem_ = {status,       field.index, field.name, allowed.words, field.value, allowed.low,
               allowed.high, -1,          -1};
}

Checker Enter(starfocus_problem* problem) {
  if (problem != nullptr) {
    *problem = {STARFOCUS_OK, 0, "", "", kNoNumber, kNoNumber, kNoNumber, -1, -1};
  }
  return Checker(problem);
}

}  // namespace starfocus
