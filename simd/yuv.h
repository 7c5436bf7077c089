// SPDX-License-Identifier: Apache-2.0
// Kernels between R, G, B and luma with chroma of half the resolution (4:2:0), a byte each. P(a, c)
// below is (a * c + 2^14) >> 15, the product of two numbers of 15 fractional bits rounded halves
// up, and clamp() takes a number to [0, 255].
#ifndef STARFOCUS_SIMD_YUV_H_
#define STARFOCUS_SIMD_YUV_H_

#include <cstddef>
#include <cstdint>

namespace starfocus::simd {

// What luma and chroma mean (lib/convert/yuv_matrix.h makes them).
struct YuvMatrix {
  int16_t black;           // luma of black: 16 or 0
  int16_t y;               // to R, G and B: 14 fractional bits
  int16_t rv, gu, gv, bu;  // to R, G and B: 13 fractional bits
  int16_t yr, yg, yb;      // of R, G and B: 15 fractional bits; white's luma is 255 at most
  int16_t ur, ug, ub;      // their sum is 0
  int16_t vr, vg, vb;      // their sum is 0
};

namespace reference {

// Pixel n < count has luma y[n] and the chroma u[n / 2], v[n / 2]. With
//   Y = P(128 (y - black), m.y), U = 256 (u - 128) and V = 256 (v - 128)
// its R, G and B are clamp((Y + P(V, rv) + 32) >> 6), clamp((Y + P(U, gu) + P(V, gv) + 32) >> 6)
// and clamp((Y + P(U, bu) + 32) >> 6).
void YuvToRgb(const uint8_t* y, const uint8_t* u, const uint8_t* v, size_t count,
              const YuvMatrix& m, uint8_t* rgb);

// y[n] = black + ((P(128 R, yr) + P(128 G, yg) + P(128 B, yb) + 64) >> 7).
void RgbToLuma(const uint8_t* rgb, size_t count, const YuvMatrix& m, uint8_t* y);

// The chroma of two rows of `count` pixels, (count + 1) / 2 of each. With R, G and B the sums of
// two pixels of `upper` and the two below them in `lower`, of which an odd count repeats the last,
//   u[n] = clamp(128 + ((P(32 R, ur) + P(32 G, ug) + P(32 B, ub) + 64) >> 7)), and v[n] likewise.
void RgbToChroma(const uint8_t* upper, const uint8_t* lower, size_t count, const YuvMatrix& m,
                 uint8_t* u, uint8_t* v);

// first[n] = pairs[2 n], second[n] = pairs[2 n + 1]; and back.
void SplitPairs(const uint8_t* pairs, size_t count, uint8_t* first, uint8_t* second);
void JoinPairs(const uint8_t* first, const uint8_t* second, size_t count, uint8_t* pairs);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_YUV_H_
