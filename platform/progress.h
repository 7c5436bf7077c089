// SPDX-License-Identifier: Apache-2.0
// A progress line on stderr, shown only when stderr is a terminal.
#ifndef STARFOCUS_PLATFORM_PROGRESS_H_
#define STARFOCUS_PLATFORM_PROGRESS_H_

#include <cstdint>
#include <mutex>
#include <string>

namespace starfocus {

class Progress {
 public:
  // `total` steps make 100 %; with total 0 the line shows the seconds gone by.
  Progress(std::string what, int64_t total);
  ~Progress();  // wipes the line
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void Step(int64_t steps = 1);  // from any thread

 private:
  void Show(double now);

  const std::string what_;
  const int64_t total_;
  const bool terminal_;
  const double start_;
  std::mutex mutex_;
  int64_t done_ = 0;
  double shown_ = 0;  // time of the last update; 0 before the first
};

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_PROGRESS_H_
