// SPDX-License-Identifier: Apache-2.0
// Runs several phases in sequence and reports progress. A phase is a set of jobs, with one job per
// tile of the picture.
#ifndef STARFOCUS_LIB_DEPTH_PHASES_H_
#define STARFOCUS_LIB_DEPTH_PHASES_H_

#include "lib/base/jobs.h"
#include "lib/depth/setup.h"

namespace starfocus {

class Phases {
 public:
  // `count` is the number of phases of the whole API call. Progress is reported as a share of all
  // phases of the API call.
  Phases(const EstimatePlan& plan, int32_t count, Jobs* jobs)
      : tiles_(plan.columns * plan.rows), count_(count), jobs_(jobs) {}

  // Counts the next phase as done without running the phase.
  void Skip() { ++done_; }

  // Runs the next phase. Returns STARFOCUS_OK, STARFOCUS_ERROR_CANCELLED or STARFOCUS_ERROR_RUNNER
  // (RunJobSet).
  starfocus_status Run(JobFunction function, const void* data) {
    jobs_->call_progress.SetPart(done_++, count_);
    return RunJobSet(function, data, tiles_, jobs_);
  }

 private:
  int32_t tiles_, count_, done_ = 0;
  Jobs* jobs_;
};

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_PHASES_H_
