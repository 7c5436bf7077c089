// SPDX-License-Identifier: Apache-2.0
// Shows a progress line (console.h) with the remaining time, if stderr is a terminal. Only one
// Progress object at a time shows a progress line. A Progress object that is created while another
// object shows a line shows nothing, because it measures a part of the same work.
#ifndef STARFOCUS_PLATFORM_PROGRESS_H_
#define STARFOCUS_PLATFORM_PROGRESS_H_

#include <cstdint>
#include <mutex>
#include <string>
#include <utility>

namespace starfocus {

class Progress {
 public:
  // @param total number of steps that correspond to a progress of 100 %; 0: unknown
  Progress(std::string what, int64_t total);
  ~Progress();  // erases the progress line
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void Step(int64_t steps = 1);  // Thread-safe.

  // Returns a text such as ": 43 %, 12 s left". `seconds` is the elapsed time. The text omits the
  // remaining time if it cannot be estimated yet, and is empty if `total` is 0.
  static std::string State(int64_t done, int64_t total, double seconds);

 private:
  const std::string what_;
  const int64_t total_;
  const bool shown_here_;  // true if stderr is a terminal and this object shows the progress line
  const double start_;
  std::mutex mutex_;
  int64_t done_ = 0;
  double shown_ = 0;  // time of the last update in seconds; 0 before the first update
};

// Progress of pictures or maps that the library computes in sequence.
class PictureProgress {
 public:
  PictureProgress(std::string what, int pictures)
      : progress_(std::move(what), int64_t{kSteps} * pictures) {}

  // A callback of type starfocus_progress, whose `data` must point to a PictureProgress. Never
  // cancels.
  static int Tell(void* data, int32_t rows_done, int32_t rows);

 private:
  static constexpr int32_t kSteps = 1000;  // steps per picture

  Progress progress_;
  int32_t steps_ = 0;  // number of steps of the current picture that have been reported
};

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_PROGRESS_H_
