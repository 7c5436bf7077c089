// SPDX-License-Identifier: Apache-2.0
#include "lib/io/highlights.h"

#include <cstddef>
#include <cstring>

namespace starfocus {
namespace {

bool IsHighlight(const uint8_t* codes) {
  const int bright = (codes[0] >= kFirstExcess ? 1 : 0) + (codes[1] >= kFirstExcess ? 1 : 0) +
                     (codes[2] >= kFirstExcess ? 1 : 0);
  return bright >= 2;
}

// Fractional bits of Input::excess_factor.
constexpr int kExcessBits = 8;

// Returns the share of the light of a highlight that its excess has, in units of 1 / kWhole. The
// second largest code decides, with which the excess begins.
constexpr int32_t kSteps = 255 - kFirstExcess + 1, kWhole = kSteps * kSteps;

int32_t ShareOf(const uint8_t* codes) {
  const int32_t a = Min(codes[0], codes[1]), b = Max(codes[0], codes[1]);
  const int32_t step = Max(0, Max(a, Min(b, codes[2])) - kFirstExcess + 1);
  return step * step;
}

// A row or a column of a captured view.
struct ViewLine {
  const Input& in;
  int view;
  bool is_row;
  int32_t index;

  int32_t Size() const { return is_row ? in.width : in.height; }
  bool HasHighlight(int32_t at) const {
    uint8_t room[3];
    return IsHighlight(in.Codes(view, is_row ? at : index, is_row ? index : at, 1, room));
  }
};

// Counts the consecutive highlights around `at`, which must be a highlight. The length of a run is
// at most LampRadius. Runs that reach the edge of the picture have the length LampRadius.
LampLength CountLength(const ViewLine& line, int32_t at) {
  const int32_t most = LampRadius(LargestLamp(line.in.width)), size = line.Size();
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
  LampLength* const runs = line.is_row ? line.in.runs->along : line.in.runs->down;
  const int32_t piece = at >> LampLengths::kPieceBits;
  LampLength& run = runs[(line.index + 127 * piece + 331 * line.view) & (LampLengths::kCount - 1)];
  const bool known =
      run.view == line.view && run.line == line.index && at >= run.first - 1 && at <= run.last + 1;
  if (!known) {
    run = CountLength(line, at);
  } else if (at < run.first) {
    run.first = static_cast<uint16_t>(at);  // pixel `at` is next to the run and extends it
  } else if (at > run.last) {
    run.last = static_cast<uint16_t>(at);
  }
  return run.length;
}

// Writes the excess of a pixel with the given codes.
void ReadPixel(const Input& in, int view, int32_t x, int32_t y, const uint8_t* codes,
               int16_t* rgb) {
  rgb[0] = rgb[1] = rgb[2] = 0;
  if (!IsHighlight(codes)) return;
  const int32_t lamp = LargestLamp(in.width);
  int32_t run = RunThrough({in, view, true, y}, x);
  if (run > lamp) run = Min(run, RunThrough({in, view, false, x}, y));
  const int32_t share = Clamp(LampRadius(lamp) - run, 0, lamp);
  if (share == 0) return;
  const int32_t part = ShareOf(codes) * share, whole = kWhole * lamp;
  for (int c = 0; c < 3; ++c) {
    rgb[c] = static_cast<int16_t>(in.transfer->light[codes[c]] * part / whole);
  }
}

bool IsBright(const uint8_t* codes, int32_t pixels) {
  uint8_t brightest = 0;
  for (int32_t k = 0; k < 3 * pixels; ++k) brightest = codes[k] > brightest ? codes[k] : brightest;
  return brightest >= kFirstExcess;
}

void ReadExcess(const Input& in, int view, int32_t x, int32_t y, int32_t count, int16_t* rgb) {
  constexpr int32_t kPiece = 64;
  for (int32_t p = 0, some; p < count; p += some) {
    some = Min(kPiece, count - p);
    uint8_t room[3 * kPiece];
    const uint8_t* const codes = in.Codes(view, x + p, y, some, room);
    if (!IsBright(codes, some)) {
      std::memset(rgb + 3 * p, 0, 3 * static_cast<size_t>(some) * sizeof(*rgb));
      continue;
    }
    for (int32_t n = 0; n < some; ++n) {
      ReadPixel(in, view, x + p + n, y, codes + 3 * n, rgb + 3 * (p + n));
    }
  }
}

// Returns true if at least one of the pixels is not a highlight.
bool HasOthers(const uint8_t* codes, int32_t pixels) {
  uint8_t least = 255;
  for (int32_t n = 0; n < 3 * pixels; ++n) least = codes[n] < least ? codes[n] : least;
  if (least >= kFirstExcess) return false;
  for (int32_t p = 0; p < pixels; ++p) {
    if (!IsHighlight(codes + 3 * p)) return true;
  }
  return false;
}

// Returns true if test(codes, pixels) is true for any piece of a row of any view in `rect`. The
// part of `rect` outside the picture is ignored.
bool AnyPiece(const Input& in, const Rect& rect, bool (*test)(const uint8_t*, int32_t)) {
  constexpr int32_t kPiece = 1024;
  const int32_t left = Clamp(rect.x, 0, in.width - 1);
  const int32_t right = Clamp(rect.x + rect.width, left + 1, in.width);
  const int32_t top = Clamp(rect.y, 0, in.height - 1);
  const int32_t bottom = Clamp(rect.y + rect.height, top + 1, in.height);
  uint8_t room[3 * kPiece];
  for (int32_t y = top; y < bottom; ++y) {
    for (int32_t view = 0; view < in.views; ++view) {
      for (int32_t x = left; x < right; x += kPiece) {
        const int32_t pixels = Min(kPiece, right - x);
        if (test(in.Codes(view, x, y, pixels, room), pixels)) return true;
      }
    }
  }
  return false;
}

}  // namespace

bool HasHighlights(const Input& in, const Rect& rect, int32_t reach) {
  const Rect near = Extended(rect, {reach, reach, reach, reach});
  if (!AnyPiece(in, near, IsBright)) return false;
  const int32_t lamp = LampRadius(LargestLamp(in.width));
  return AnyPiece(in, Extended(near, {lamp, lamp, lamp, lamp}), HasOthers);
}

Input ExcessOf(const Input& captured, double highlights, LampLengths* runs) {
  runs->Clear();
  Input in = captured;
  in.reads_codes = false;
  in.read_light = ReadExcess;
  in.is_excess = true;
  in.captured = &captured;
  in.runs = runs;
  in.excess_factor =
      static_cast<int32_t>((static_cast<float>(highlights) - 1.0F) * (1 << kExcessBits) + 0.5F);
  return in;
}

void AddExcess(const Input& excess, const uint32_t* sums, size_t count, int shift, uint8_t* codes) {
  constexpr size_t kAtOnce = 96;
  const int bits = shift - kLightBits + kExcessBits;
  const uint64_t half = uint64_t{1} << (bits - 1);
  int16_t light[kAtOnce];
  for (size_t begin = 0; begin < count; begin += kAtOnce) {
    const size_t end = count - begin < kAtOnce ? count : begin + kAtOnce;
    for (size_t n = begin; n < end; ++n) {
      // The product of the sum and the factor is at most 2^32 * 63 * 2^8.
      const uint64_t more =
          (uint64_t{sums[n]} * static_cast<uint64_t>(excess.excess_factor) + half) >> bits;
      const uint64_t sum = static_cast<uint64_t>(excess.transfer->light[codes[n]]) + more;
      light[n - begin] = sum < kLightWhite ? static_cast<int16_t>(sum) : kLightWhite;
    }
    excess.kernels->Encode(light, end - begin, *excess.transfer, codes + begin);
  }
}

}  // namespace starfocus
