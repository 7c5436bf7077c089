// SPDX-License-Identifier: Apache-2.0
#include "lib/io/layers.h"

#include <cstring>

namespace starfocus {
namespace {

using simd::Kernels;
using simd::kLayerWhite;

// Returns the pairs of pixels of a line that the filter reads for some columns of the layer. Pair k
// consists of pixels 2 k and 2 k + 1.
Range PairsOf(const Range& columns) { return {columns.first - 2, columns.last + 1}; }

size_t SamplesOf(const Range& columns) {
  return 3 * static_cast<size_t>(columns.last - columns.first);
}

// Returns the sample of a layer for light, rounded half up.
int16_t SampleOf(int16_t light) {
  return static_cast<int16_t>((light + 1) >> (kLightBits - simd::kLayerBits));
}

// Splits `pairs` pairs of pixels of row y of the centre view's light, from pair `first` on.
void SplitLight(const Input& picture, int32_t y, int32_t first, int32_t pairs, int16_t* even,
                int16_t* odd) {
  constexpr int32_t kPairs = 32;
  int16_t rgb[6 * kPairs + simd::kPadding / sizeof(int16_t)];
  for (int32_t n = 0; n < pairs; n += kPairs) {
    const int32_t some = Min(kPairs, pairs - n);
    picture.Light(0, 2 * (first + n), y, 2 * some, rgb);
    for (int32_t k = 0; k < some; ++k) {
      for (int32_t c = 0; c < 3; ++c) {
        even[3 * (n + k) + c] = SampleOf(rgb[6 * k + c]);
        odd[3 * (n + k) + c] = SampleOf(rgb[6 * k + 3 + c]);
      }
    }
  }
}

// Rows to subsample: of a layer or, if `layer` is null, of the centre view of `picture`.
struct SourceRows {
  const Kernels& kernels;
  const Input* picture;
  const LayerPlane* layer;
  int32_t width, height;

  // Splits pairs of pixels inside row y, from pair `first` on.
  void Split(int32_t y, int32_t first, size_t pairs, int16_t* even, int16_t* odd) const {
    if (layer != nullptr) {
      kernels.DeinterleavePhases(layer->samples.Row(y) + 6 * first, pairs, even, odd);
    } else if (picture->reads_codes) {
      kernels.WidenPhases(picture->centre.Row(y) + 6 * first, pairs, *picture->transfer, even, odd);
    } else {
      SplitLight(*picture, y, first, static_cast<int32_t>(pairs), even, odd);
    }
  }
  // Reads the samples of a pixel of row y.
  void Read(int32_t y, int32_t x, int16_t* rgb) const {
    int16_t light[3 + simd::kPadding / sizeof(int16_t)];
    const bool reads_light = layer == nullptr && !picture->reads_codes;
    if (reads_light) picture->Light(0, x, y, 1, light);
    for (int32_t c = 0; c < 3; ++c) {
      rgb[c] = layer != nullptr ? layer->samples.Row(y)[3 * x + c]
               : reads_light    ? SampleOf(light[c])
                                : picture->transfer->samples[picture->centre.Row(y)[3 * x + c]];
    }
  }
};

// Splits row y of a plane into even and odd pixels. Pixels outside the row repeat the first or last
// pixel of the row.
void SplitLine(const SourceRows& rows, int32_t y, const Range& pairs,
               const ResampleScratch& phases) {
  const int32_t first = Max(pairs.first, 0), last = Min(pairs.last, rows.width / 2);
  const int32_t left = first - pairs.first, right = last - pairs.first;
  rows.Split(y, first, static_cast<size_t>(last - first), phases.even + 3 * left,
             phases.odd + 3 * left);
  const auto repeat = [&](int32_t pixel, int32_t from, int32_t to) {
    int16_t rgb[3];
    if (from < to) rows.Read(y, pixel, rgb);
    for (int32_t n = 3 * from; n < 3 * to; n += 3) {
      for (int32_t c = 0; c < 3; ++c) phases.even[n + c] = phases.odd[n + c] = rgb[c];
    }
  };
  repeat(0, 0, left);
  repeat(rows.width - 1, right, pairs.last - pairs.first);
}

// Subsamples a plane: first along all rows that `to` depends on, then along columns. Rows outside
// the plane repeat its edge rows.
void Downsample(const SourceRows& from, const simd::HalfBand& filter, const Range& columns,
                const ResampleScratch& scratch, const LayerPlane& to) {
  const Kernels& kernels = from.kernels;
  const Range pairs = PairsOf(columns);
  const size_t count = SamplesOf(columns);
  int16_t* half = scratch.half;
  for (int32_t y = 2 * to.rows.first - 3; y < 2 * to.rows.last + 2; ++y, half += count) {
    SplitLine(from, Clamp(y, 0, from.height - 1), pairs, scratch);
    kernels.Halve(scratch.even + 6, scratch.odd + 6, filter, count, half);
    CheckAll(ranges::kFilteredAlongX, half, count);
  }
  half = scratch.half + 3 * count;
  for (int32_t y = to.rows.first; y < to.rows.last; ++y, half += 2 * count) {
    int16_t* samples = to.samples.Row(y) + 3 * columns.first;
    kernels.FilterHalfBand(half, static_cast<ptrdiff_t>(count), filter, count, 0, kLayerWhite,
                           samples);
    CheckAll(ranges::kLayerSample, samples, count);
  }
}

// Returns the filter for layers of the centre view of `in`. Excess is that of small lamps, at which
// the negative taps of kDownFilter would be clamped, and the lamps become brighter.
const simd::HalfBand& FilterOf(const Input& in) {
  static constexpr simd::HalfBand kTriangle = {1 << (simd::kTapBits - 1), 1 << (simd::kTapBits - 2),
                                               0};
  return in.is_excess ? kTriangle : kDownFilter;
}

// Writes `width` pixels alternately from `even` and `odd`. Four samples are copied per pixel, which
// takes one move instead of two. The next pixel overwrites the fourth sample.
void Interleave(const int16_t* even, const int16_t* odd, int32_t width, int16_t* out) {
  for (int32_t x = 0; x + 1 < width; x += 2, even += 3, odd += 3, out += 6) {
    std::memcpy(out, even, 4 * sizeof(*out));
    std::memcpy(out + 3, odd, 4 * sizeof(*out));
  }
  if (width % 2 != 0) std::memcpy(out, even, 3 * sizeof(*out));
}

}  // namespace

void DownsampleLayer(const Kernels& kernels, const LayerPlane& from, const simd::HalfBand& filter,
                     const Range& columns, const ResampleScratch& scratch, const LayerPlane& to) {
  Downsample({kernels, nullptr, &from, from.width, from.height}, filter, columns, scratch, to);
}

void DownsamplePicture(const Kernels& kernels, const Input& picture, int32_t layer,
                       const Range& columns, const ResampleScratch& scratch, const LayerPlane& to) {
  if (layer == 1) {
    const SourceRows rows = {kernels, &picture, nullptr, picture.width, picture.height};
    return Downsample(rows, FilterOf(picture), columns, scratch, to);
  }
  const Range pairs = PairsOf(columns);
  LayerPlane one;  // the part of layer 1 on which the columns of layer 2 depend
  one.width = LayerSize(picture.width, 1);
  one.height = LayerSize(picture.height, 1);
  one.rows = {Max(2 * to.rows.first - 3, 0), Min(2 * to.rows.last + 2, one.height)};
  const Range wanted = {Max(2 * pairs.first, 0), Min(2 * pairs.last, one.width)};
  one.samples = {scratch.above - 3 * wanted.first, SamplesOf(wanted), 0, one.rows.first};
  DownsamplePicture(kernels, picture, 1, wanted, scratch, one);
  DownsampleLayer(kernels, one, FilterOf(picture), columns, scratch, to);
}

void UpsampleByTwo(const Kernels& kernels, const LayerRect& in, int32_t first,
                   const UpsampleScratch& scratch, const LayerRect& out) {
  const size_t count = 3 * static_cast<size_t>(in.width);
  for (int32_t y = 0; y < out.height; ++y) {
    const int16_t* line = in.samples + static_cast<size_t>(first + (y >> 1)) * count;
    if (y % 2 == 1) {
      kernels.Between(line, static_cast<ptrdiff_t>(count), kUpFilter, count, INT16_MIN, INT16_MAX,
                      scratch.line);
      CheckAll(ranges::kUpsampledAlongY, scratch.line, count);
      line = scratch.line;
    }
    line += 3 * first;
    kernels.Between(line, 3, kUpFilter, 3 * static_cast<size_t>(out.width / 2), 0, kLayerWhite,
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
