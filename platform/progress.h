// SPDX-License-Identifier: Apache-2.0
// A progress line on stderr with the time that is left, shown only when stderr is a terminal. There
// is one line: while a Progress has it, later ones show nothing, as they are parts of its work.
#ifndef STARFOCUS_PLATFORM_PROGRESS_H_
#define STARFOCUS_PLATFORM_PROGRESS_H_

#include <cstdint>
#include <mutex>
#include <string>
#include <utility>

namespace starfocus {

class Progress {
 public:
  // `total` steps make 100 %.
  Progress(std::string what, int64_t total);
  ~Progress();  // wipes the line
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void Step(int64_t steps = 1);  // from any thread

  // Prints a line that stays on stderr, terminal or not, above the one of the progress. From any
  // thread.
  void Tell(const std::string& line);

  // "what: 43 %, 12 s left" after that many seconds; the time only when there is something to tell
  // it from.
  static std::string Text(const std::string& what, int64_t done, int64_t total, double seconds);

 private:
  void Show(double now);

  const std::string what_;
  const int64_t total_;
  const bool shown_here_;  // on a terminal, whose line is this one's
  const double start_;
  std::mutex mutex_;
  int64_t done_ = 0;
  double shown_ = 0;  // time of the last update; 0 before the first
};

// The line of pictures, or maps, that the library makes one after the other.
class PictureProgress {
 public:
  PictureProgress(std::string what, int pictures)
      : progress_(std::move(what), int64_t{kSteps} * pictures) {}

  // The starfocus_progress, whose data is the PictureProgress; never cancels.
  static int Tell(void* data, int32_t rows_done, int32_t rows);

 private:
  static constexpr int32_t kSteps = 1000;  // of a picture

  Progress progress_;
  int32_t steps_ = 0;  // that were told of this picture
};

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_PROGRESS_H_
