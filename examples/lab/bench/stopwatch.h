// SPDX-License-Identifier: Apache-2.0
// Measures the processor time of this process and the elapsed time.
#ifndef STARFOCUS_EXAMPLES_LAB_BENCH_STOPWATCH_H_
#define STARFOCUS_EXAMPLES_LAB_BENCH_STOPWATCH_H_

#include <time.h>

#include "platform/clock.h"

namespace starfocus::bench {

// Returns the processor time of this process in seconds. Other processes affect the processor time
// only through shared caches and memory.
inline double CpuSeconds() {
  timespec now = {};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

// Processor time and elapsed time of a run, in seconds.
struct Elapsed {
  double cpu = 0, wall = 0;
};

class Stopwatch {
 public:
  Stopwatch() : cpu_(CpuSeconds()), wall_(Seconds()) {}
  Elapsed Get() const { return {CpuSeconds() - cpu_, Seconds() - wall_}; }

 private:
  double cpu_, wall_;
};

}  // namespace starfocus::bench

#endif  // STARFOCUS_EXAMPLES_LAB_BENCH_STOPWATCH_H_
