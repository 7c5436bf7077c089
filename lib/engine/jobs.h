// SPDX-License-Identifier: Apache-2.0
// Jobs of an engine: each gets the memory of its worker.
#ifndef STARFOCUS_LIB_ENGINE_JOBS_H_
#define STARFOCUS_LIB_ENGINE_JOBS_H_

#include <cstdint>

#include "lib/base/jobs.h"
#include "lib/engine/worker.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// The workers' memory, and the jobs that use it.
struct Crew {
  Worker* workers = nullptr;
  JobSet jobs;  // there is room for MaxJobs
};

// Most jobs of any set of an engine.
int32_t MaxJobs(const sf_config& config);

// Runs kJob(data, index, memory of a worker) for all indices as RunJobSet does: its data are its
// input and say where its output goes.
template <class Data, void (*kJob)(const Data&, int32_t, Worker*)>
sf_status RunJobs(const Data& data, int32_t count, Crew* crew) {
  struct Set {
    const Data& data;
    Worker* workers;
  };
  const Set set = {data, crew->workers};
  const JobFunction function = [](const void* of, int32_t index, int32_t worker) {
    const Set& jobs = *static_cast<const Set*>(of);
    kJob(jobs.data, index, &jobs.workers[worker]);
  };
  return RunJobSet(function, &set, count, &crew->jobs);
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_JOBS_H_
