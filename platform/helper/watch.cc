// SPDX-License-Identifier: Apache-2.0
#include "platform/helper/watch.h"

#include <poll.h>
#include <time.h>

#include <algorithm>
#include <cerrno>

#include "platform/clock.h"

namespace starfocus {
namespace {

constexpr int kStep = 50;  // Longest wait in milliseconds before the limits are checked again.
// Least progress. A process that only sleeps and wakes up once a second uses less than 1 ms in ten
// seconds. A decoder that shares a processor with a hundred other processes uses 100 ms.
constexpr uint64_t kLeastNanoseconds = 5'000'000;
constexpr size_t kLeastBytes = 65536;

// Returns the processor time of all threads of a process, or `unknown` if the system does not
// report it.
uint64_t ProcessNanoseconds(pid_t process, uint64_t unknown) {
  clockid_t clock;
  timespec time = {};
  if (clock_getcpuclockid(process, &clock) != 0 || clock_gettime(clock, &time) != 0) return unknown;
  return static_cast<uint64_t>(time.tv_sec) * 1'000'000'000 + static_cast<uint64_t>(time.tv_nsec);
}

}  // namespace

Watch::Watch(int file, pid_t helper, const HelperLimits& limits)
    : file_(file), helper_(helper), limits_(limits) {}

bool Watch::Progresses() {
  // Without a clock of the process, only the limit of the whole time is checked.
  const uint64_t used = ProcessNanoseconds(helper_, used_ + kLeastNanoseconds);
  if (received_ < kLeastBytes && used - used_ < kLeastNanoseconds) return false;
  used_ = used;
  received_ = 0;
  return true;
}

bool Watch::Wait(size_t received) {
  received_ += received;
  for (;;) {
    const double begin = Seconds();
    pollfd file = {file_, POLLIN, 0};
    const int ready = poll(&file, 1, kStep);
    // A longer step means that the program itself was stopped or has not been scheduled.
    const double waited = std::min(Seconds() - begin, 2e-3 * kStep);
    total_ += waited;
    idle_ = Progresses() ? 0 : idle_ + waited;
    if (ready < 0 && errno != EINTR) return false;
    if (idle_ > limits_.idle_seconds) end_ = End::kNoProgress;
    if (total_ > limits_.wall_seconds) end_ = End::kTooLong;
    if (end_ != End::kNone) return false;
    if (ready > 0) return true;
  }
}

}  // namespace starfocus
