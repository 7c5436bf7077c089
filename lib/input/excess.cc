// SPDX-License-Identifier: Apache-2.0
#include "lib/input/excess.h"

#include <cstddef>
#include <initializer_list>

#include "lib/base/transfer.h"

namespace starfocus {
namespace {

constexpr int32_t kSteps = 255 - kFirstExcess + 1;

int32_t ExcessOf(uint8_t code) {
  const int32_t step = Max(0, code - kFirstExcess + 1);
  return kLightWhite * step * step / (kSteps * kSteps);
}

// The codes of a pixel, in the view or in `own`.
const uint8_t* CodesAt(const LampView& view, int32_t x, int32_t y, uint8_t* own) {
  if (view.reader == nullptr) return view.codes.Row(y) + 3 * static_cast<ptrdiff_t>(x);
  view.reader->Read(view.index, x, y, 1, own);
  return own;
}

// How many highlights follow each other through (x, y) along (dx, dy) and backwards, LampReach at
// most: as many also where they reach the picture's edge.
int32_t RunThrough(const LampView& view, int32_t x, int32_t y, int32_t dx, int32_t dy) {
  const int32_t most = LampReach(view.lamp);
  int32_t run = 1;
  for (const int32_t side : {1, -1}) {
    int32_t column = x, row = y;
    for (;;) {
      column += side * dx;
      row += side * dy;
      if (column < 0 || column >= view.width || row < 0 || row >= view.height) return most;
      uint8_t own[3];
      if (!IsHighlight(CodesAt(view, column, row, own))) break;
      if (++run >= most) return most;
    }
  }
  return run;
}

}  // namespace

bool IsHighlight(const uint8_t* codes) {
  const int bright = (codes[0] >= kFirstExcess ? 1 : 0) + (codes[1] >= kFirstExcess ? 1 : 0) +
                     (codes[2] >= kFirstExcess ? 1 : 0);
  return bright >= 2;
}

void ReadExcess(const LampView& view, int32_t x, int32_t y, int16_t* rgb) {
  uint8_t own[3];
  const uint8_t* codes = CodesAt(view, x, y, own);
  rgb[0] = rgb[1] = rgb[2] = 0;
  if (!IsHighlight(codes)) return;
  int32_t run = RunThrough(view, x, y, 1, 0);
  if (run > view.lamp) run = Min(run, RunThrough(view, x, y, 0, 1));
  const int32_t share = Clamp(LampReach(view.lamp) - run, 0, view.lamp);
  for (int c = 0; c < 3; ++c) {
    rgb[c] = static_cast<int16_t>(ExcessOf(codes[c]) * share / view.lamp);
  }
}

}  // namespace starfocus
