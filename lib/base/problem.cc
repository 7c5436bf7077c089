// SPDX-License-Identifier: Apache-2.0
#include "lib/base/problem.h"

namespace starfocus {

void Checker::Need(bool good, starfocus_status status, const FieldValue& field,
                   const Allowed& allowed) {
  if (good || !passed()) return;
  status_ = status;
  if (problem_ == nullptr) return;
  *problem_ = {status,       field.index, field.name, allowed.words, field.value, allowed.low,
               allowed.high, -1,          -1};
}

void Checker::In(const FieldValue& field, const Allowed& allowed) {
  // Every comparison with NaN is false, so NaN is rejected.
  Need(field.value >= allowed.low && field.value <= allowed.high, STARFOCUS_ERROR_RANGE, field,
       allowed);
}

void Checker::Stride(bool good, const char* name, size_t stride, int32_t index) {
  Need(good, STARFOCUS_ERROR_STRIDE, {name, static_cast<double>(stride), index},
       {"at least the bytes of a row, and a multiple of the bytes of a value"});
}

void Checker::NotNull(const void* pointer, const char* name, int32_t index) {
  Need(pointer != nullptr, STARFOCUS_ERROR_NULL, {name, kNoNumber, index}, {"not null"});
}

void Checker::Apart(const Extent& out, const Extents& read, const char* name) {
  Need(!Overlaps(out, read), STARFOCUS_ERROR_OVERLAP, {name},
       {"memory that overlaps neither the inputs nor the workspace"});
}

starfocus_status Checker::Add(starfocus_status status) {
  if (!passed() || status == STARFOCUS_OK) return status_;
  const bool is_known = problem_ != nullptr && problem_->status != STARFOCUS_OK;
  const char* const field = status == STARFOCUS_ERROR_RUNNER      ? "runner"
                            : status == STARFOCUS_ERROR_CANCELLED ? "progress"
                            : status == STARFOCUS_ERROR_MEMORY    ? "allocator"
                                                                  : "";
  const char* const expected = status == STARFOCUS_ERROR_RUNNER
                                   ? "each job once, with a worker index below max_workers"
                                   : "";
  if (!is_known) Need(false, status, {field}, {expected});
  return status_ = status;
}

Checker Enter(starfocus_problem* problem) {
  if (problem != nullptr) {
    *problem = {STARFOCUS_OK, 0, "", "", kNoNumber, kNoNumber, kNoNumber, -1, -1};
  }
  return Checker(problem);
}

}  // namespace starfocus
