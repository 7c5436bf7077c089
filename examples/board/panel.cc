// SPDX-License-Identifier: Apache-2.0
#include "examples/board/panel.h"

#include <algorithm>

namespace starfocus {

std::vector<int> PanelLines::All() const {
  std::vector<int> all;
  for (const int line : {encoder_a, encoder_b, aperture, shutter}) {
    if (line >= 0) all.push_back(line);
  }
  return all;
}

Panel::Panel(const PanelLines& lines, bool active_low, int64_t quiet, bool level_a, bool level_b)
    : lines_(lines),
      active_low_(active_low),
      encoder_(level_a, level_b),
      aperture_(quiet),
      shutter_(quiet) {}

PanelActions Panel::Edge(int line, bool high, int64_t time) {
  PanelActions actions;
  const bool pressed = high != active_low_;
  if (line == lines_.encoder_a) actions.focus_steps = encoder_.EdgeOfA(high);
  if (line == lines_.encoder_b) actions.focus_steps = encoder_.EdgeOfB(high);
  if (line == lines_.aperture) actions.apertures = aperture_.Edge(pressed, time);
  if (line == lines_.shutter) actions.shutters = shutter_.Edge(pressed, time);
  return actions;
}

PanelActions Panel::Settle(int64_t time) {
  PanelActions actions;
  actions.apertures = aperture_.Settle(time);
  actions.shutters = shutter_.Settle(time);
  return actions;
}

int64_t Panel::Wait(int64_t time) const {
  int64_t due = INT64_MAX;
  for (const Debouncer* button : {&aperture_, &shutter_}) {
    if (button->unsettled()) due = std::min(due, button->Due());
  }
  return due == INT64_MAX ? -1 : std::max<int64_t>(0, due - time);
}

}  // namespace starfocus
