// SPDX-License-Identifier: Apache-2.0
// Lets the inputs of a batch overlap: while one input is refocused, the next input is decoded and
// the previous picture is encoded.
#ifndef STARFOCUS_EXAMPLES_CLI_REFOCUS_TURNS_H_
#define STARFOCUS_EXAMPLES_CLI_REFOCUS_TURNS_H_

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <mutex>

namespace starfocus {

// Turns of the inputs of a batch. At most `most` inputs have their turn at the same time, and turns
// begin in the order of the inputs. Outside its turn, an input may hold at most `most_bytes`.
class Turns {
 public:
  Turns(size_t most, uint64_t most_bytes) : most_(most), most_bytes_(most_bytes) {}

 private:
  friend class Turn;

  const size_t most_;
  const uint64_t most_bytes_;
  std::mutex mutex_;
  std::condition_variable changed_;
  size_t ended_ = 0;  // number of turns that have ended
};

// The turn of input `index`. Every input of the batch must have a Turn, also an input that fails,
// because later inputs wait for the end of this turn.
class Turn {
 public:
  Turn(Turns* turns, size_t index) : turns_(*turns), index_(index) {}
  ~Turn() { Finish(); }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

  // Waits until the turn begins. Does nothing if the turn has begun.
  void Begin() {
    std::unique_lock<std::mutex> lock(turns_.mutex_);
    turns_.changed_.wait(lock, [&] { return index_ < turns_.ended_ + turns_.most_; });
  }

  // Declares that the input is about to take `bytes` more of memory. If it then exceeds the limit
  // outside turns, waits until its turn begins.
  void Take(uint64_t bytes) {
    taken_ = bytes < UINT64_MAX - taken_ ? taken_ + bytes : UINT64_MAX;
    if (taken_ > turns_.most_bytes_) Begin();
  }

  // Ends the turn, which begins first if necessary. The input still holds `bytes` of memory. If
  // this exceeds the limit outside turns, the turn lasts until the input is destroyed instead. Does
  // nothing if the turn has ended.
  void End(uint64_t bytes) {
    if (bytes <= turns_.most_bytes_) Finish();
  }

 private:
  void Finish() {
    if (ended_) return;
    Begin();
    ended_ = true;
    {
      const std::lock_guard<std::mutex> lock(turns_.mutex_);
      ++turns_.ended_;
    }
    turns_.changed_.notify_all();
  }

  Turns& turns_;
  const size_t index_;
  uint64_t taken_ = 0;  // bytes
  bool ended_ = false;
};

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_REFOCUS_TURNS_H_
