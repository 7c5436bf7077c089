// Jobs for the caller's runner.
#ifndef STARFOCUS_LIB_ENGINE_JOBS_H_
#define STARFOCUS_LIB_ENGINE_JOBS_H_

#include <cstdint>

#include "lib/engine/engine.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Who runs the jobs; a null function: the calling thread.
struct Runner {
  sf_runner run;
  void* data;
};

// Runs kJob(data, index, memory of a worker of data.engine) for all indices in [0, count), count >
// 0. SF_OK or SF_ERROR_RUNNER.
template <class Data, void (*kJob)(const Data&, int32_t, Worker*)>
sf_status RunJobs(Data* data, int32_t count, const Runner& runner) {
  const sf_job call = [](void* job_data, int32_t index, int32_t worker) {
    const auto& job = *static_cast<const Data*>(job_data);
    kJob(job, index, &job.engine->workers[worker]);
  };
  if (runner.run != nullptr) {
    return runner.run(runner.data, call, data, count) == 0 ? SF_OK : SF_ERROR_RUNNER;
  }
  for (int32_t index = 0; index < count; ++index) call(data, index, 0);
  return SF_OK;
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_JOBS_H_
