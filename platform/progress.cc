// SPDX-License-Identifier: Apache-2.0
#include "platform/progress.h"

#include <unistd.h>

#include <atomic>
#include <cmath>
#include <cstdio>

#include "platform/clock.h"

namespace starfocus {
namespace {

// Seconds between updates of the progress line, and before the first update.
constexpr double kInterval = 0.1;
constexpr double kLeastTime = 1;  // Seconds before the remaining time is estimated.

std::atomic<bool> line_taken{false};

bool TakeLine() { return isatty(STDERR_FILENO) == 1 && !line_taken.exchange(true); }

}  // namespace

Progress::Progress(std::string what, int64_t total)
    : what_(std::move(what)), total_(total), shown_here_(TakeLine()), start_(Seconds()) {}

Progress::~Progress() {
  if (shown_ != 0) std::fputs("\r\x1b[K", stderr);
  if (shown_here_) line_taken = false;
}

void Progress::Step(int64_t steps) {
  if (!shown_here_) return;
  std::lock_guard<std::mutex> lock(mutex_);
  done_ += steps;
  const double now = Seconds();
  if (now - (shown_ != 0 ? shown_ : start_) >= kInterval) Show(now);
}

void Progress::Tell(const std::string& line) {
  std::lock_guard<std::mutex> lock(mutex_);
  std::fprintf(stderr, "%s%s\n", shown_ != 0 ? "\r\x1b[K" : "", line.c_str());
  if (shown_ != 0) Show(Seconds());
}

std::string Progress::Text(const std::string& what, int64_t done, int64_t total, double seconds) {
  const double share = static_cast<double>(done) / static_cast<double>(total);
  char text[80];
  std::snprintf(text, sizeof(text), ": %.0f %%", 100 * share);
  std::string line = what + text;
  if (done <= 0 || seconds < kLeastTime) return line;
  const long left = std::lround(seconds * (1 - share) / share);
  if (left < 60) {
    std::snprintf(text, sizeof(text), ", %ld s left", left);
  } else {
    std::snprintf(text, sizeof(text), ", %ld:%02ld min left", left / 60, left % 60);
  }
  return line + text;
}

void Progress::Show(double now) {
  shown_ = now;
  std::fprintf(stderr, "\r\x1b[K%s", Text(what_, done_, total_, now - start_).c_str());
  std::fflush(stderr);
}

int PictureProgress::Tell(void* data, int32_t rows_done, int32_t rows) {
  PictureProgress& self = *static_cast<PictureProgress*>(data);
  const auto steps = static_cast<int32_t>(int64_t{kSteps} * rows_done / rows);
  self.progress_.Step(steps - self.steps_);
  self.steps_ = rows_done < rows ? steps : 0;  // A picture is complete if rows_done equals rows.
  return 0;
}

}  // namespace starfocus
