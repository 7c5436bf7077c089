// SPDX-License-Identifier: Apache-2.0
#include "lib/input/excess.h"

#include <cstddef>

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

// A row or a column of a view.
struct Line {
  const LampView& view;
  bool is_row;
  int32_t index;

  int32_t Size() const { return is_row ? view.width : view.height; }
  bool HasHighlight(int32_t at) const {
    uint8_t own[3];
    return IsHighlight(is_row ? CodesAt(view, at, index, own) : CodesAt(view, index, at, own));
  }
};

// Counts the highlights that follow each other through `at`, which is one: LampReach at most, and
// as many also where they reach the picture's edge.
LampRun CountRun(const Line& line, int32_t at) {
  const int32_t most = LampReach(line.view.lamp), size = line.Size();
  int32_t first = at, last = at;
  while (last - first + 1 < most && last + 1 < size && line.HasHighlight(last + 1)) ++last;
  const bool ends = last + 1 < size;
  while (ends && last - first + 1 < most && first > 0 && line.HasHighlight(first - 1)) --first;
  const bool inside = ends && first > 0 && last - first + 1 < most;
  return {static_cast<int16_t>(line.view.index), static_cast<uint16_t>(line.index),
          static_cast<uint16_t>(first), static_cast<uint16_t>(last),
          static_cast<uint16_t>(inside ? last - first + 1 : most)};
}

// Returns the length of the run through `at`.
int32_t RunThrough(const Line& line, int32_t at) {
  LampRun* const runs = line.is_row ? line.view.runs->along : line.view.runs->down;
  const int32_t span = at >> LampRuns::kSpanBits;
  LampRun& run = runs[(line.index + 127 * span + 331 * line.view.index) & (LampRuns::kCount - 1)];
  const bool known = run.view == line.view.index && run.line == line.index && at >= run.first - 1 &&
                     at <= run.last + 1;
  if (!known) {
    run = CountRun(line, at);
  } else if (at < run.first) {
    run.first = static_cast<uint16_t>(at);  // beside a run is the same run
  } else if (at > run.last) {
    run.last = static_cast<uint16_t>(at);
  }
  return run.length;
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
  int32_t run = RunThrough({view, true, y}, x);
  if (run > view.lamp) run = Min(run, RunThrough({view, false, x}, y));
  const int32_t share = Clamp(LampReach(view.lamp) - run, 0, view.lamp);
  if (share == 0) return;
  for (int c = 0; c < 3; ++c) {
    rgb[c] = static_cast<int16_t>(ExcessOf(codes[c]) * share / view.lamp);
  }
}

}  // namespace starfocus
