// SPDX-License-Identifier: Apache-2.0
// The kernel that blurs by gathering: each pixel becomes the weighted mean of a disc around it.
#ifndef STARFOCUS_SIMD_DISC_H_
#define STARFOCUS_SIMD_DISC_H_

#include <cstddef>
#include <cstdint>

#include "simd/light.h"
#include "simd/resample.h"

namespace starfocus::simd {

// A filter over pixels that is symmetric about both axes and both diagonals, so that an octant
// tells all of it: the weight of the pixel m columns and n rows away, 0 <= m <= n <= size, is
// weights[n (n + 1) / 2 + m]. All weights of the disc together sum to 2^bits at most; those of four
// pixels that mirror each other on both axes, or of two on an axis, sum to 32767 at most.
struct Disc {
  int32_t size;  // [0, kMaxDisc]
  int bits;      // [1, 17]
  const uint16_t* weights;
};
inline constexpr int32_t kMaxDisc = 12;

namespace reference {

// out[y][n] is the code of the disc's weighted sum around the light in[y][n] (R, G and B each by
// itself), divided by 2^bits and rounded halves up to light, or to the code where light is the code
// itself, for each sample of `in`. Light of
// pixels that mirror each other is weighed together: the mean of the two above each other, and that
// of two such means, each rounded halves up. out_stride is in bytes. `in` is
// read as far around as the disc reaches: disc.size rows, and three times as many samples, on each
// side. `in` and `out` don't overlap, and nothing between the rows of `out` is written.
void FilterDisc(const SampleRows& in, const Disc& disc, const Encoding& encoding, uint8_t* out,
                size_t out_stride);

// Filters rows of a layer as FilterDisc filters those of the picture, but for what it writes:
// out[y][n] is the sum as a sample of kLayerBits, rounded halves up; out_stride is in samples. The
// light is that of samples in range.
void FilterDiscLayer(const SampleRows& in, const Disc& disc, int16_t* out, size_t out_stride);

// Filters rows by two discs at once, each of which gives what FilterDiscLayer gives; `less` is no
// larger than `more`.
void FilterTwoDiscs(const SampleRows& in, const Disc& less, const Disc& more, int16_t* out_less,
                    int16_t* out_more, size_t out_stride);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_DISC_H_
