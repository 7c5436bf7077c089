// SPDX-License-Identifier: Apache-2.0
#include "platform/progress.h"

#include <unistd.h>

#include <cstdio>

#include "platform/clock.h"

namespace starfocus {
namespace {

constexpr double kInterval = 0.1;  // seconds between updates, and before the first one

}  // namespace

Progress::Progress(std::string what, int64_t total)
    : what_(std::move(what)),
      total_(total),
      terminal_(isatty(STDERR_FILENO) == 1),
      start_(Seconds()) {}

Progress::~Progress() {
  if (shown_ != 0) std::fputs("\r\x1b[K", stderr);
}

void Progress::Step(int64_t steps) {
  if (!terminal_) return;
  std::lock_guard<std::mutex> lock(mutex_);
  done_ += steps;
  const double now = Seconds();
  if (now - (shown_ != 0 ? shown_ : start_) >= kInterval) Show(now);
}

void Progress::Show(double now) {
  shown_ = now;
  const double percent = 100.0 * static_cast<double>(done_) / static_cast<double>(total_);
  std::fprintf(stderr, "\r\x1b[K%s: %.0f %%", what_.c_str(), percent);
  std::fflush(stderr);
}

int PictureProgress::Tell(void* data, int32_t rows_done, int32_t rows) {
  PictureProgress& self = *static_cast<PictureProgress*>(data);
  const auto steps = static_cast<int32_t>(int64_t{kSteps} * rows_done / rows);
  self.progress_.Step(steps - self.steps_);
  self.steps_ = rows_done < rows ? steps : 0;  // the next picture begins
  return 0;
}

}  // namespace starfocus
