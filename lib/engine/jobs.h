// SPDX-License-Identifier: Apache-2.0
// Typed jobs of an engine. Each job receives the scratch memory of its worker.
#ifndef STARFOCUS_LIB_ENGINE_JOBS_H_
#define STARFOCUS_LIB_ENGINE_JOBS_H_

#include <cstdint>

#include "lib/base/jobs.h"
#include "lib/engine/engine.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Returns the largest number of jobs in any set of an engine.
int32_t MaxJobs(const starfocus_config& config);

// Runs kJob(data, index, scratch memory of the worker) for all indices in [0, count), like
// RunJobSet. `data` holds the input of the jobs and the location of their output.
template <class Data, void (*kJob)(const Data&, int32_t, Scratch*)>
starfocus_status RunJobs(const Data& data, int32_t count, EngineState* engine) {
  struct Set {
    const Data& data;
    Scratch* scratch;
  };
  const Set set = {data, engine->scratch};
  const JobFunction function = [](const void* of, int32_t index, int32_t worker) {
    const Set& jobs = *static_cast<const Set*>(of);
    kJob(jobs.data, index, &jobs.scratch[worker]);
  };
  return RunJobSet(function, &set, count, engine->jobs);
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_JOBS_H_
