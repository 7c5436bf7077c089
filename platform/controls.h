// SPDX-License-Identifier: Apache-2.0
// Knobs and buttons from the edges of their lines: no I/O and no clock, so that every sequence of
// edges can be tested.
#ifndef STARFOCUS_PLATFORM_CONTROLS_H_
#define STARFOCUS_PLATFORM_CONTROLS_H_

#include <cstdint>

namespace starfocus {

// A rotary encoder of two lines, A leading B clockwise, with four edges from detent to detent.
//
// Every edge moves a position by a quarter of a step, and a step counts when the lines are back in
// the levels of a detent; so contacts that bounce move back and forth and come to nothing. An edge
// to the level a line already has tells that one was lost: it moves nothing, but from then on the
// levels are right again. A lost edge may cost its step; it never makes one in the wrong direction
// nor spoils the following ones.
class QuadratureDecoder {
 public:
  // The levels of both lines at rest.
  explicit QuadratureDecoder(bool a = true, bool b = true);

  // An edge of line A or B to `high`. Returns the steps made: 1 clockwise, -1 counter-clockwise,
  // 0 otherwise.
  int EdgeOfA(bool high) { return Edge(high, b_); }
  int EdgeOfB(bool high) { return Edge(a_, high); }

 private:
  int Edge(bool a, bool b);

  bool a_, b_;
  int rest_;      // place in the cycle of a detent
  int quarters_;  // since the last detent
};

// A push button. The first edge of a press counts at once; what follows within `quiet` of a change
// is bouncing. When the release was lost, the next press still counts.
class Debouncer {
 public:
  // Times are in nanoseconds of any clock that never goes back.
  explicit Debouncer(int64_t quiet) : quiet_(quiet) {}

  // An edge of the line to `pressed` or released. Whether there was a press, then or when the
  // bouncing before it settled.
  bool Edge(bool pressed, int64_t time);

  // To be called when no edge has come until Due(): the level the bouncing ended in counts.
  // Whether that is a press.
  bool Settle(int64_t time);
  // Whether Settle has anything to do, and when.
  bool unsettled() const { return last_ != pressed_; }
  int64_t Due() const { return changed_ + quiet_; }

 private:
  int64_t quiet_;
  int64_t changed_ = INT64_MIN / 2;  // time of the last change that counted
  bool pressed_ = false;             // as far as that goes
  bool last_ = false;                // level after the last edge
};

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_CONTROLS_H_
