// SPDX-License-Identifier: Apache-2.0
// Interprets the edges of the lines of knobs and buttons. Uses no I/O and no clock, so that tests
// can replay any sequence of edges.
#ifndef STARFOCUS_PLATFORM_CONTROLS_H_
#define STARFOCUS_PLATFORM_CONTROLS_H_

#include <cstdint>

namespace starfocus {

// A rotary encoder with two lines and four edges between detents. A leads B clockwise.
//
// Every edge moves the position by a quarter of a step. A step counts when both lines are back at
// the levels of a detent, so bouncing contacts cancel out. An edge to the current level of a line
// means that an edge was lost. The position does not change then, but the levels are correct
// afterwards. A lost edge may lose its step. It never causes a step in the wrong direction, nor
// affects later steps.
class QuadratureDecoder {
 public:
  // @param a, b levels of the lines at rest
  explicit QuadratureDecoder(bool a = true, bool b = true);

  // Processes an edge of line A or B to level `high`. Returns 1 for a clockwise step, -1 for a
  // counter-clockwise step, otherwise 0.
  int EdgeOfA(bool high) { return Edge(high, b_); }
  int EdgeOfB(bool high) { return Edge(a_, high); }

 private:
  int Edge(bool a, bool b);

  bool a_, b_;
  int rest_;      // place in the cycle at a detent
  int quarters_;  // quarters since the last detent
};

// A push button. The first edge of a press counts immediately; edges within `quiet` after a change
// are bouncing. If a release was lost, the next press still counts.
class Debouncer {
 public:
  // @param quiet duration of bouncing in nanoseconds, the unit of all times, from any monotonic
  // clock
  explicit Debouncer(int64_t quiet) : quiet_(quiet) {}

  // Processes an edge of the line. Returns true for a press, either by this edge or by bouncing
  // that has settled before it.
  bool Edge(bool pressed, int64_t time);

  // Accepts the level at the end of bouncing. Call it if no edge has arrived until Due(). Returns
  // true for a press.
  bool Settle(int64_t time);
  // unsettled() is true if Settle must be called, at the time Due().
  bool unsettled() const { return last_ != pressed_; }
  int64_t Due() const { return changed_ + quiet_; }

 private:
  int64_t quiet_;
  int64_t changed_ = INT64_MIN / 2;  // time of the last accepted change
  bool pressed_ = false;             // accepted level
  bool last_ = false;                // level after the last edge
};

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_CONTROLS_H_
