// SPDX-License-Identifier: Apache-2.0
// A progress callback that checks its calls, and cancels the operation at a given call.
#ifndef STARFOCUS_TESTS_SUPPORT_WATCH_H_
#define STARFOCUS_TESTS_SUPPORT_WATCH_H_

#include <atomic>
#include <cstdint>

namespace test {

struct Watch {
  static constexpr int kNever = -1;

  explicit Watch(int cancel_at = kNever) : stop(cancel_at) {}

  int stop;       // Index of the call that cancels, or kNever.
  int calls = 0;  // Number of calls so far; simultaneous calls are counted in `clashes`.
  int32_t done = 0, rows = 0;
  int full = 0;      // Calls that report all rows as done.
  int back = 0;      // Calls with fewer rows than before, or a wrong total.
  int too_late = 0;  // Calls after the cancellation.
  std::atomic<int> inside{0}, clashes{0};

  static int Progress(void* data, int32_t rows_done, int32_t rows) {
    Watch& self = *static_cast<Watch*>(data);
    if (self.inside.fetch_add(1) != 0) ++self.clashes;
    if (rows_done < self.done || rows_done > rows) ++self.back;
    if (self.rows != 0 && self.rows != rows) ++self.back;
    if (rows_done == rows) ++self.full;
    self.done = rows_done;
    self.rows = rows;
    if (self.stop != kNever && self.calls > self.stop) ++self.too_late;
    const bool cancels = self.calls++ == self.stop;
    self.inside.fetch_sub(1);
    return cancels ? 1 : 0;
  }

  // Returns true if all calls of Progress so far were valid.
  bool Good() const { return back == 0 && too_late == 0 && clashes == 0; }
  bool Ended() const { return Good() && done == rows && full == 1; }
};

}  // namespace test

#endif  // STARFOCUS_TESTS_SUPPORT_WATCH_H_
