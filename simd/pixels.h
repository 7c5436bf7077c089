// SPDX-License-Identifier: Apache-2.0
// SIMD kernels that convert pixels. One pair of kernels converts between pixels of the three bytes
// R, G, B and pixels with other orders and sizes. The other kernels convert between R, G, B and
// luma with chroma of half the resolution (4:2:0). All samples are bytes. In formulas, P(a, c) =
// (a * c + 2^14) >> 15 is the product of two numbers with 15 fractional bits, rounded half up. The
// function clamp() clamps a number to [0, 255].
#ifndef STARFOCUS_SIMD_PIXELS_H_
#define STARFOCUS_SIMD_PIXELS_H_

#include <cstddef>
#include <cstdint>

#include "simd/samples.h"

namespace starfocus::simd {

// Coefficients of a YUV format, as computed by MakeYuvMatrix (lib/io/image.h).
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

// Converts `count` pixels to R, G, B. Pixels are `step` bytes apart, and begin with R, G, B, or
// with B, G, R if `blue_first` is true. The vector code supports steps of 3 and 4 bytes. The bytes
// after the colours of the last pixel are never read.
STARFOCUS_REFERENCE void PixelsToRgb(const uint8_t* pixels, size_t count, size_t step,
                                     bool blue_first, uint8_t* rgb) {
  const size_t red = blue_first ? 2 : 0;
  for (size_t n = 0; n < count; ++n, pixels += step, rgb += 3) {
    rgb[0] = pixels[red];
    rgb[1] = pixels[1];
    rgb[2] = pixels[2 - red];
  }
}

// Converts `count` pixels from R, G, B, in the formats of PixelsToRgb. If pixels have a fourth
// byte, this byte is set to 255.
STARFOCUS_REFERENCE void RgbToPixels(const uint8_t* rgb, size_t count, size_t step, bool blue_first,
                                     uint8_t* pixels) {
  const size_t red = blue_first ? 2 : 0;
  for (size_t n = 0; n < count; ++n, pixels += step, rgb += 3) {
    pixels[red] = rgb[0];
    pixels[1] = rgb[1];
    pixels[2 - red] = rgb[2];
    if (step == 4) pixels[3] = 255;
  }
}

inline uint8_t Clamped(int32_t value) {
  return static_cast<uint8_t>(value < 0 ? 0 : value > 255 ? 255 : value);
}

// Returns the sum of colour c over pixels 2 n and 2 n + 1 of both rows.
inline int32_t SumOfFour(const uint8_t* upper, const uint8_t* lower, size_t count, size_t n,
                         size_t c) {
  const size_t left = 3 * (2 * n) + c, right = 2 * n + 1 < count ? left + 3 : left;
  return upper[left] + upper[right] + lower[left] + lower[right];
}

// Converts pixels n < count with luma y[n] and chroma u[n / 2], v[n / 2]. With
//   Y = P(128 (y - black), m.y), U = 256 (u - 128) and V = 256 (v - 128),
// R, G and B are clamp((Y + P(V, rv) + 32) >> 6), clamp((Y + P(U, gu) + P(V, gv) + 32) >> 6) and
// clamp((Y + P(U, bu) + 32) >> 6).
STARFOCUS_REFERENCE void YuvToRgb(const uint8_t* y, const uint8_t* u, const uint8_t* v,
                                  size_t count, const YuvMatrix& m, uint8_t* rgb) {
  for (size_t n = 0; n < count; ++n, rgb += 3) {
    const int32_t luma = Product15(128 * (y[n] - m.black), m.y) + 32;
    const int32_t du = 256 * (u[n / 2] - 128), dv = 256 * (v[n / 2] - 128);
    rgb[0] = Clamped((luma + Product15(dv, m.rv)) >> 6);
    rgb[1] = Clamped((luma + Product15(du, m.gu) + Product15(dv, m.gv)) >> 6);
    rgb[2] = Clamped((luma + Product15(du, m.bu)) >> 6);
  }
}

// Computes y[n] = black + ((P(128 R, yr) + P(128 G, yg) + P(128 B, yb) + 64) >> 7).
STARFOCUS_REFERENCE void RgbToLuma(const uint8_t* rgb, size_t count, const YuvMatrix& m,
                                   uint8_t* y) {
  for (size_t n = 0; n < count; ++n, rgb += 3) {
    const int32_t sum = Product15(128 * rgb[0], m.yr) + Product15(128 * rgb[1], m.yg) +
                        Product15(128 * rgb[2], m.yb);
    y[n] = static_cast<uint8_t>(m.black + ((sum + 64) >> 7));
  }
}

// Computes the chroma of two rows of `count` pixels: (count + 1) / 2 samples of U and of V. Let R,
// G and B be the sums over two pixels of `upper` and the two pixels below them in `lower`. If
// `count` is odd, the last pixel is repeated. Then
//   u[n] = clamp(128 + ((P(32 R, ur) + P(32 G, ug) + P(32 B, ub) + 64) >> 7)),
// and v[n] is computed like u[n], with vr, vg and vb.
STARFOCUS_REFERENCE void RgbToChroma(const uint8_t* upper, const uint8_t* lower, size_t count,
                                     const YuvMatrix& m, uint8_t* u, uint8_t* v) {
  for (size_t n = 0; 2 * n < count; ++n) {
    const int32_t r = 32 * SumOfFour(upper, lower, count, n, 0);
    const int32_t g = 32 * SumOfFour(upper, lower, count, n, 1);
    const int32_t b = 32 * SumOfFour(upper, lower, count, n, 2);
    const int32_t of_u = Product15(r, m.ur) + Product15(g, m.ug) + Product15(b, m.ub);
    const int32_t of_v = Product15(r, m.vr) + Product15(g, m.vg) + Product15(b, m.vb);
    u[n] = Clamped(128 + ((of_u + 64) >> 7));
    v[n] = Clamped(128 + ((of_v + 64) >> 7));
  }
}

// DeinterleavePairs sets first[n] = pairs[2 n] and second[n] = pairs[2 n + 1] for n < count.
// JoinPairs is the inverse of DeinterleavePairs.
STARFOCUS_REFERENCE void DeinterleavePairs(const uint8_t* pairs, size_t count, uint8_t* first,
                                           uint8_t* second) {
  for (size_t n = 0; n < count; ++n) {
    first[n] = pairs[2 * n];
    second[n] = pairs[2 * n + 1];
  }
}

STARFOCUS_REFERENCE void JoinPairs(const uint8_t* first, const uint8_t* second, size_t count,
                                   uint8_t* pairs) {
  for (size_t n = 0; n < count; ++n) {
    pairs[2 * n] = first[n];
    pairs[2 * n + 1] = second[n];
  }
}

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_PIXELS_H_
