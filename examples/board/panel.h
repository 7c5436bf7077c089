// SPDX-License-Identifier: Apache-2.0
// Interprets signal edges on the GPIO lines of a camera's controls: a rotary encoder for the focus,
// a button for the aperture, and a button for the shutter. The module performs no I/O and reads no
// clock, so that tests can replay any sequence of edges.
#ifndef STARFOCUS_EXAMPLES_BOARD_PANEL_H_
#define STARFOCUS_EXAMPLES_BOARD_PANEL_H_

#include <cstdint>
#include <vector>

namespace starfocus {

// A rotary encoder with two lines and four edges between detents. When the encoder turns clockwise,
// line A changes before line B.
//
// Every edge moves the position by a quarter of a step. The decoder counts a step when both lines
// have returned to the levels of a detent, so contact bounce cancels out. If an edge reports the
// current level of a line, an earlier edge was lost. If an edge was lost, the position does not
// change, but the decoder corrects the level of the line. A lost edge may cause the decoder to miss
// one step. A lost edge never causes a step in the wrong direction and never affects later steps.
class QuadratureDecoder {
 public:
  // @param a, b levels of lines A and B at a detent
  explicit QuadratureDecoder(bool a = true, bool b = true);

  // Processes an edge of line A or B to level `high`. Returns 1 for a clockwise step, -1 for a
  // counter-clockwise step, otherwise 0.
  int EdgeOfA(bool high) { return Edge(high, b_); }
  int EdgeOfB(bool high) { return Edge(a_, high); }

 private:
  int Edge(bool a, bool b);

  bool a_, b_;
  int rest_;      // Index of the levels at a detent in the cycle of four states.
  int quarters_;  // Quarters of a step since the last detent.
};

// A push button. The first edge of a press counts immediately. Edges that arrive within `quiet`
// nanoseconds after a level change are treated as contact bounce. If the edge of a release was
// lost, the next press still counts.
class Debouncer {
 public:
  // @param quiet duration of contact bounce in nanoseconds. All times of class Debouncer are in
  //     nanoseconds, from any monotonic clock
  explicit Debouncer(int64_t quiet) : quiet_(quiet) {}

  // Processes an edge of the line. Returns true if the edge is a press of the button, or if an
  // earlier press is accepted because its contact bounce has ended.
  bool Edge(bool pressed, int64_t time);

  // Accepts the current level of the line when contact bounce has ended. Call Settle if no edge has
  // arrived by the time Due(). Returns true if the accepted level is a press.
  bool Settle(int64_t time);
  // Returns true if Settle must be called at the time Due().
  bool unsettled() const { return last_ != pressed_; }
  int64_t Due() const { return changed_ + quiet_; }

 private:
  int64_t quiet_;
  int64_t changed_ = INT64_MIN / 2;  // Time of the last accepted change.
  bool pressed_ = false;             // True if the accepted level is a press.
  bool last_ = false;  // True if the line was at the level of a press after the last edge.
};

// GPIO lines of the controls, as offsets on the GPIO chip; -1: the board lacks the control.
struct PanelLines {
  int encoder_a = -1, encoder_b = -1;
  int aperture = -1;
  int shutter = -1;

  // Returns the lines of all existing controls.
  std::vector<int> All() const;
};

struct PanelActions {
  int focus_steps = 0;  // Number of encoder steps; positive is clockwise.
  int apertures = 0;    // Number of presses of the aperture button.
  int shutters = 0;     // Number of presses of the shutter button.

  bool any() const { return focus_steps != 0 || apertures != 0 || shutters != 0; }
};

class Panel {
 public:
  // @param active_low true if buttons connect to ground
  // @param quiet duration of contact bounce after a change of a button, in nanoseconds
  // @param level_a, level_b levels of the encoder's lines at rest
  Panel(const PanelLines& lines, bool active_low, int64_t quiet, bool level_a, bool level_b);

  // Processes an edge of `line` to level `high` at `time`.
  PanelActions Edge(int line, bool high, int64_t time);
  // Settles the buttons. Call Settle if no edge arrives within Wait() nanoseconds.
  PanelActions Settle(int64_t time);
  // Returns the time until Settle must be called, in nanoseconds, or -1 if no call is required.
  int64_t Wait(int64_t time) const;

 private:
  PanelLines lines_;
  bool active_low_;
  QuadratureDecoder encoder_;
  Debouncer aperture_, shutter_;
};

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_BOARD_PANEL_H_
