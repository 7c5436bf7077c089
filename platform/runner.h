// SPDX-License-Identifier: Apache-2.0
// Wraps the pool of starfocus/pool.h for jobs that may throw exceptions. Jobs of command-line
// programs may throw exceptions, but jobs of the engine do not throw.
#ifndef STARFOCUS_PLATFORM_RUNNER_H_
#define STARFOCUS_PLATFORM_RUNNER_H_

#include <cstdint>
#include <memory>

#include "starfocus/pool.h"
#include "starfocus/starfocus.h"

namespace starfocus {

class ThreadRunner {
 public:
  // @param workers number of workers in [1, STARFOCUS_MAX_WORKERS]; the runner has fewer workers if
  //     the system cannot start all threads. Throws std::bad_alloc if memory is insufficient.
  explicit ThreadRunner(int workers);

  int workers() const { return starfocus_pool_workers(pool_.get()); }

  // A function of type starfocus_runner, whose `runner_data` must point to a ThreadRunner. If a job
  // throws an exception, Run skips all jobs that have not started. After all running jobs have
  // ended, Run rethrows the first exception.
  static int Run(void* runner_data, starfocus_job job, void* job_data, int32_t count);

 private:
  struct Destroy {
    void operator()(starfocus_pool* pool) const { starfocus_pool_destroy(pool); }
  };

  std::unique_ptr<starfocus_pool, Destroy> pool_;
};

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_RUNNER_H_
