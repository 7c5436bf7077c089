// SPDX-License-Identifier: Apache-2.0
// Lets a thread read the rows of a picture while another thread computes them.
#ifndef STARFOCUS_PLATFORM_ROW_GATE_H_
#define STARFOCUS_PLATFORM_ROW_GATE_H_

#include <algorithm>
#include <condition_variable>
#include <limits>
#include <mutex>

namespace starfocus {

class RowGate {
 public:
  // Declares that all rows before `end` are finished. Finished rows do not change again.
  void Finish(int end) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      end_ = std::max(end_, end);
    }
    changed_.notify_all();
  }

  // Declares that no more rows follow, also if the computation has failed.
  void FinishAll() { Finish(std::numeric_limits<int>::max()); }

  // Waits until row `y` is finished.
  void WaitFor(int y) {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, [&] { return y < end_; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  int end_ = 0;  // all rows before this row are finished
};

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_ROW_GATE_H_
