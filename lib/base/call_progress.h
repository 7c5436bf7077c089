// SPDX-License-Identifier: Apache-2.0
// Progress and cancellation of a call, reported to the caller's progress function.
#ifndef STARFOCUS_LIB_BASE_CALL_PROGRESS_H_
#define STARFOCUS_LIB_BASE_CALL_PROGRESS_H_

#include <atomic>
#include <cstdint>

#include "starfocus/starfocus.h"

namespace starfocus {

// Calls the caller's progress function. Any thread that runs jobs may call the progress function,
// but only one thread at a time. The object lies in the workspace and is reused for each call of
// the engine.
class CallProgress {
 public:
  // Sets the progress function for later calls of the engine; `progress` may be null.
  void SetProgress(starfocus_progress progress, void* data) {
    progress_ = progress;
    data_ = data;
  }

  // Starts a call that produces `rows` rows, of which the first `done` are finished. No job may run
  // during Begin, SetRows and SetPart.
  void Begin(int32_t done, int32_t rows);

  // Reports that the rows before `done` are finished.
  void SetRows(int32_t done);
  // Declares the next set of jobs as part `part` of `parts` equal parts of the call. The number of
  // rows reported for a part is proportional to the number of its finished jobs.
  void SetPart(int32_t part, int32_t parts);

  // BeginJobs starts a set of `jobs` jobs. CountJob counts a finished job of the set.
  void BeginJobs(int32_t jobs);
  void CountJob() { jobs_done_.fetch_add(1, std::memory_order_relaxed); }

  // Calls the progress function unless another thread is calling it. Returns false after
  // cancellation. The progress function is not called again after cancellation.
  bool Ask();

  bool IsCancelled() const { return cancelled_.load(std::memory_order_relaxed) != 0; }

 private:
  starfocus_progress progress_ = nullptr;
  void* data_ = nullptr;
  int32_t rows_ = 0, done_ = 0, next_ = 0, jobs_ = 1;
  std::atomic<int32_t> jobs_done_{0};
  std::atomic<uint32_t> asking_{0}, cancelled_{0};
};

// Limits the work between two calls of the progress function. The limit is a number of samples
// because the library has no clock.
class CancelToken {
 public:
  CancelToken() = default;
  explicit CancelToken(CallProgress* call_progress) : call_progress_(call_progress) {}

  // Counts approximately `samples` samples that were read, filtered or accumulated. Returns true to
  // continue, or false after cancellation. Once false, the result stays false until the next call
  // of the engine.
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

  // Number of samples between two calls of the progress function. Processing kSamples samples takes
  // a fraction of a millisecond on a desktop and about one millisecond on a single-board computer.
  static constexpr int64_t kSamples = 1 << 19;

  CallProgress* call_progress_ = nullptr;  // null: never cancelled
  int64_t left_ = kSamples;
};

// Returns true if the call is to continue. If `cancel` is null, the result is always true.
inline bool GoesOn(CancelToken* cancel, int64_t samples) {
  return cancel == nullptr || cancel->Spend(samples);
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_BASE_CALL_PROGRESS_H_
