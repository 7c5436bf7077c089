// SPDX-License-Identifier: Apache-2.0
// SIMD kernels that blur by gathering: each output pixel is the weighted mean of a disc of input
// pixels.
#ifndef STARFOCUS_SIMD_DISC_H_
#define STARFOCUS_SIMD_DISC_H_

#include <cstddef>
#include <cstdint>

#include "simd/light.h"
#include "simd/resample.h"

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

namespace reference {

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
void FilterDisc(const SampleRows& in, const Disc& disc, const Encoding& encoding, uint8_t* out,
                size_t out_stride);

// Filters rows of a layer like FilterDisc. Output out[y][n] is the weighted sum, converted to a
// sample of a layer (kLayerBits) and rounded half up. The unit of out_stride is one sample. All
// input samples must be in the valid range.
void FilterDiscLayer(const SampleRows& in, const Disc& disc, int16_t* out, size_t out_stride);

// Filters rows with two discs at once. Each output is equal to the output of FilterDiscLayer.
// The disc `less` must not be larger than the disc `more`.
void FilterTwoDiscs(const SampleRows& in, const Disc& less, const Disc& more, int16_t* out_less,
                    int16_t* out_more, size_t out_stride);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_DISC_H_
