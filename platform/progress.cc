// SPDX-License-Identifier: Apache-2.0
#include "platform/progress.h"

#include <atomic>
#include <cmath>
#include <cstdio>

#include "platform/clock.h"
#include "platform/console.h"

namespace starfocus {
namespace {

// Seconds between updates of the progress line, and before the first update.
constexpr double kInterval = 0.1;
constexpr double kLeastTime = 1;  // Seconds before the remaining time is estimated.

std::atomic<bool> line_taken{false};

bool TakeLine() { return CanShowProgress() && !line_taken.exchange(true); }

}  // namespace

Progress::Progress(std::string what, int64_t total)
    : what_(std::move(what)), total_(total), shown_here_(TakeLine()), start_(Seconds()) {}

Progress::~Progress() {
  if (shown_ != 0) EraseProgress();
  if (shown_here_) line_taken = false;
}

void Progress::Step(int64_t steps) {
  if (!shown_here_) return;
  std::lock_guard<std::mutex> lock(mutex_);
  done_ += steps;
  const double now = Seconds();
  if (now - (shown_ != 0 ? shown_ : start_) < kInterval) return;
  shown_ = now;
  ShowProgress(what_, State(done_, total_, now - start_));
}

std::string Progress::State(int64_t done, int64_t total, double seconds) {
  if (total <= 0) return "";
  const double share = static_cast<double>(done) / static_cast<double>(total);
  char text[80];
  std::snprintf(text, sizeof(text), ": %.0f %%", 100 * share);
  const std::string percentage = text;
  if (done <= 0 || seconds < kLeastTime) return percentage;
  const long left = std::lround(seconds * (1 - share) / share);
  if (left < 60) {
    std::snprintf(text, sizeof(text), ", %ld s left", left);
  } else {
    std::snprintf(text, sizeof(text), ", %ld:%02ld min left", left / 60, left % 60);
  }
  return percentage + text;
}

int PictureProgress::Tell(void* data, int32_t rows_done, int32_t rows) {
  PictureProgress& self = *static_cast<PictureProgress*>(data);
  const auto steps = static_cast<int32_t>(int64_t{kSteps} * rows_done / rows);
  self.progress_.Step(steps - self.steps_);
  self.steps_ = rows_done < rows ? steps : 0;  // A picture is complete if rows_done equals rows.
  return 0;
}

}  // namespace starfocus
