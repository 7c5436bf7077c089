// SPDX-License-Identifier: Apache-2.0
#include "platform/controls.h"

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

}  // namespace starfocus
