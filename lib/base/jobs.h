// SPDX-License-Identifier: Apache-2.0
// Runs sets of jobs on the caller's runner and verifies that the runner starts each job exactly
// once. Progress and cancellation of a call, reported to the caller's progress function.
#ifndef STARFOCUS_LIB_BASE_JOBS_H_
#define STARFOCUS_LIB_BASE_JOBS_H_

#include <atomic>
#include <cstddef>
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

// A job, which has exclusive use of the memory of `worker` while the job runs.
using JobFunction = void (*)(const void* data, int32_t index, int32_t worker);

// Returns the number of words that record the taken and the finished jobs. Each job has two bits of
// a word, because some machines have no atomic objects smaller than a word.
constexpr size_t ProgressWords(size_t jobs) { return (jobs + 15) / 16; }

// Current set of jobs, the runner, and the progress of the call. The object lies in the workspace
// and outlives the call, so a job that starts after the call finds the set closed.
struct Jobs {
  JobFunction function = nullptr;
  const void* data = nullptr;
  int32_t count = 0;
  int32_t max_workers = 1;
  // Progress of the jobs: ProgressWords of the largest set.
  std::atomic<uint32_t>* progress = nullptr;
  // busy[k] is 1 while a job uses the memory of worker k.
  std::atomic<uint32_t> busy[STARFOCUS_MAX_WORKERS] = {};
  std::atomic<uint32_t> open{0};     // 1 from the start of a set until its runner has returned.
  std::atomic<uint32_t> misused{0};  // 1 after the runner made an invalid call, which was rejected.
  // The caller's function that runs jobs, and its first argument. If `runner` is null, the calling
  // thread runs the jobs.
  starfocus_runner runner = nullptr;
  void* runner_data = nullptr;
  CallProgress call_progress;
};

// Runs function(data, index, worker) for all indices in [0, count), count > 0. Calls the progress
// function before each job. No job runs after this function has returned, even if the runner
// misbehaves.
//
// Returns STARFOCUS_OK or an error:
// STARFOCUS_ERROR_CANCELLED: the progress function cancelled the call, and jobs were skipped.
// STARFOCUS_ERROR_RUNNER: the runner failed or did not run each job exactly once.
starfocus_status RunJobSet(JobFunction function, const void* data, int32_t count, Jobs* jobs);

// Calls work(index, worker) for all indices in [0, count), in parallel and in any order. Each call
// has exclusive use of the memory of `worker`. Returns the same as RunJobSet.
template <class Work>
starfocus_status ForEach(int32_t count, Jobs* jobs, const Work& work) {
  const JobFunction function = [](const void* data, int32_t index, int32_t worker) {
    (*static_cast<const Work*>(data))(index, worker);
  };
  return RunJobSet(function, &work, count, jobs);
}

// Phases of one call, each a set of `count` jobs that starts after the previous set has ended. All
// phases count the same for progress. After the first error, no further phase runs.
class Sequence {
 public:
  Sequence(Jobs* jobs, int32_t phases, int32_t count)
      : jobs_(jobs), phases_(phases), count_(count) {}

  // Runs the next phase: calls work(index, worker) for all indices in [0, count).
  template <class Work>
  void Run(const Work& work) {
    if (status_ != STARFOCUS_OK) return;
    jobs_->call_progress.SetPart(done_++, phases_);
    status_ = ForEach(count_, jobs_, work);
  }
  // Counts the next phase as done without running it.
  void Skip() { ++done_; }

  int32_t count() const { return count_; }
  starfocus_status status() const { return status_; }

 private:
  Jobs* const jobs_;
  const int32_t phases_, count_;
  int32_t done_ = 0;
  starfocus_status status_ = STARFOCUS_OK;
};

}  // namespace starfocus

#endif  // STARFOCUS_LIB_BASE_JOBS_H_
