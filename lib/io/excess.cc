// SPDX-License-Identifier: Apache-2.0
#include "lib/io/excess.h"

#include <cstddef>

#include "lib/base/transfer.h"

namespace starfocus {
namespace {

constexpr int32_t kSteps = 255 - kFirstExcess + 1;

int32_t ExcessOf(uint8_t code) {
  const int32_t step = Max(0, code - kFirstExcess + 1);
  return kLightWhite * step * step / (kSteps * kSteps);
}

// A row or a column of a captured view.
struct ViewLine {
  const ExcessViews& of;
  int view;
  bool is_row;
  int32_t index;

  int32_t Size() const { return is_row ? of.width : of.height; }
  bool HasHighlight(int32_t at) const {
    uint8_t room[3];
    return IsHighlight(of.views.Codes(view, is_row ? at : index, is_row ? index : at, 1, room));
  }
};

// Counts the consecutive highlights around `at`, which must be a highlight. The length of a run is
// at most LampReach. Runs that reach the edge of the picture have the length LampReach.
LampRun CountRun(const ViewLine& line, int32_t at) {
  const int32_t most = LampReach(line.of.lamp), size = line.Size();
  int32_t first = at, last = at;
  while (last - first + 1 < most && last + 1 < size && line.HasHighlight(last + 1)) ++last;
  const bool ends = last + 1 < size;
  while (ends && last - first + 1 < most && first > 0 && line.HasHighlight(first - 1)) --first;
  const bool inside = ends && first > 0 && last - first + 1 < most;
  return {static_cast<int16_t>(line.view), static_cast<uint16_t>(line.index),
          static_cast<uint16_t>(first), static_cast<uint16_t>(last),
          static_cast<uint16_t>(inside ? last - first + 1 : most)};
}

// Returns the length of the run of highlights that contains `at`.
int32_t RunThrough(const ViewLine& line, int32_t at) {
  LampRun* const runs = line.is_row ? line.of.runs->along : line.of.runs->down;
  const int32_t span = at >> LampRuns::kSpanBits;
  LampRun& run = runs[(line.index + 127 * span + 331 * line.view) & (LampRuns::kCount - 1)];
  const bool known =
      run.view == line.view && run.line == line.index && at >= run.first - 1 && at <= run.last + 1;
  if (!known) {
    run = CountRun(line, at);
  } else if (at < run.first) {
    run.first = static_cast<uint16_t>(at);  // pixel `at` is next to the run and extends it
  } else if (at > run.last) {
    run.last = static_cast<uint16_t>(at);
  }
  return run.length;
}

// Writes the excess of a pixel with the given codes.
void ReadPixel(const ExcessViews& of, int view, int32_t x, int32_t y, const uint8_t* codes,
               int16_t* rgb) {
  rgb[0] = rgb[1] = rgb[2] = 0;
  if (!IsHighlight(codes)) return;
  int32_t run = RunThrough({of, view, true, y}, x);
  if (run > of.lamp) run = Min(run, RunThrough({of, view, false, x}, y));
  const int32_t share = Clamp(LampReach(of.lamp) - run, 0, of.lamp);
  if (share == 0) return;
  for (int c = 0; c < 3; ++c) {
    rgb[c] = static_cast<int16_t>(ExcessOf(codes[c]) * share / of.lamp);
  }
}

void ReadExcess(const void* self, int view, int32_t x, int32_t y, int32_t count, int16_t* rgb) {
  const auto& of = *static_cast<const ExcessViews*>(self);
  for (int32_t p = 0; p < count; ++p) {
    uint8_t room[3];
    ReadPixel(of, view, x + p, y, of.views.Codes(view, x + p, y, 1, room), rgb + 3 * p);
  }
}

const uint8_t* CapturedCodes(const void* self, int view, int32_t x, int32_t y, int32_t count,
                             uint8_t* room) {
  return static_cast<const ExcessViews*>(self)->views.Codes(view, x, y, count, room);
}

}  // namespace

bool IsHighlight(const uint8_t* codes) {
  const int bright = (codes[0] >= kFirstExcess ? 1 : 0) + (codes[1] >= kFirstExcess ? 1 : 0) +
                     (codes[2] >= kFirstExcess ? 1 : 0);
  return bright >= 2;
}

ViewReader ReaderOf(const ExcessViews& views) { return {ReadExcess, CapturedCodes, &views}; }

}  // namespace starfocus
