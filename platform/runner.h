// SPDX-License-Identifier: Apache-2.0
// The pool of starfocus/pool.h for jobs that may throw, as those of the programs do.
#ifndef STARFOCUS_PLATFORM_RUNNER_H_
#define STARFOCUS_PLATFORM_RUNNER_H_

#include <cstdint>
#include <memory>

#include "starfocus/pool.h"
#include "starfocus/starfocus.h"

namespace starfocus {

class ThreadRunner {
 public:
  // `workers` in [1, STARFOCUS_MAX_WORKERS], fewer where the system refuses threads. Throws
  // std::bad_alloc where there is no memory.
  explicit ThreadRunner(int workers);

  int workers() const { return starfocus_pool_workers(pool_.get()); }

  // The starfocus_runner; runner_data is the ThreadRunner. As starfocus_pool_run, but when a job
  // throws, those not yet begun are left out and the first exception is thrown here once no job
  // runs any more; jobs of an engine do not throw.
  static int Run(void* runner_data, starfocus_job job, void* job_data, int32_t count);

 private:
  struct Destroy {
    void operator()(starfocus_pool* pool) const { starfocus_pool_destroy(pool); }
  };

  std::unique_ptr<starfocus_pool, Destroy> pool_;
};

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_RUNNER_H_
