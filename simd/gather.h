// SPDX-License-Identifier: Apache-2.0
// SIMD kernels of the blur by gathering. Each output pixel is the weighted mean of a disc of input
// pixels. If the blur changes across a picture, a kernel interpolates between a picture with less
// blur and a picture with more blur, and another kernel moves a picture by fractions of a pixel.
// Accumulate adds spans of samples that are moved by a fraction of a pixel; mode blur and the line
// scan use it.
#ifndef STARFOCUS_SIMD_GATHER_H_
#define STARFOCUS_SIMD_GATHER_H_

#include <cstddef>
#include <cstdint>

#include "simd/light.h"
#include "simd/resample.h"
#include "simd/samples.h"

namespace starfocus::simd {

// A filter that is symmetric about both axes and both diagonals, so that one octant defines the
// filter. The weight of the pixel m columns and n rows away, 0 <= m <= n <= size, is weights[n (n +
// 1) / 2 + m]. The weights of the whole disc sum to at most 2^bits. The weights of four pixels that
// mirror each other about both axes sum to at most 32767. The weights of two mirrored pixels on an
// axis sum to at most 32767 as well.
struct Disc {
  int32_t size;  // Radius of the disc in pixels, [0, kMaxDisc].
  int bits;      // Fractional bits of the weights, [1, 17].
  const uint16_t* weights;
};
inline constexpr int32_t kMaxDisc = 12;

// Half of the movement of a picture along rows and along columns, in pixels with 15 fractional
// bits. Both values are in (-1, 1).
struct HalfMove {
  int16_t across, down;
};

// A span of samples with interleaved R, G and B, which come from one source surface and go to one
// line. The value of sample n is weight * source[n] + neighbour_weight * source[n +
// neighbour_offset].
struct Span {
  const int16_t* source;  // Light of the source surface (light.h).
  uint32_t target;        // Index of the first sample in the target line.
  uint32_t samples;       // Number of samples, > 0.
  uint16_t weight;        // Weight of the sample itself, [0, 32767].
  uint16_t
      neighbour_weight;  // Weight of the neighbour, [0, 32767]; 0 if the neighbour is not used.
  // Distance in samples to the neighbour; a multiple of 3, mostly +3 or -3.
  int32_t neighbour_offset;
};

namespace reference {

// Returns the weighted sum of the disc around sample n of a row.
inline uint32_t DiscSum(const SampleRows& in, size_t row, size_t n, const Disc& disc) {
  const auto stride = static_cast<ptrdiff_t>(in.stride);
  const int16_t* at = in.samples + row * in.stride + n;
  uint32_t sum = 0;
  for (int32_t y = 0; y <= disc.size; ++y) {
    for (int32_t x = 0; x <= disc.size; ++x) {
      const int32_t high = x > y ? x : y, low = x > y ? y : x;
      const auto column = [&](int32_t pixel) {
        const int16_t* sample = at + 3 * ptrdiff_t{pixel};
        const ptrdiff_t down = y * stride;
        return Mean(sample[-down], sample[down]);
      };
      const int32_t pixels = (x > 0 ? 2 : 1) * (y > 0 ? 2 : 1);
      const int32_t weight = pixels * disc.weights[high * (high + 1) / 2 + low];
      sum += static_cast<uint32_t>(weight * Mean(column(-x), column(x)));
    }
  }
  return sum;
}

// Converts the weighted sum of a disc to light. Rounding removes the `dropped` lowest bits of the
// light.
inline int32_t LightOf(uint32_t sum, const Disc& disc, int dropped) {
  const int bits = disc.bits + dropped;
  return static_cast<int32_t>((sum + (uint32_t{1} << bits >> 1)) >> bits);
}

// Filters each sample of `in`. R, G and B are filtered separately. Output out[y][n] is the 8-bit
// code of the mean light around in[y][n]: the sum of the light, weighted by the disc, is divided by
// 2^bits. The quotient is rounded half up to an integer, or to a whole code if encoding.entries is
// null.
//
// Pixels that mirror each other are averaged before the multiplication by their weight. First, the
// two mirrored pixels of each column are averaged. Then the means of two mirrored columns are
// averaged. Each mean is rounded half up.
//
// The unit of out_stride is one byte. The filter reads disc.size rows and 3 disc.size samples
// beyond `in` on each side. `in` and `out` must not overlap. Bytes between the rows of `out` are
// not written.
STARFOCUS_REFERENCE void FilterDisc(const SampleRows& in, const Disc& disc,
                                    const Encoding& encoding, uint8_t* out, size_t out_stride) {
  // Number of fractional bits of the light that rounding removes before the light is encoded.
  const int whole = encoding.entries == nullptr ? kLightBits : 0;
  for (size_t row = 0; row < in.rows; ++row, out += out_stride) {
    for (size_t n = 0; n < in.count; ++n) {
      const uint32_t sum = DiscSum(in, row, n, disc);
      const auto light = static_cast<int16_t>(LightOf(sum, disc, whole) << whole);
      Encode(&light, 1, encoding, out + n);
    }
  }
}

// Filters rows of a layer like FilterDisc. Output out[y][n] is the weighted sum, converted to a
// sample of a layer (kLayerBits) and rounded half up. The unit of out_stride is one sample. All
// input samples must be in the valid range.
STARFOCUS_REFERENCE void FilterDiscLayer(const SampleRows& in, const Disc& disc, int16_t* out,
                                         size_t out_stride) {
  for (size_t row = 0; row < in.rows; ++row, out += out_stride) {
    for (size_t n = 0; n < in.count; ++n) {
      const uint32_t sum = DiscSum(in, row, n, disc);
      out[n] = static_cast<int16_t>(LightOf(sum, disc, kLightBits - kLayerBits));
    }
  }
}

// Filters rows with two discs at once. Each output is equal to the output of FilterDiscLayer.
// The disc `less` must not be larger than the disc `more`.
STARFOCUS_REFERENCE void FilterTwoDiscs(const SampleRows& in, const Disc& less, const Disc& more,
                                        int16_t* out_less, int16_t* out_more, size_t out_stride) {
  FilterDiscLayer(in, less, out_less, out_stride);
  FilterDiscLayer(in, more, out_more, out_stride);
}

// MixSamples and MoveSamples read and write rows in whole groups of kSliceLanes.

// Sets out[n] to less[n] + mix[n] (more[n] - less[n]), with mix[n] in [0, 1] and 15 fractional
// bits. The product is rounded half up. Samples must be in the valid range of resample.h.
STARFOCUS_REFERENCE void MixSamples(const int16_t* less, const int16_t* more, const int16_t* mix,
                                    size_t count, int16_t* out) {
  for (size_t n = 0; n < SliceSamples(count); ++n) {
    out[n] = static_cast<int16_t>(less[n] + Product15(more[n] - less[n], mix[n]));
  }
}

// Moves rows of samples with interleaved R, G and B, by adding the scalar product of `move` and the
// gradient. Output out[y][n] is
//   in[y][n] + across (in[y][n + 3] - in[y][n - 3]) + down (in[y + 1][n] - in[y - 1][n]).
// Each product is rounded half up, each difference and sum is saturated to 16 bits, and the
// result is clamped to the valid range. MoveSamples reads one more row above and below `in`, and
// one more pixel to the left and right of `in`. The unit of out_stride is one sample. `in` and
// `out` must not overlap.
STARFOCUS_REFERENCE void MoveSamples(const SampleRows& in, const HalfMove& move, int16_t* out,
                                     size_t out_stride) {
  const int16_t* row = in.samples;
  for (size_t y = 0; y < in.rows; ++y, row += in.stride, out += out_stride) {
    const int16_t *above = row - in.stride, *below = row + in.stride;
    for (size_t n = 0; n < SliceSamples(in.count); ++n) {
      const int16_t *left = row + n - 3, *right = row + n + 3;
      const int16_t across = Product15(Saturated(*right - *left), move.across);
      const int16_t down = Product15(Saturated(below[n] - above[n]), move.down);
      const int16_t value = Saturated(Saturated(row[n] + across) + down);
      out[n] = value < 0 ? int16_t{0} : value > kLayerWhite ? kLayerWhite : value;
    }
  }
}

// SourceOf returns sample n of the source, and NeighbourOf the neighbour of sample n.
inline int32_t SourceOf(const Span& span, uint32_t n) { return span.source[n]; }

inline int32_t NeighbourOf(const Span& span, uint32_t n) {
  return span.source[static_cast<ptrdiff_t>(n) + span.neighbour_offset];
}

inline uint32_t SpanValue(const Span& span, uint32_t n) {
  uint32_t value = uint32_t{span.weight} * static_cast<uint32_t>(SourceOf(span, n));
  if (span.neighbour_weight != 0) {
    value += uint32_t{span.neighbour_weight} * static_cast<uint32_t>(NeighbourOf(span, n));
  }
  return value;
}

// Adds value n of each span to accumulators[target + n]. Sums must not exceed 2^32 - 1.
STARFOCUS_REFERENCE void Accumulate(const Span* spans, size_t count, uint32_t* accumulators) {
  for (size_t i = 0; i < count; ++i) {
    for (uint32_t n = 0; n < spans[i].samples; ++n) {
      accumulators[spans[i].target + n] += SpanValue(spans[i], n);
    }
  }
}

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_GATHER_H_
