// SPDX-License-Identifier: Apache-2.0
// Interprets the camera's controls: a rotary encoder for the focus, a button for the aperture, and
// a button for the shutter. The input consists of the signal edges on the GPIO lines of the
// controls. The module performs no I/O.
#ifndef STARFOCUS_EXAMPLES_BOARD_PANEL_H_
#define STARFOCUS_EXAMPLES_BOARD_PANEL_H_

#include <cstdint>
#include <vector>

#include "platform/controls.h"

namespace starfocus {

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
