// SPDX-License-Identifier: Apache-2.0
// Lets the inputs of a batch overlap: while one input is refocused, the next input is decoded and
// the previous picture is encoded.
#ifndef STARFOCUS_EXAMPLES_CLI_REFOCUS_TURNS_H_
#define STARFOCUS_EXAMPLES_CLI_REFOCUS_TURNS_H_

#include <condition_variable>
#include <cstddef>
#include <mutex>

namespace starfocus {

// Turns of the inputs of a batch. At most `most` inputs have their turn at the same time, and turns
// begin in the order of the inputs.
class Turns {
 public:
  explicit Turns(size_t most) : most_(most) {}

 private:
  friend class Turn;

  const size_t most_;
  std::mutex mutex_;
  std::condition_variable changed_;
  size_t ended_ = 0;  // number of turns that have ended
};

// The turn of input `index`. Every input of the batch must have a Turn, also an input that fails,
// because later inputs wait for the end of this turn.
class Turn {
 public:
  Turn(Turns* turns, size_t index) : turns_(*turns), index_(index) {}
  ~Turn() { End(); }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

  // Waits until the turn begins. Does nothing if the turn has begun.
  void Begin() {
    std::unique_lock<std::mutex> lock(turns_.mutex_);
    turns_.changed_.wait(lock, [&] { return index_ < turns_.ended_ + turns_.most_; });
  }

  // Ends the turn, which begins first if necessary. Does nothing if the turn has ended.
  void End() {
    if (ended_) return;
    Begin();
    ended_ = true;
    {
      const std::lock_guard<std::mutex> lock(turns_.mutex_);
      ++turns_.ended_;
    }
    turns_.changed_.notify_all();
  }

 private:
  Turns& turns_;
  const size_t index_;
  bool ended_ = false;
};

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_REFOCUS_TURNS_H_
