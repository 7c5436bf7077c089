// SPDX-License-Identifier: Apache-2.0
// Runs sets of jobs on the caller's runner and verifies that the runner starts each job exactly
// once.
#ifndef STARFOCUS_LIB_BASE_JOBS_H_
#define STARFOCUS_LIB_BASE_JOBS_H_

#include <atomic>
#include <cstddef>
#include <cstdint>

#include "lib/base/call_progress.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// The caller's function that runs jobs. If `run` is null, the calling thread runs the jobs.
struct Runner {
  starfocus_runner run;
  void* data;
};

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
  Runner runner = {};
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

  starfocus_status status() const { return status_; }

 private:
  Jobs* const jobs_;
  const int32_t phases_, count_;
  int32_t done_ = 0;
  starfocus_status status_ = STARFOCUS_OK;
};

}  // namespace starfocus

#endif  // STARFOCUS_LIB_BASE_JOBS_H_
