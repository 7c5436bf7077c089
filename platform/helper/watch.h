// SPDX-License-Identifier: Apache-2.0
// Limits the time for which a program waits for a helper process (helper.h).
#ifndef STARFOCUS_PLATFORM_HELPER_WATCH_H_
#define STARFOCUS_PLATFORM_HELPER_WATCH_H_

#include <sys/types.h>

#include <cstddef>
#include <cstdint>

#include "platform/helper/helper.h"

namespace starfocus {

// Measures the progress of a helper process and the time for which the program waits for it. A
// helper process makes progress if it uses processor time or sends data. Time is not counted while
// the program does other work, is stopped by the user, or gets no processor.
class Watch {
 public:
  enum class End { kNone, kNoProgress, kTooLong };

  // `file` is the end of the pipe from which the program reads, and `helper` the process at the
  // other end, which must not have been waited for.
  Watch(int file, pid_t helper, const HelperLimits& limits);

  // Waits until a read of `file` does not block. `received` is the number of bytes that have been
  // read since the last call. Returns false if the helper process has exceeded a limit.
  bool Wait(size_t received);

  // Returns the limit that the helper process has exceeded.
  End end() const { return end_; }

 private:
  // Returns true if the helper process has done enough since the last progress.
  bool Progresses();

  const int file_;
  const pid_t helper_;
  const HelperLimits limits_;
  double total_ = 0, idle_ = 0;  // seconds of waiting: altogether, and since the last progress
  uint64_t used_ = 0;            // processor time in nanoseconds at the last progress
  size_t received_ = 0;          // bytes since the last progress
  End end_ = End::kNone;
};

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_HELPER_WATCH_H_
