// Monotonic time.
#ifndef STARFOCUS_PLATFORM_CLOCK_H_
#define STARFOCUS_PLATFORM_CLOCK_H_

#include <time.h>

#include <chrono>

namespace starfocus {

// Seconds since an arbitrary moment; never goes back.
inline double Seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Seconds that the calling thread has run on a processor: what other programs take is not counted.
inline double ThreadSeconds() {
  timespec time = {};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_CLOCK_H_
