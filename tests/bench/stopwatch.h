// SPDX-License-Identifier: Apache-2.0
// The processor's time of this process and the wall's.
#ifndef STARFOCUS_TESTS_BENCH_STOPWATCH_H_
#define STARFOCUS_TESTS_BENCH_STOPWATCH_H_

#include <time.h>

#include "platform/clock.h"

namespace starfocus::bench {

// Seconds of processor time: what the machine does for others meanwhile does not count.
inline double CpuSeconds() {
  timespec now = {};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

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

#endif  // STARFOCUS_TESTS_BENCH_STOPWATCH_H_
