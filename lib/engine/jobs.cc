// SPDX-License-Identifier: Apache-2.0
#include "lib/engine/jobs.h"

#include "lib/engine/reach.h"

namespace starfocus {
namespace {

enum Progress : uint32_t { kWaiting, kTaken, kDone };

// Takes a job and runs it; false when it has been taken before or does not exist.
bool TakeJob(JobSet* set, int32_t index, Worker* worker) {
  if (index < 0 || index >= set->count) return false;
  std::atomic<uint32_t>& progress = set->progress[index];
  if (progress.exchange(kTaken) != kWaiting) return false;
  set->function(set->data, index, worker);
  progress.store(kDone);
  return true;
}

// The sf_job. Whoever has a worker's memory reads the set, which changes only while nobody has any.
void CallJob(void* data, int32_t index, int32_t number) {
  Crew& crew = *static_cast<Crew*>(data);
  JobSet& set = crew.jobs;
  if (number < 0 || number >= crew.max_workers || set.busy[number].exchange(1) != 0) {
    set.misused.store(1);
    return;
  }
  if (set.open.load() != 0 && !TakeJob(&set, index, &crew.workers[number])) set.misused.store(1);
  set.busy[number].store(0);
}

// Whether every job of the set was run once. Jobs that still run, although the runner has returned,
// are waited for: they use memory of the call.
bool Close(Crew* crew) {
  JobSet* set = &crew->jobs;
  set->open.store(0);
  for (int32_t worker = 0; worker < crew->max_workers; ++worker) {
    while (set->busy[worker].load() != 0) {
    }
  }
  bool all = set->misused.load() == 0;
  for (int32_t index = 0; index < set->count; ++index) {
    all = all && set->progress[index].load() == kDone;
  }
  return all;
}

}  // namespace

int32_t MaxJobs(const sf_config& config) {
  const int32_t side = config.largest_block;
  // By columns of largest blocks; deblocking by rows of units, of one stripe and what waits above.
  return Max(Columns(config), side / kSmallestBlock + 1);
}

sf_status RunJobSet(JobFunction function, const void* data, int32_t count, const Runner& runner,
                    Crew* crew) {
  if (runner.run == nullptr) {
    for (int32_t index = 0; index < count; ++index) function(data, index, &crew->workers[0]);
    return SF_OK;
  }
  JobSet& set = crew->jobs;
  set.function = function;
  set.data = data;
  set.count = count;
  for (int32_t index = 0; index < count; ++index) {
    set.progress[index].store(kWaiting, std::memory_order_relaxed);
  }
  set.misused.store(0);
  set.open.store(1);
  const int result = runner.run(runner.data, CallJob, crew, count);
  const bool all = Close(crew);
  return result == 0 && all ? SF_OK : SF_ERROR_RUNNER;
}

}  // namespace starfocus
