// SPDX-License-Identifier: Apache-2.0
// Jobs for the caller's runner, which is not trusted to run each of them once.
#ifndef STARFOCUS_LIB_BASE_JOBS_H_
#define STARFOCUS_LIB_BASE_JOBS_H_

#include <atomic>
#include <cstddef>
#include <cstdint>

#include "lib/base/call_progress.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Who runs the jobs; a null function: the calling thread.
struct Runner {
  starfocus_runner run;
  void* data;
};

// A job; no other one has that worker's memory meanwhile.
using JobFunction = void (*)(const void* data, int32_t index, int32_t worker);

// The words that tell which of so many jobs are taken and which are done: two bits of each, as some
// machines have no smaller atomic objects than words.
constexpr size_t ProgressWords(size_t jobs) { return (jobs + 15) / 16; }

// The set of jobs that the runner has been given, the runner, and the progress function over all
// sets of a call. It lies in the workspace, so that a job called too late finds it closed.
struct JobSet {
  JobFunction function = nullptr;
  const void* data = nullptr;
  int32_t count = 0;
  int32_t max_workers = 1;
  std::atomic<uint32_t>* progress = nullptr;               // ProgressWords of the largest set
  std::atomic<uint32_t> busy[STARFOCUS_MAX_WORKERS] = {};  // 1: a job has that worker's memory
  std::atomic<uint32_t> open{0};                           // 1: the runner has not returned yet
  std::atomic<uint32_t> misused{0};                        // 1: a call was refused
  Runner runner = {};
  CallProgress call_progress;
};

// Runs function(data, index, worker) for all indices in [0, count), count > 0, and asks the
// progress function before each. STARFOCUS_OK; STARFOCUS_ERROR_CANCELLED, with jobs left out, once
// the progress function has heard no; or STARFOCUS_ERROR_RUNNER when the runner failed or did not
// run each of them exactly once. No job runs any more afterwards, whatever the runner does.
starfocus_status RunJobSet(JobFunction function, const void* data, int32_t count, JobSet* set);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_BASE_JOBS_H_
