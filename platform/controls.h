// SPDX-License-Identifier: Apache-2.0
// Interprets signal edges on the lines of knobs and buttons. The module performs no I/O and reads
// no clock, so that tests can replay any sequence of edges.
#ifndef STARFOCUS_PLATFORM_CONTROLS_H_
#define STARFOCUS_PLATFORM_CONTROLS_H_

#include <cstdint>

namespace starfocus {

// A rotary encoder with two lines and four edges between detents. A leads B clockwise.
//
// Every edge moves the position by a quarter of a step. A step counts when both lines have returned
// to the levels of a detent, so contact bounce cancels out. If an edge reports the current level of
// a line, an earlier edge was lost. In this case the position does not change, but the levels are
// correct afterwards. A lost edge may lose its step. A lost edge never causes a step in the wrong
// direction and never affects later steps.
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
  int rest_;      // index in the cycle at a detent
  int quarters_;  // quarters since the last detent
};

// A push button. The first edge of a press counts immediately. Edges that arrive within `quiet`
// after a change are treated as contact bounce. If a release was lost, the next press still counts.
class Debouncer {
 public:
  // @param quiet duration of contact bounce in nanoseconds. All times are in nanoseconds, from any
  //     monotonic clock
  explicit Debouncer(int64_t quiet) : quiet_(quiet) {}

  // Processes an edge of the line. Returns true if this edge is a press, or if an earlier press has
  // settled before this edge.
  bool Edge(bool pressed, int64_t time);

  // Accepts the level at the end of contact bounce. Call this function if no edge has arrived by
  // the time Due(). Returns true for a press.
  bool Settle(int64_t time);
  // Returns true if Settle must be called at the time Due().
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
