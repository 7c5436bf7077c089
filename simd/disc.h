// SPDX-License-Identifier: Apache-2.0
// The kernel that blurs by gathering: each pixel becomes the weighted mean of a disc around it.
#ifndef STARFOCUS_SIMD_DISC_H_
#define STARFOCUS_SIMD_DISC_H_

#include <cstddef>
#include <cstdint>

namespace starfocus::simd {

// A filter over pixels that is symmetric about both axes and both diagonals, so that an octant
// tells all of it: the weight of the pixel m columns and n rows away, 0 <= m <= n <= size, is
// weights[n (n + 1) / 2 + m]. All weights of the disc together sum to 2^bits at most.
struct Disc {
  int32_t size;             // pixels from the middle to the last column, [0, kMaxDisc]
  int bits;                 // [1, 24]
  const uint16_t* weights;  // [0, 32767]
};
inline constexpr int32_t kMaxDisc = 13;

namespace reference {

// out[y][n] is the disc's weighted sum around the sample in[y][n] (R, G and B each by itself),
// divided by 2^bits and rounded halves up, for y < rows and n < count. Strides are in bytes. `in`
// is read as far around as the disc reaches: disc.size rows and 3 disc.size samples on each side.
// `in` and `out` don't overlap, and nothing between the rows of `out` is written.
void FilterDisc(const uint8_t* in, size_t in_stride, const Disc& disc, size_t rows, size_t count,
                uint8_t* out, size_t out_stride);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_DISC_H_
