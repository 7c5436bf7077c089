// SPDX-License-Identifier: Apache-2.0
#include "examples/board/panel.h"

#include <algorithm>

namespace starfocus {

namespace {

// Returns the index of the state (a, b) in the clockwise cycle: A falls, B falls, A rises, B rises.
int Place(bool a, bool b) { return a ? (b ? 0 : 3) : (b ? 1 : 2); }

}  // namespace

QuadratureDecoder::QuadratureDecoder(bool a, bool b)
    : a_(a), b_(b), rest_(Place(a, b)), quarters_(0) {}

int QuadratureDecoder::Edge(bool a, bool b) {
  // A signal edge changes the level of at most one line, so `moved` is 0, 1 or 3.
  const int moved = (Place(a, b) - Place(a_, b_) + 4) % 4;
  a_ = a;
  b_ = b;
  quarters_ += moved == 3 ? -1 : moved;
  if (Place(a, b) != rest_) return 0;
  const int steps = quarters_ / 4;
  quarters_ = 0;
  return steps;
}

bool Debouncer::Edge(bool pressed, int64_t time) {
  const bool settled_press = Settle(time);
  const bool release_was_lost = pressed && pressed_ && last_;
  last_ = pressed;
  if (time - changed_ < quiet_) return settled_press;
  if (pressed == pressed_ && !release_was_lost) return settled_press;
  pressed_ = pressed;
  changed_ = time;
  return pressed || settled_press;
}

bool Debouncer::Settle(int64_t time) {
  if (!unsettled() || time < Due()) return false;
  pressed_ = last_;
  return pressed_;
}

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
