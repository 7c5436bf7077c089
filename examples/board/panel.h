// SPDX-License-Identifier: Apache-2.0
// The camera's controls: a rotary encoder for the focus, a button for the aperture and one for the
// shutter, from the edges of their lines. No I/O.
#ifndef STARFOCUS_EXAMPLES_BOARD_PANEL_H_
#define STARFOCUS_EXAMPLES_BOARD_PANEL_H_

#include <cstdint>
#include <vector>

#include "platform/controls.h"

namespace starfocus {

// Offsets of the lines; -1 for a control there is not.
struct PanelLines {
  int encoder_a = -1, encoder_b = -1;
  int aperture = -1;
  int shutter = -1;

  // Those there are.
  std::vector<int> All() const;
};

struct PanelActions {
  int focus_steps = 0;  // clockwise is positive
  int apertures = 0;    // presses
  int shutters = 0;     // presses

  bool any() const { return focus_steps != 0 || apertures != 0 || shutters != 0; }
};

class Panel {
 public:
  // Buttons connect to ground when `active_low`. `quiet` nanoseconds after a change of a button
  // are bouncing. The levels are those of the encoder's lines at rest.
  Panel(const PanelLines& lines, bool active_low, int64_t quiet, bool level_a, bool level_b);

  // An edge of `line` to `high` at `time`.
  PanelActions Edge(int line, bool high, int64_t time);
  // To be called when no edge came for Wait() nanoseconds.
  PanelActions Settle(int64_t time);
  // Nanoseconds until Settle has something to do; -1 for never.
  int64_t Wait(int64_t time) const;

 private:
  PanelLines lines_;
  bool active_low_;
  QuadratureDecoder encoder_;
  Debouncer aperture_, shutter_;
};

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_BOARD_PANEL_H_
