#include "lib/layers.h"

#include <cstring>

namespace starfocus {
namespace {

using simd::Kernels;
using simd::kLayerWhite;

// Positions [2 begin - 3, 2 end + 2) of a line, those outside [0, size) repeating the edge.
struct Taps {
  int32_t begin, end, size;
  int32_t First() const { return 2 * begin - 3; }
  int32_t Count() const { return 2 * (end - begin) + 5; }
};

// Filters a line of pixels, whose first is taps.First(), along x and keeps every second.
void HalveLine(const Kernels& kernels, const Taps& taps, const ResampleScratch& scratch,
               int16_t* out) {
  const int32_t pixels = taps.end - taps.begin;
  kernels.half_band(scratch.line + 9, 3, kDownFilter, 3 * static_cast<size_t>(2 * pixels - 1),
                    INT16_MIN, INT16_MAX, scratch.filtered);
  CheckAll(ranges::kFilteredAlongX, scratch.filtered, 3 * static_cast<size_t>(2 * pixels - 1));
  for (int32_t x = 0; x < pixels; ++x) {
    std::memcpy(out + 3 * x, scratch.filtered + 6 * x, 3 * sizeof(int16_t));
  }
}

// Repeats the edge pixels of scratch.line where taps leave the picture.
template <class Load>
void LoadLine(const Taps& taps, int16_t* line, const Load& load) {
  const int32_t first = Max(taps.First(), 0);
  const int32_t last = Min(taps.First() + taps.Count(), taps.size);
  load(first, last, line + 3 * (first - taps.First()));
  for (int32_t x = taps.First(); x < first; ++x) {
    std::memcpy(line + 3 * (x - taps.First()), line + 3 * (first - taps.First()),
                3 * sizeof(int16_t));
  }
  for (int32_t x = last; x < taps.First() + taps.Count(); ++x) {
    std::memcpy(line + 3 * (x - taps.First()), line + 3 * (last - 1 - taps.First()),
                3 * sizeof(int16_t));
  }
}

// The vertical pass: `to->half` holds the rows from 2 * rows.first - 3 on, the picture's edge rows
// repeated.
void HalveRows(const Kernels& kernels, int32_t begin, int32_t end, LayerPlane* to) {
  const size_t count = 3 * static_cast<size_t>(end - begin);
  for (int32_t y = to->rows.first; y < to->rows.last; ++y) {
    const int16_t* in = to->half.Row(2 * y) + 3 * begin;
    int16_t* samples = to->samples.Row(y) + 3 * begin;
    kernels.half_band(in, static_cast<ptrdiff_t>(to->half.stride), kDownFilter, count, 0,
                      kLayerWhite, samples);
    CheckAll(ranges::kLayerSample, samples, count);
    kernels.narrow(samples, count, to->rgb.Row(y) + 3 * begin);
  }
}

// Runs load(y, first, last, line), which writes pixels [first, last) of row y as samples, over all
// rows that the layer's rows are made of.
template <class Load>
void Downsample(const Kernels& kernels, int32_t width, int32_t height, int32_t begin, int32_t end,
                const ResampleScratch& scratch, const Load& load, LayerPlane* to) {
  const Taps taps = {begin, end, width};
  for (int32_t y = 2 * to->rows.first - 3; y < 2 * to->rows.last + 2; ++y) {
    const int32_t row = Clamp(y, 0, height - 1);
    LoadLine(taps, scratch.line,
             [&](int32_t first, int32_t last, int16_t* line) { load(row, first, last, line); });
    HalveLine(kernels, taps, scratch, to->half.Row(y) + 3 * begin);
  }
  HalveRows(kernels, begin, end, to);
}

// Pixels of `even` and `odd` in turn, `width` in all. Copies a fourth sample of each, which the
// next pixel overwrites: one move instead of two.
void Interleave(const int16_t* even, const int16_t* odd, int32_t width, int16_t* out) {
  for (int32_t x = 0; x + 1 < width; x += 2, even += 3, odd += 3, out += 6) {
    std::memcpy(out, even, 4 * sizeof(*out));
    std::memcpy(out + 3, odd, 4 * sizeof(*out));
  }
  if (width % 2 != 0) std::memcpy(out, even, 3 * sizeof(*out));
}

}  // namespace

void DownsamplePicture(const Kernels& kernels, const Plane<const uint8_t>& from, int32_t width,
                       int32_t height, int32_t begin, int32_t end, const ResampleScratch& scratch,
                       LayerPlane* to) {
  Downsample(
      kernels, width, height, begin, end, scratch,
      [&](int32_t y, int32_t first, int32_t last, int16_t* line) {
        kernels.widen(from.Row(y) + 3 * first, 3 * static_cast<size_t>(last - first), line);
      },
      to);
}

void DownsampleLayer(const Kernels& kernels, const LayerPlane& from, int32_t begin, int32_t end,
                     const ResampleScratch& scratch, LayerPlane* to) {
  Downsample(
      kernels, from.width, from.height, begin, end, scratch,
      [&](int32_t y, int32_t first, int32_t last, int16_t* line) {
        std::memcpy(line, from.samples.Row(y) + 3 * first,
                    3 * static_cast<size_t>(last - first) * sizeof(int16_t));
      },
      to);
}

void UpsampleByTwo(const Kernels& kernels, const LayerRect& in, int32_t first,
                   const UpsampleScratch& scratch, const LayerRect& out) {
  const size_t count = 3 * static_cast<size_t>(in.width);
  for (int32_t y = 0; y < out.height; ++y) {
    const int16_t* line = in.samples + static_cast<size_t>(first + (y >> 1)) * count;
    if (y % 2 == 1) {
      kernels.between(line, static_cast<ptrdiff_t>(count), kUpFilter, count, INT16_MIN, INT16_MAX,
                      scratch.line);
      CheckAll(ranges::kUpsampledAlongY, scratch.line, count);
      line = scratch.line;
    }
    line += 3 * first;
    kernels.between(line, 3, kUpFilter, 3 * static_cast<size_t>(out.width / 2), 0, kLayerWhite,
                    scratch.between);
    const int32_t pairs = (out.width + 1) / 2;
    for (int32_t n = 0; n < 3 * pairs; ++n) {
      scratch.even[n] = static_cast<int16_t>(Clamp(line[n], 0, kLayerWhite));
    }
    Interleave(scratch.even, scratch.between, out.width,
               out.samples + 3 * static_cast<size_t>(y) * static_cast<size_t>(out.width));
  }
}

}  // namespace starfocus
