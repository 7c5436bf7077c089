// SPDX-License-Identifier: Apache-2.0
// Functions that measure monotonic time and CPU time.
#ifndef STARFOCUS_PLATFORM_CLOCK_H_
#define STARFOCUS_PLATFORM_CLOCK_H_

#include <time.h>

#include <chrono>
#include <cstdint>

namespace starfocus {

// Returns seconds since an arbitrary start; never decreases.
inline double Seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Returns the CPU time of the calling thread in nanoseconds, from an arbitrary start. CPU time does
// not include the time of other programs. The function can be used as a starfocus_clock.
inline uint64_t ThreadNanoseconds() {
  timespec time = {};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<uint64_t>(time.tv_sec) * 1000000000u + static_cast<uint64_t>(time.tv_nsec);
}

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_CLOCK_H_
