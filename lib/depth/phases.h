// SPDX-License-Identifier: Apache-2.0
// Runs one set of jobs after the other, a job for each tile of a picture.
#ifndef STARFOCUS_LIB_DEPTH_PHASES_H_
#define STARFOCUS_LIB_DEPTH_PHASES_H_

#include "lib/base/jobs.h"
#include "lib/depth/estimate_plan.h"

namespace starfocus {

class Phases {
 public:
  // `count` phases are all that a call takes: the caller's progress function is told which is run.
  Phases(const EstimatePlan& plan, const Runner& runner, int32_t count, JobSet* jobs)
      : tiles_(plan.columns * plan.rows), count_(count), runner_(runner), jobs_(jobs) {}

  // Counts the next one as done.
  void Skip() { ++done_; }

  // SF_OK, SF_ERROR_CANCELLED or SF_ERROR_RUNNER, as RunJobSet.
  sf_status Run(JobFunction function, const void* data) {
    jobs_->watch.SetPart(done_++, count_);
    return RunJobSet(function, data, tiles_, runner_, jobs_);
  }

 private:
  int32_t tiles_, count_, done_ = 0;
  const Runner& runner_;
  JobSet* jobs_;
};

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_PHASES_H_
