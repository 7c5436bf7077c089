// SPDX-License-Identifier: Apache-2.0
#include "lib/base/jobs.h"

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

namespace {

// Returns the two bits of a job in its word of Jobs::progress. The first bit is set when the job is
// taken. The second bit is set when the job is done.
uint32_t TakenBit(int32_t index) { return 1U << 2 * (index % 16); }
uint32_t DoneBit(int32_t index) { return 2 * TakenBit(index); }

void RunJob(int32_t index, int32_t worker, Jobs* set) {
  if (!set->call_progress.Ask()) return;
  set->function(set->data, index, worker);
  set->call_progress.CountJob();
}

// Takes a job and runs it. Returns false if the job was taken before or does not exist.
bool ClaimJob(Jobs* set, int32_t index, int32_t worker) {
  if (index < 0 || index >= set->count) return false;
  std::atomic<uint32_t>& word = set->progress[index / 16];
  if ((word.fetch_or(TakenBit(index)) & TakenBit(index)) != 0) return false;
  RunJob(index, worker, set);
  word.fetch_or(DoneBit(index));
  return true;
}

// Implements starfocus_job. A thread reads the set of jobs only while the thread occupies a worker
// slot, and the set changes only while all slots are free.
void CallJob(void* data, int32_t index, int32_t worker) {
  Jobs& set = *static_cast<Jobs*>(data);
  if (worker < 0 || worker >= set.max_workers || set.busy[worker].exchange(1) != 0) {
    set.misused.store(1);
    return;
  }
  if (set.open.load() != 0 && !ClaimJob(&set, index, worker)) set.misused.store(1);
  set.busy[worker].store(0);
}

// Returns true if each job of the set was run exactly once. Waits for jobs that still run after the
// runner has returned, because these jobs use memory of the call.
bool Close(Jobs* set) {
  set->open.store(0);
  for (int32_t worker = 0; worker < set->max_workers; ++worker) {
    while (set->busy[worker].load() != 0) {
    }
  }
  bool all = set->misused.load() == 0;
  for (int32_t index = 0; index < set->count; ++index) {
    all = all && (set->progress[index / 16].load() & DoneBit(index)) != 0;
  }
  return all;
}

}  // namespace

starfocus_status RunJobSet(JobFunction function, const void* data, int32_t count, Jobs* set) {
  set->function = function;
  set->data = data;
  set->count = count;
  set->call_progress.BeginJobs(count);
  if (set->runner == nullptr) {
    for (int32_t index = 0; index < count; ++index) RunJob(index, 0, set);
    return set->call_progress.IsCancelled() ? STARFOCUS_ERROR_CANCELLED : STARFOCUS_OK;
  }
  for (size_t word = 0; word < ProgressWords(static_cast<size_t>(count)); ++word) {
    set->progress[word].store(0, std::memory_order_relaxed);
  }
  set->misused.store(0);
  set->open.store(1);
  const int result = set->runner(set->runner_data, CallJob, set, count);
  const bool all = Close(set);
  // Cancellation has precedence: after cancellation a runner may have skipped jobs.
  if (set->call_progress.IsCancelled()) return STARFOCUS_ERROR_CANCELLED;
  return result == 0 && all ? STARFOCUS_OK : STARFOCUS_ERROR_RUNNER;
}

}  // namespace starfocus
