// Monotonic time.
#ifndef STARFOCUS_PLATFORM_CLOCK_H_
#define STARFOCUS_PLATFORM_CLOCK_H_

#include <chrono>

namespace starfocus {

// Seconds since an arbitrary moment; never goes back.
inline double Seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_CLOCK_H_
