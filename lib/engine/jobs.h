// SPDX-License-Identifier: Apache-2.0
// Typed jobs of an engine. Each job receives the scratch memory of its worker.
#ifndef STARFOCUS_LIB_ENGINE_JOBS_H_
#define STARFOCUS_LIB_ENGINE_JOBS_H_

#include <cstdint>

#include "lib/base/jobs.h"
#include "lib/engine/scratch.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Memory of all workers, and the set of jobs that use it.
struct Workers {
  Scratch* scratch = nullptr;
  Jobs jobs;  // set of jobs, with room for MaxJobs jobs
};

// Returns the largest number of jobs in any set of an engine.
int32_t MaxJobs(const starfocus_config& config);

// Runs kJob(data, index, scratch memory of the worker) for all indices in [0, count), like
// RunJobSet. `data` holds the input of the jobs and the location of their output.
template <class Data, void (*kJob)(const Data&, int32_t, Scratch*)>
starfocus_status RunJobs(const Data& data, int32_t count, Workers* workers) {
  struct Set {
    const Data& data;
    Scratch* scratch;
  };
  const Set set = {data, workers->scratch};
  const JobFunction function = [](const void* of, int32_t index, int32_t worker) {
    const Set& jobs = *static_cast<const Set*>(of);
    kJob(jobs.data, index, &jobs.scratch[worker]);
  };
  return RunJobSet(function, &set, count, &workers->jobs);
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_JOBS_H_
