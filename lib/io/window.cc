// SPDX-License-Identifier: Apache-2.0
#include "lib/io/window.h"

#include <cstring>
#include <initializer_list>

#include "lib/io/excess.h"

namespace starfocus {
namespace {

// Largest number of pixels that are read at once into a buffer on the stack.
constexpr int32_t kMost = 72;

// Reads up to kMost pixels of a row of a view. Pixels outside the picture repeat its edge.
void ReadRow(const Window& window, int index, int32_t x, int32_t y, int32_t count, int16_t* rgb) {
  const int32_t right = window.picture_width - 1;
  const int32_t row = Clamp(y, 0, window.picture_height - 1);
  if (x >= 0 && x + count - 1 <= right) {
    window.reader.Light(index, x, row, count, rgb);
    return;
  }
  const int32_t first = Clamp(x, 0, right), last = Clamp(x + count - 1, 0, right);
  const int32_t inside = last - first + 1, before = Clamp(first - x, 0, count - 1);
  window.reader.Light(index, first, row, inside, rgb + 3 * before);
  for (int32_t p = before; p > 0; --p)
    std::memcpy(rgb + 3 * (p - 1), rgb + 3 * p, 3 * sizeof(*rgb));
  for (int32_t p = before + inside; p < count; ++p) {
    std::memcpy(rgb + 3 * p, rgb + 3 * (p - 1), 3 * sizeof(*rgb));
  }
}

int16_t RoundPlace(int32_t sum) {
  constexpr uint32_t kHalf = 1 << (2 * kShiftBits - 1);
  return static_cast<int16_t>((static_cast<uint32_t>(sum) + kHalf) >> (2 * kShiftBits));
}

// Calls take(n, sum) for the samples of `count` < kMost positions along a row. The first position
// is (x, y), kShiftBits. Sums have 2 * kShiftBits more fractional bits than light.
template <class Take>
void InterpolateRow(const Window& window, int index, int32_t x, int32_t y, int32_t count,
                    const Take& take) {
  const int32_t wx = x & (kShiftOne - 1), wy = y & (kShiftOne - 1);
  const int32_t column = x >> kShiftBits, row = y >> kShiftBits;
  int16_t above[3 * kMost], below[3 * kMost];
  const int32_t pixels = count + (wx != 0 ? 1 : 0), next = wx != 0 ? 3 : 0;
  ReadRow(window, index, column, row, pixels, above);
  if (wy != 0) ReadRow(window, index, column, row + 1, pixels, below);
  const int16_t* const lower = wy != 0 ? below : above;
  for (int32_t n = 0; n < 3 * count; ++n) {
    const int32_t upper_sum = above[n] * (kShiftOne - wx) + above[n + next] * wx;
    const int32_t lower_sum = lower[n] * (kShiftOne - wx) + lower[n + next] * wx;
    take(n, Checked(ranges::kHolePixel, upper_sum * (kShiftOne - wy) + lower_sum * wy));
  }
}

// Returns tap k of a triangular filter. The taps are 1 2 1 for layer 1, and 1 2 3 4 3 2 1 for layer
// 2. The taps of a layer sum to 4^L.
constexpr int32_t Tap(int layer, int32_t k) { return (1 << layer) - Abs(k); }

// Subsamples a captured view at `count` positions along a row, 2^kLayer pixels apart. The first
// position is pixel (x, y) of the picture.
template <int kLayer>
void SubsampleRow(const Window& window, int index, int32_t x, int32_t y, int32_t count,
                  int16_t* rgb) {
  constexpr int32_t kReach = (1 << kLayer) - 1, kTaps = 2 * kReach + 1;
  const int32_t pixels = ((count - 1) << kLayer) + kTaps;
  int16_t row[3 * kMost];
  int32_t down[3 * kMost];
  for (int32_t n = 0; n < 3 * pixels; ++n) down[n] = 0;
  for (int32_t dy = -kReach; dy <= kReach; ++dy) {
    ReadRow(window, index, x - kReach, y + dy, pixels, row);
    const int32_t tap = Tap(kLayer, dy);
    for (int32_t n = 0; n < 3 * pixels; ++n) down[n] += tap * row[n];
  }
  for (int32_t p = 0; p < count; ++p, rgb += 3) {
    const int32_t* const from = down + ((3 * p) << kLayer);
    int32_t sums[3] = {0, 0, 0};
    for (int32_t k = 0; k < kTaps; ++k) {
      for (int c = 0; c < 3; ++c) sums[c] += Tap(kLayer, k - kReach) * from[3 * k + c];
    }
    for (int c = 0; c < 3; ++c) rgb[c] = static_cast<int16_t>(RoundShift(sums[c], 4 * kLayer));
  }
}

// Reads the light at `count` positions along a row of a captured view, with the filters of
// ReadCaptured.
void ReadPlaces(const Window& window, int index, int32_t x, int32_t y, int32_t count,
                int16_t* rgb) {
  if (window.layer == 0) {
    InterpolateRow(window, index, x, y, count,
                   [&](int32_t n, int32_t sum) { rgb[n] = RoundPlace(sum); });
  } else {
    const int bits = kShiftBits - window.layer;
    const auto subsample = window.layer == 1 ? SubsampleRow<1> : SubsampleRow<2>;
    subsample(window, index, static_cast<int32_t>(RoundShift(x, bits)),
              static_cast<int32_t>(RoundShift(y, bits)), count, rgb);
  }
}

bool IsBright(const uint8_t* codes, int32_t pixels) {
  uint8_t brightest = 0;
  for (int32_t k = 0; k < 3 * pixels; ++k) brightest = codes[k] > brightest ? codes[k] : brightest;
  return brightest >= kFirstExcess;
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
bool AnyPiece(const Window& window, const Rect& rect, bool (*test)(const uint8_t*, int32_t)) {
  constexpr int32_t kPiece = 1024;
  const int32_t left = Clamp(rect.x, 0, window.picture_width - 1);
  const int32_t right = Clamp(rect.x + rect.width, left + 1, window.picture_width);
  const int32_t top = Clamp(rect.y, 0, window.picture_height - 1);
  const int32_t bottom = Clamp(rect.y + rect.height, top + 1, window.picture_height);
  uint8_t room[3 * kPiece];
  for (int32_t y = top; y < bottom; ++y) {
    for (int32_t view = 0; view < window.views; ++view) {
      for (int32_t x = left; x < right; x += kPiece) {
        const int32_t pixels = Min(kPiece, right - x);
        if (test(window.reader.Codes(view, x, y, pixels, room), pixels)) return true;
      }
    }
  }
  return false;
}

}  // namespace

void ReadCaptured(const Window& window, int index, const CapturedLine& line, int32_t count,
                  int16_t* rgb) {
  for (const int32_t last : {0, count - 1}) {
    Checked(ranges::kHolePosition, line.x + line.dx * last * kShiftOne);
    Checked(ranges::kHolePosition, line.y + line.dy * last * kShiftOne);
  }
  constexpr int32_t kPlaces = 16;
  const bool is_row = line.dx == 1 && line.dy == 0;
  for (int32_t p = 0, some = 0; p < count; p += some) {
    some = is_row ? Min(kPlaces, count - p) : 1;
    ReadPlaces(window, index, line.x + line.dx * p * kShiftOne, line.y + line.dy * p * kShiftOne,
               some, rgb + 3 * p);
  }
}

void InterpolateCaptured(const Window& window, int index, int32_t x, int32_t y, int32_t* rgb) {
  InterpolateRow(window, index, Checked(ranges::kHolePosition, x),
                 Checked(ranges::kHolePosition, y), 1,
                 [&](int32_t n, int32_t sum) { rgb[n] = sum; });
}

bool MayHaveHighlights(const Window& window, const Rect& rect) {
  return AnyPiece(window, rect, IsBright);
}

bool AreAllHighlights(const Window& window, const Rect& rect) {
  return !AnyPiece(window, rect, HasOthers);
}

}  // namespace starfocus
