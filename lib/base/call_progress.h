// SPDX-License-Identifier: Apache-2.0
// The caller's progress function, which is told how far a call has come and says whether to go on.
#ifndef STARFOCUS_LIB_BASE_CALL_PROGRESS_H_
#define STARFOCUS_LIB_BASE_CALL_PROGRESS_H_

#include <atomic>
#include <cstdint>

#include "starfocus/starfocus.h"

namespace starfocus {

// Asks the caller, from any of the threads that run jobs, but never two at a time. It lies in the
// workspace, for one call after the other.
class CallProgress {
 public:
  // Sets the function of the calls that follow; null: nobody is asked.
  void SetProgress(starfocus_progress progress, void* data) {
    progress_ = progress;
    data_ = data;
  }

  // Begins a call that makes `rows` rows, of which the first `done` are there. No job may be
  // running, here and in SetRows and SetPart.
  void Begin(int32_t done, int32_t rows);

  // Says that the rows up to `done` are made.
  void SetRows(int32_t done);
  // Says that the next set of jobs is part `part` of `parts` of what all rows take. Its rows are
  // made as its jobs are.
  void SetPart(int32_t part, int32_t parts);

  // The same from a set's jobs: `jobs` are begun, and one is done.
  void BeginJobs(int32_t jobs);
  void CountJob() { jobs_done_.fetch_add(1, std::memory_order_relaxed); }

  // Asks the caller whether to go on, unless another thread is doing so. Once he has said no,
  // nobody is asked any more, and it is no for all.
  bool Ask();

  bool IsCancelled() const { return cancelled_.load(std::memory_order_relaxed) != 0; }

 private:
  starfocus_progress progress_ = nullptr;
  void* data_ = nullptr;
  int32_t rows_ = 0, done_ = 0, next_ = 0, jobs_ = 1;
  std::atomic<int32_t> jobs_done_{0};
  std::atomic<uint32_t> asking_{0}, cancelled_{0};
};

// How long a thread works before it asks: by what it does, and not by a clock, which the library
// has none of.
class CancelToken {
 public:
  CancelToken() = default;
  explicit CancelToken(CallProgress* call_progress) : call_progress_(call_progress) {}

  // Counts about so many samples read, filtered or added up. Returns whether to go on; no once, it
  // is no until the next call.
  bool Spend(int64_t samples) {
    left_ -= samples;
    return left_ > 0 || Ask();
  }

 private:
  bool Ask() {
    const bool goes_on = call_progress_ == nullptr || call_progress_->Ask();
    left_ = goes_on ? kSamples : 0;
    return goes_on;
  }

  // A fraction of a millisecond's on a desktop, a millisecond's on a board.
  static constexpr int64_t kSamples = 1 << 19;

  CallProgress* call_progress_ = nullptr;  // null: nobody is asked
  int64_t left_ = kSamples;
};

// The same where there may be nobody to ask.
inline bool GoesOn(CancelToken* cancel, int64_t samples) {
  return cancel == nullptr || cancel->Spend(samples);
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_BASE_CALL_PROGRESS_H_
