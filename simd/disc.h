// SPDX-License-Identifier: Apache-2.0
// SIMD kernels that blur by gathering: each pixel becomes the weighted mean of a disc around it.
#ifndef STARFOCUS_SIMD_DISC_H_
#define STARFOCUS_SIMD_DISC_H_

#include <cstddef>
#include <cstdint>

#include "simd/light.h"
#include "simd/resample.h"

namespace starfocus::simd {

// A filter that is symmetric about both axes and both diagonals, so that one octant defines it. The
// weight of the pixel m columns and n rows away, 0 <= m <= n <= size, is weights[n (n + 1) / 2 +
// m]. All weights of the disc together sum to at most 2^bits. The weights of four pixels that
// mirror each other on both axes, or of two on an axis, sum to at most 32767.
struct Disc {
  int32_t size;  // [0, kMaxDisc]
  int bits;      // [1, 17]
  const uint16_t* weights;
};
inline constexpr int32_t kMaxDisc = 12;

namespace reference {

// Computes out[y][n] for each sample of `in`: the code of the disc's weighted sum of light around
// in[y][n], divided by 2^bits. R, G and B are separate. The sum is rounded halves up to light, or
// to the code if light is the code itself.
//
// Pixels that mirror each other are averaged before they are weighted: first the two pixels above
// each other, then two such means, each rounded halves up.
//
// out_stride is in bytes. `in` is read as far around as the disc reaches: disc.size rows, and three
// times as many samples, on each side. `in` and `out` do not overlap, and nothing between the rows
// of `out` is written.
void FilterDisc(const SampleRows& in, const Disc& disc, const Encoding& encoding, uint8_t* out,
                size_t out_stride);

// Filters rows of a layer like FilterDisc. out[y][n] is the sum as a sample of kLayerBits, rounded
// halves up; out_stride is in samples. The light must be that of samples in range.
void FilterDiscLayer(const SampleRows& in, const Disc& disc, int16_t* out, size_t out_stride);

// Filters rows by two discs at once. Each output equals that of FilterDiscLayer. `less` is at most
// as large as `more`.
void FilterTwoDiscs(const SampleRows& in, const Disc& less, const Disc& more, int16_t* out_less,
                    int16_t* out_more, size_t out_stride);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_DISC_H_
