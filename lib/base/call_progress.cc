// SPDX-License-Identifier: Apache-2.0
#include "lib/base/call_progress.h"

namespace starfocus {

void CallProgress::Begin(int32_t done, int32_t rows) {
  rows_ = rows;
  cancelled_.store(0);
  SetRows(done);
}

void CallProgress::SetRows(int32_t done) {
  done_ = next_ = done;
  BeginJobs(1);
}

void CallProgress::SetPart(int32_t part, int32_t parts) {
  done_ = static_cast<int32_t>(int64_t{rows_} * part / parts);
  next_ = static_cast<int32_t>(int64_t{rows_} * (part + 1) / parts);
  BeginJobs(1);
}

void CallProgress::BeginJobs(int32_t jobs) {
  jobs_ = jobs;
  jobs_done_.store(0, std::memory_order_relaxed);
}

bool CallProgress::Ask() {
  if (progress_ == nullptr) return true;
  if (IsCancelled()) return false;
  if (asking_.exchange(1) != 0) return true;
  // Checks for cancellation again, because another thread may have cancelled the call after the
  // first check. Only one thread at a time reads the number of finished jobs, so that the reported
  // number never decreases.
  if (!IsCancelled()) {
    const int64_t jobs_done = jobs_done_.load(std::memory_order_relaxed);
    const auto more = static_cast<int32_t>((next_ - done_) * jobs_done / jobs_);
    if (progress_(data_, done_ + more, rows_) != 0) cancelled_.store(1);
  }
  asking_.store(0);
  return !IsCancelled();
}

}  // namespace starfocus
