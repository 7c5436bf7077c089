// SPDX-License-Identifier: Apache-2.0
// SIMD kernels that convert between R, G, B and luma with chroma of half the resolution (4:2:0).
// All samples are bytes. In formulas, P(a, c) is (a * c + 2^14) >> 15, which is the product of two
// numbers with 15 fractional bits, rounded half up. The function clamp() clamps a number to [0,
// 255].
#ifndef STARFOCUS_SIMD_YUV_H_
#define STARFOCUS_SIMD_YUV_H_

#include <cstddef>
#include <cstdint>

namespace starfocus::simd {

// Coefficients of a YUV format, as computed by lib/io/yuv_matrix.h.
struct YuvMatrix {
  int16_t black;           // Luma of black: 16 or 0.
  int16_t y;               // Coefficient from luma to R, G and B, 14 fractional bits.
  int16_t rv, gu, gv, bu;  // Coefficients from chroma to R, G and B, 13 fractional bits.
  // Coefficients from R, G and B to luma, 15 fractional bits. The luma of white is at most 255.
  int16_t yr, yg, yb;
  int16_t ur, ug, ub;  // Coefficients from R, G and B to U; their sum is 0.
  int16_t vr, vg, vb;  // Coefficients from R, G and B to V; their sum is 0.
};

namespace reference {

// Converts pixels n < count with luma y[n] and chroma u[n / 2], v[n / 2]. With
//   Y = P(128 (y - black), m.y), U = 256 (u - 128) and V = 256 (v - 128),
// R, G and B are clamp((Y + P(V, rv) + 32) >> 6), clamp((Y + P(U, gu) + P(V, gv) + 32) >> 6) and
// clamp((Y + P(U, bu) + 32) >> 6).
void YuvToRgb(const uint8_t* y, const uint8_t* u, const uint8_t* v, size_t count,
              const YuvMatrix& m, uint8_t* rgb);

// Computes y[n] = black + ((P(128 R, yr) + P(128 G, yg) + P(128 B, yb) + 64) >> 7).
void RgbToLuma(const uint8_t* rgb, size_t count, const YuvMatrix& m, uint8_t* y);

// Computes the chroma of two rows of `count` pixels: (count + 1) / 2 samples of U and of V. Let R,
// G and B be the sums over two pixels of `upper` and the two pixels below them in `lower`. If
// `count` is odd, the last pixel is repeated. Then
//   u[n] = clamp(128 + ((P(32 R, ur) + P(32 G, ug) + P(32 B, ub) + 64) >> 7)),
// and v[n] is computed like u[n], with vr, vg and vb.
void RgbToChroma(const uint8_t* upper, const uint8_t* lower, size_t count, const YuvMatrix& m,
                 uint8_t* u, uint8_t* v);

// SplitPairs sets first[n] = pairs[2 n] and second[n] = pairs[2 n + 1] for n < count. JoinPairs is
// the inverse of SplitPairs.
void SplitPairs(const uint8_t* pairs, size_t count, uint8_t* first, uint8_t* second);
void JoinPairs(const uint8_t* first, const uint8_t* second, size_t count, uint8_t* pairs);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_YUV_H_
