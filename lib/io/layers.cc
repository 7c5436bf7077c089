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

// A row of the centre view, as codes.
struct CodeRow {
  const uint8_t* codes;
  const simd::Encoding& transfer;

  void Part(const Kernels& kernels, int32_t first, int32_t pairs, int16_t* even,
            int16_t* odd) const {
    kernels.WidenPhases(codes + 6 * first, static_cast<size_t>(pairs), transfer, even, odd);
  }
  int16_t Sample(int32_t n) const { return transfer.samples[codes[n]]; }
};

// A row of samples of a layer.
struct SampleRow {
  const int16_t* samples;

  void Part(const Kernels& kernels, int32_t first, int32_t pairs, int16_t* even,
            int16_t* odd) const {
    kernels.SplitPhases(samples + 6 * first, static_cast<size_t>(pairs), even, odd);
  }
  int16_t Sample(int32_t n) const { return samples[n]; }
};

// Splits a row of `width` pixels into even and odd pixels. Pixels outside the row repeat the first
// or last pixel of the row.
template <class Row>
void PartLine(const Kernels& kernels, const Row& row, int32_t width, const Range& pairs,
              const ResampleScratch& phases) {
  const int32_t first = Max(pairs.first, 0), last = Min(pairs.last, width / 2);
  const int32_t left = first - pairs.first, right = last - pairs.first;
  row.Part(kernels, first, last - first, phases.even + 3 * left, phases.odd + 3 * left);
  const auto repeat = [&](int32_t pixel, int32_t from, int32_t to) {
    for (int32_t n = 3 * from; n < 3 * to; n += 3) {
      for (int32_t c = 0; c < 3; ++c) {
        phases.even[n + c] = phases.odd[n + c] = row.Sample(3 * pixel + c);
      }
    }
  };
  repeat(0, 0, left);
  repeat(width - 1, right, pairs.last - pairs.first);
}

// Filters along columns. `half` contains packed rows that start at row 2 * rows.first - 3 of the
// source. Rows outside the source repeat the edge rows.
void HalveRows(const Kernels& kernels, const int16_t* half, const Range& columns,
               const LayerPlane& to) {
  const size_t count = SamplesOf(columns);
  half += 3 * count;
  for (int32_t y = to.rows.first; y < to.rows.last; ++y, half += 2 * count) {
    int16_t* samples = to.samples.Row(y) + 3 * columns.first;
    kernels.FilterHalfBand(half, static_cast<ptrdiff_t>(count), kDownFilter, count, 0, kLayerWhite,
                           samples);
    CheckAll(ranges::kLayerSample, samples, count);
  }
}

// Subsamples a plane of width x height pixels: first along all rows that `to` depends on, then
// along columns.
template <class RowAt>
void Downsample(const Kernels& kernels, const RowAt& row_at, int32_t width, int32_t height,
                const Range& columns, const ResampleScratch& scratch, const LayerPlane& to) {
  const Range pairs = PairsOf(columns);
  const size_t count = SamplesOf(columns);
  int16_t* half = scratch.half;
  for (int32_t y = 2 * to.rows.first - 3; y < 2 * to.rows.last + 2; ++y, half += count) {
    PartLine(kernels, row_at(Clamp(y, 0, height - 1)), width, pairs, scratch);
    kernels.Halve(scratch.even + 6, scratch.odd + 6, kDownFilter, count, half);
    CheckAll(ranges::kFilteredAlongX, half, count);
  }
  HalveRows(kernels, scratch.half, columns, to);
}

void DownsampleOnce(const Kernels& kernels, const Input& picture, const Range& columns,
                    const ResampleScratch& scratch, const LayerPlane& to) {
  const auto row = [&](int32_t y) { return CodeRow{picture.centre.Row(y), *picture.transfer}; };
  Downsample(kernels, row, picture.width, picture.height, columns, scratch, to);
}

void DownsampleTwice(const Kernels& kernels, const Input& picture, const Range& columns,
                     const ResampleScratch& scratch, const LayerPlane& to) {
  const int32_t width = LayerSize(picture.width, 1);
  const int32_t height = LayerSize(picture.height, 1);
  const Range pairs = PairsOf(columns);
  const Range wanted = {Max(2 * pairs.first, 0), Min(2 * pairs.last, width)};
  LayerPlane above;
  above.rows = {Max(2 * to.rows.first - 3, 0), Min(2 * to.rows.last + 2, height)};
  above.samples = {scratch.above - 3 * wanted.first, SamplesOf(wanted), 0, above.rows.first};
  DownsampleOnce(kernels, picture, wanted, scratch, above);
  const auto row = [&](int32_t y) { return SampleRow{above.samples.Row(y)}; };
  Downsample(kernels, row, width, height, columns, scratch, to);
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

void DownsampleLayer(const Kernels& kernels, const LayerPlane& from, const Range& columns,
                     const ResampleScratch& scratch, const LayerPlane& to) {
  const auto row = [&](int32_t y) { return SampleRow{from.samples.Row(y)}; };
  Downsample(kernels, row, from.width, from.height, columns, scratch, to);
}

void DownsamplePicture(const Kernels& kernels, const Input& picture, int32_t layer,
                       const Range& columns, const ResampleScratch& scratch, const LayerPlane& to) {
  if (layer == 1) {
    DownsampleOnce(kernels, picture, columns, scratch, to);
  } else {
    DownsampleTwice(kernels, picture, columns, scratch, to);
  }
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
