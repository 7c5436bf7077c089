// SPDX-License-Identifier: Apache-2.0
#include "lib/input/window.h"

#include <initializer_list>

namespace starfocus {
namespace {

constexpr int32_t kRowsAhead = 2;  // rows of the layer below the first place that are asked for

void Prefetch(const uint8_t* bytes) {
#if defined(__GNUC__)
  __builtin_prefetch(bytes);
#else
  (void)bytes;
#endif
}

// The excess of pixel (x, y) of a view, whose outermost pixels go on beyond the picture.
void ReadExcessBeyond(const Window& window, int index, int32_t x, int32_t y, int16_t* rgb) {
  ReadExcess(ViewOf(window, index), Clamp(x, 0, window.picture_width - 1),
             Clamp(y, 0, window.picture_height - 1), rgb);
}

// The excess at a place of layer 0, with 2 * kShiftBits more.
void InterpolateExcess(const Window& window, int index, int32_t x, int32_t y, int32_t* sums) {
  const int32_t wx = x & (kShiftOne - 1), wy = y & (kShiftOne - 1);
  sums[0] = sums[1] = sums[2] = 0;
  for (int k = 0; k < 4; ++k) {
    const int32_t right = k & 1, below = k >> 1;
    const int32_t weight = (right != 0 ? wx : kShiftOne - wx) * (below != 0 ? wy : kShiftOne - wy);
    if (weight == 0) continue;
    int16_t rgb[3];
    ReadExcessBeyond(window, index, (x >> kShiftBits) + right, (y >> kShiftBits) + below, rgb);
    for (int c = 0; c < 3; ++c) sums[c] += rgb[c] * weight;
  }
}

int16_t RoundPlace(int32_t sum) {
  constexpr uint32_t kHalf = 1 << (2 * kShiftBits - 1);
  return static_cast<int16_t>((static_cast<uint32_t>(sum) + kHalf) >> (2 * kShiftBits));
}

// Triangular taps 1 2 1 and 1 2 3 4 3 2 1 of layers 1 and 2; each sums to 4^L.
constexpr int32_t Tap(int layer, int32_t k) { return (1 << layer) - Abs(k); }

// A view that is read inside the picture only.
struct Inside {
  const Plane<const uint8_t>& view;
  const int16_t* light;  // of codes

  const uint8_t* Row(int32_t y) const { return view.Row(y); }
  static int32_t Column(int32_t x) { return 3 * x; }  // bytes
};

// A view whose outermost pixels go on beyond the picture.
struct Endless {
  const Plane<const uint8_t>& view;
  const int16_t* light;   // of codes
  int32_t right, bottom;  // last column and row

  const uint8_t* Row(int32_t y) const { return view.Row(Clamp(y, 0, bottom)); }
  int32_t Column(int32_t x) const { return 3 * Clamp(x, 0, right); }  // bytes
};

Endless EndlessView(const Window& window, int index) {
  return {window.view[index], window.transfer->light, window.picture_width - 1,
          window.picture_height - 1};
}

// A small part of a view that a reader gives, as a picture of its own. Of pixels beyond the view's
// edges it has the outermost ones, so that it goes on beyond its own as the view does.
class Patch {
 public:
  static constexpr int32_t kMost = 1024;  // pixels

  // `rect`, of at most kMost pixels, may lie anywhere.
  Patch(const Window& window, int index, const Rect& rect) : light_(window.transfer->light) {
    x_ = Clamp(rect.x, 0, window.picture_width - 1);
    y_ = Clamp(rect.y, 0, window.picture_height - 1);
    width_ = Clamp(rect.x + rect.width, x_ + 1, window.picture_width) - x_;
    height_ = Clamp(rect.y + rect.height, y_ + 1, window.picture_height) - y_;
    codes_ = {pixels_, 3 * static_cast<size_t>(width_), 0, 0};
    for (int32_t row = 0; row < height_; ++row) {
      window.reader->Read(index, x_, y_ + row, width_,
                          pixels_ + 3 * static_cast<ptrdiff_t>(row) * width_);
    }
  }
  Patch(const Patch&) = delete;
  Patch& operator=(const Patch&) = delete;

  int32_t x() const { return x_; }  // of its first pixel, in the view
  int32_t y() const { return y_; }
  Endless Pixels() const { return {codes_, light_, width_ - 1, height_ - 1}; }

 private:
  const int16_t* light_;
  int32_t x_, y_, width_, height_;
  Plane<const uint8_t> codes_;
  uint8_t pixels_[3 * kMost];
};

// Calls take(k, sum) for the samples of `count` places, sum having 2 * kShiftBits. Steps of (dx,
// dy) pixels keep the weights of the four pixels around a place.
template <class Pixels, class Take>
void Interpolate(const Pixels& pixels, const CapturedLine& line, int32_t count, const Take& take) {
  const int32_t wx = line.x & (kShiftOne - 1), wy = line.y & (kShiftOne - 1);
  const int16_t* light = pixels.light;
  const int32_t upper_left = (kShiftOne - wx) * (kShiftOne - wy);
  const int32_t upper_right = wx * (kShiftOne - wy);
  const int32_t lower_left = (kShiftOne - wx) * wy, lower_right = wx * wy;
  int32_t column = line.x >> kShiftBits, row = line.y >> kShiftBits;
  for (int32_t p = 0; p < count; ++p, column += line.dx, row += line.dy) {
    const uint8_t *above = pixels.Row(row), *below = pixels.Row(row + 1);
    const int32_t left = pixels.Column(column), right = pixels.Column(column + 1);
    for (int k = 0; k < 3; ++k) {
      const int32_t sum =
          light[above[left + k]] * upper_left + light[above[right + k]] * upper_right +
          light[below[left + k]] * lower_left + light[below[right + k]] * lower_right;
      take(3 * p + k, Checked(ranges::kHolePixel, sum));
    }
  }
}

// Reads places that lie on rows or columns of pixels, as all but those of diagonals do.
template <class Pixels, class Take>
void InterpolateOnAxis(const Pixels& pixels, const CapturedLine& line, int32_t count,
                       const Take& take) {
  const int16_t* light = pixels.light;
  const int32_t wx = line.x & (kShiftOne - 1), weight = wx + (line.y & (kShiftOne - 1));
  int32_t column = line.x >> kShiftBits, row = line.y >> kShiftBits;
  for (int32_t p = 0; p < count; ++p, column += line.dx, row += line.dy) {
    const uint8_t* above = pixels.Row(row);
    const uint8_t* here = above + pixels.Column(column);
    const uint8_t* next =
        wx != 0 ? above + pixels.Column(column + 1) : pixels.Row(row + 1) + pixels.Column(column);
    for (int k = 0; k < 3; ++k) {
      const int32_t first = light[here[k]];
      const int32_t sum = first * kShiftOne + (light[next[k]] - first) * weight;
      take(3 * p + k, Checked(ranges::kHolePixel, sum * kShiftOne));
    }
  }
}

template <class Pixels, class Take>
void InterpolateLine(const Pixels& pixels, const CapturedLine& line, int32_t count,
                     const Take& take) {
  if (line.x % kShiftOne == 0 || line.y % kShiftOne == 0) {
    InterpolateOnAxis(pixels, line, count, take);
  } else {
    Interpolate(pixels, line, count, take);
  }
}

template <int kLayer, class Pixels>
void Subsample(const Pixels& pixels, int32_t x, int32_t y, int16_t* rgb) {
  constexpr int32_t kReach = (1 << kLayer) - 1;
  int32_t sums[3] = {0, 0, 0};
  for (int32_t dy = -kReach; dy <= kReach; ++dy) {
    const uint8_t* row = pixels.Row(y + dy);
    int32_t along[3] = {0, 0, 0};
    for (int32_t dx = -kReach; dx <= kReach; ++dx) {
      const uint8_t* from = row + pixels.Column(x + dx);
      for (int k = 0; k < 3; ++k) along[k] += Tap(kLayer, dx) * pixels.light[from[k]];
    }
    for (int k = 0; k < 3; ++k) sums[k] += Tap(kLayer, dy) * along[k];
  }
  for (int k = 0; k < 3; ++k) rgb[k] = static_cast<int16_t>(RoundShift(sums[k], 4 * kLayer));
}

template <int kLayer, class Pixels>
void SubsampleLine(const Pixels& pixels, const CapturedLine& line, int32_t count, int16_t* rgb) {
  for (int32_t p = 0; p < count; ++p, rgb += 3) {
    Subsample<kLayer>(pixels, line.x + line.dx * p, line.y + line.dy * p, rgb);
  }
}

// `line` is one of places at layer 0, else of whole pixels of the picture.
template <class Pixels>
void ReadLine(const Pixels& pixels, int layer, const CapturedLine& line, int32_t count,
              int16_t* rgb) {
  if (layer == 2) {
    SubsampleLine<2>(pixels, line, count, rgb);
    return;
  }
  if (layer == 1) {
    SubsampleLine<1>(pixels, line, count, rgb);
    return;
  }
  InterpolateLine(pixels, line, count, [&](int32_t k, int32_t sum) { rgb[k] = RoundPlace(sum); });
}

// Returns a line of a layer in the picture's pixels: the start, in 1 / kShiftOne of the layer's, is
// rounded once.
CapturedLine OfPicture(const CapturedLine& line, int layer) {
  const int bits = kShiftBits - layer;
  return {static_cast<int32_t>(RoundShift(line.x, bits)),
          static_cast<int32_t>(RoundShift(line.y, bits)), line.dx * (1 << layer),
          line.dy * (1 << layer)};
}

// The pixels that are read for `count` places of a line, which is one of ReadLine.
Rect PixelsOf(int layer, const CapturedLine& line, int32_t count) {
  const int32_t bits = layer == 0 ? kShiftBits : 0;
  const int32_t before = layer == 0 ? 0 : (1 << layer) - 1, after = layer == 0 ? 1 : before;
  const int32_t x = line.x >> bits, y = line.y >> bits;
  const int32_t across = line.dx * (count - 1), down = line.dy * (count - 1);
  return {x + Min(0, across) - before, y + Min(0, down) - before, Abs(across) + before + after + 1,
          Abs(down) + before + after + 1};
}

// ReadLine of views that a reader gives, patch by patch.
void ReadPatches(const Window& window, int index, CapturedLine line, int32_t count, int16_t* rgb) {
  const int layer = window.layer;
  const int32_t pixel = layer == 0 ? kShiftOne : 1;
  while (count > 0) {
    int32_t some = count;
    Rect rect = PixelsOf(layer, line, some);
    while (int64_t{rect.width} * rect.height > Patch::kMost) {
      some = (some + 1) / 2;
      rect = PixelsOf(layer, line, some);
    }
    const Patch patch(window, index, rect);
    ReadLine(patch.Pixels(), layer,
             {line.x - patch.x() * pixel, line.y - patch.y() * pixel, line.dx, line.dy}, some, rgb);
    line.x += line.dx * some * pixel;
    line.y += line.dy * some * pixel;
    count -= some;
    rgb += 3 * some;
  }
}

bool IsBright(const uint8_t* codes, int32_t pixels) {
  uint8_t brightest = 0;
  for (int32_t k = 0; k < 3 * pixels; ++k) brightest = codes[k] > brightest ? codes[k] : brightest;
  return brightest >= kFirstExcess;
}

// Whether some pixel is no highlight.
bool HasOthers(const uint8_t* codes, int32_t pixels) {
  uint8_t least = 255;
  for (int32_t n = 0; n < 3 * pixels; ++n) least = codes[n] < least ? codes[n] : least;
  if (least >= kFirstExcess) return false;
  for (int32_t p = 0; p < pixels; ++p) {
    if (!IsHighlight(codes + 3 * p)) return true;
  }
  return false;
}

// Whether test(codes, pixels) is true of a piece of some row of any view in `rect`, of which only
// what lies in the picture counts.
bool AnyPiece(const Window& window, const Rect& rect, bool (*test)(const uint8_t*, int32_t)) {
  const int32_t left = Clamp(rect.x, 0, window.picture_width - 1);
  const int32_t right = Clamp(rect.x + rect.width, left + 1, window.picture_width);
  const int32_t top = Clamp(rect.y, 0, window.picture_height - 1);
  const int32_t bottom = Clamp(rect.y + rect.height, top + 1, window.picture_height);
  uint8_t own[3 * Patch::kMost];
  for (int32_t y = top; y < bottom; ++y) {
    for (int32_t view = 0; view < window.views; ++view) {
      for (int32_t x = left; x < right; x += Patch::kMost) {
        const int32_t pixels = Min(Patch::kMost, right - x);
        const uint8_t* codes = own;
        if (window.reader != nullptr) {
          window.reader->Read(view, x, y, pixels, own);
        } else {
          codes = window.view[view].Row(y) + 3 * static_cast<ptrdiff_t>(x);
        }
        if (test(codes, pixels)) return true;
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
  const int layer = window.layer;
  if (window.lamp > 0) {
    for (int32_t p = 0; p < count; ++p, rgb += 3) {
      int32_t sums[3];
      InterpolateExcess(window, index, line.x + line.dx * p * kShiftOne,
                        line.y + line.dy * p * kShiftOne, sums);
      for (int c = 0; c < 3; ++c) rgb[c] = RoundPlace(sums[c]);
    }
    return;
  }
  const CapturedLine from = layer == 0 ? line : OfPicture(line, layer);
  if (window.reader != nullptr) {
    ReadPatches(window, index, from, count, rgb);
    return;
  }
  // Rows and columns that are read at the first and the last place.
  const int32_t x = layer == 0 ? line.x >> kShiftBits : from.x;
  const int32_t y = layer == 0 ? line.y >> kShiftBits : from.y;
  const int32_t end_x = x + from.dx * (count - 1), end_y = y + from.dy * (count - 1);
  const int32_t reach = layer == 0 ? 1 : (1 << layer) - 1;
  const int32_t right = window.picture_width - 1, bottom = window.picture_height - 1;
  if (Min(x, end_x) >= reach && Max(x, end_x) <= right - reach && Min(y, end_y) >= reach &&
      Max(y, end_y) <= bottom - reach) {
    ReadLine(Inside{window.view[index], window.transfer->light}, layer, from, count, rgb);
  } else {
    ReadLine(EndlessView(window, index), layer, from, count, rgb);
  }
}

void PrefetchCaptured(const Window& window, int index, const CapturedLine& line) {
  if (window.reader != nullptr) return;
  const CapturedLine from = OfPicture(line, window.layer);
  const Endless pixels = EndlessView(window, index);
  const int32_t ahead = from.y + (kRowsAhead << window.layer);
  Prefetch(pixels.Row(ahead) + pixels.Column(from.x));
  Prefetch(pixels.Row(ahead + 1) + pixels.Column(from.x));
}

void InterpolateCaptured(const Window& window, int index, int32_t x, int32_t y, int32_t* rgb) {
  if (window.lamp > 0) {
    InterpolateExcess(window, index, x, y, rgb);
    return;
  }
  const auto take = [&](int32_t k, int32_t sum) { rgb[k] = sum; };
  const CapturedLine place = {Checked(ranges::kHolePosition, x), Checked(ranges::kHolePosition, y),
                              0, 0};
  if (window.reader == nullptr) {
    InterpolateLine(EndlessView(window, index), place, 1, take);
    return;
  }
  const Patch patch(window, index, PixelsOf(0, place, 1));
  InterpolateLine(patch.Pixels(), {x - patch.x() * kShiftOne, y - patch.y() * kShiftOne, 0, 0}, 1,
                  take);
}

int32_t CapturedBytes(const Window& window) {
  const int32_t taps = window.layer == 0 ? 2 : 2 * (1 << window.layer) - 1;
  return 3 * taps * taps;
}

bool MayHaveHighlights(const Window& window, const Rect& rect) {
  return AnyPiece(window, rect, IsBright);
}

bool AreAllHighlights(const Window& window, const Rect& rect) {
  return !AnyPiece(window, rect, HasOthers);
}

}  // namespace starfocus
