// SPDX-License-Identifier: Apache-2.0
// SIMD kernels that convert 16-bit codes of R, G, B to codes of 8 bits, and from and to luma with
// chroma of 16 bits, whose samples of U and V alternate. Codes and samples are words; the white of
// codes is 65535. The matrix is that of 8 bits (pixels.h). With limited range, black is 16 * 256
// and white 235 * 256; with full range, white is 1023 * 64, the largest word of 10 bits.
#ifndef STARFOCUS_SIMD_WORDS_H_
#define STARFOCUS_SIMD_WORDS_H_

#include <cstddef>
#include <cstdint>

#include "simd/pixels.h"
#include "simd/samples.h"

namespace starfocus::simd {

// Returns by how much the scale from words to codes, or from codes to words, exceeds 1, with 16
// fractional bits. Code 65535 is word 255 * 256 of limited range, before its matrix, or word
// 1023 * 64 of full range.
constexpr int32_t MoreOfWords(const YuvMatrix& m) { return m.black == 0 ? 63 : 256; }
constexpr int32_t MoreOfCodes(const YuvMatrix& m) { return m.black == 0 ? -63 : -255; }

// Columns of a group of pixels that are dithered or rounded together.
inline constexpr size_t kDitherColumns = 16;
// A channel of a group is dithered if its codes differ from the first by at most this, in units of
// 1/256 of an 8-bit code. A band of one code is then at least 32 pixels wide. Where codes change
// faster, rounding makes no bands, and dithering would only add noise.
inline constexpr uint16_t kDitherRange = 128;
// Fine codes f that are at most kDitherSnap from a code of 8 bits are rounded, so that a flat
// picture stays flat. In the dark, this is max(0, kDitherDark - f / 128) more: a level of light is
// up to a tenth of a code there. Unit: 1/256 of an 8-bit code.
inline constexpr uint16_t kDitherSnap = 16, kDitherDark = 64;
inline constexpr uint16_t kDitherRound = 128;  // added before dropping 8 bits

namespace reference {

// Multiplies by 1 + more / 2^16, rounded half up. The product |value * more| is below 2^30.
inline int32_t ScaledWord(int32_t value, int32_t more) {
  return value + ((value * more + (1 << 15)) >> 16);
}

inline uint16_t ClampedWord(int32_t value) {
  return static_cast<uint16_t>(value < 0 ? 0 : value > 65535 ? 65535 : value);
}

// Returns the word of a 10-bit sample, rounded half up and clamped.
inline uint16_t TenBitWord(int32_t word) {
  const int32_t ten = (word + 32) >> 6;
  return static_cast<uint16_t>((ten < 0 ? 0 : ten > 1023 ? 1023 : ten) << 6);
}

// Converts pixels n < count with luma y[n] and chroma U = uv[n & ~1], V = uv[n | 1]. With
// u = U - 2^15, v = V - 2^15 and Y = ((y - 256 black) m.y) >> 1, red is
//   clamp(ScaledWord((Y + v rv + 2^12) >> 13, MoreOfWords(m)));
// green has u gu + v gv and blue has u bu in place of v rv. The sums are below 2^31.
STARFOCUS_REFERENCE void YuvWordsToRgb(const uint16_t* y, const uint16_t* uv, size_t count,
                                       const YuvMatrix& m, uint16_t* rgb) {
  for (size_t n = 0; n < count; ++n, rgb += 3) {
    const int32_t u = uv[n / 2 * 2] - 32768, v = uv[n / 2 * 2 + 1] - 32768;
    const int32_t luma = (((y[n] - 256 * m.black) * m.y) >> 1) + (1 << 12);
    const int32_t sums[3] = {luma + v * m.rv, luma + u * m.gu + v * m.gv, luma + u * m.bu};
    for (int c = 0; c < 3; ++c) rgb[c] = ClampedWord(ScaledWord(sums[c] >> 13, MoreOfWords(m)));
  }
}

// Computes y[n], with L = (R yr + G yg + B yb + 2^14) >> 15:
//   TenBitWord(256 black + ScaledWord(L, MoreOfCodes(m))).
STARFOCUS_REFERENCE void RgbToLumaWords(const uint16_t* rgb, size_t count, const YuvMatrix& m,
                                        uint16_t* y) {
  for (size_t n = 0; n < count; ++n, rgb += 3) {
    // The weights sum to at most 2^15.
    const int32_t sum = (rgb[0] * m.yr + rgb[1] * m.yg + rgb[2] * m.yb + (1 << 14)) >> 15;
    y[n] = TenBitWord(256 * m.black + ScaledWord(sum, MoreOfCodes(m)));
  }
}

// Returns the mean of colour c over pixels 2 n and 2 n + 1 of both rows, rounded half up.
inline int32_t MeanOfFour(const uint16_t* upper, const uint16_t* lower, size_t count, size_t n,
                          size_t c) {
  const size_t left = 3 * (2 * n) + c, right = 2 * n + 1 < count ? left + 3 : left;
  return (upper[left] + upper[right] + lower[left] + lower[right] + 2) >> 2;
}

// Computes the chroma of two rows of `count` pixels: (count + 1) / 2 pairs of U and V. Let R, G and
// B be the means over two pixels of `upper` and the two pixels below them in `lower`; if `count` is
// odd, the last pixel is repeated. Then U is
//   TenBitWord(2^15 + ScaledWord((R ur + G ug + B ub + 2^14) >> 15, MoreOfCodes(m))),
// and V is computed like U, with vr, vg and vb.
STARFOCUS_REFERENCE void RgbToChromaWords(const uint16_t* upper, const uint16_t* lower,
                                          size_t count, const YuvMatrix& m, uint16_t* uv) {
  for (size_t n = 0; 2 * n < count; ++n) {
    const int32_t r = MeanOfFour(upper, lower, count, n, 0);
    const int32_t g = MeanOfFour(upper, lower, count, n, 1);
    const int32_t b = MeanOfFour(upper, lower, count, n, 2);
    const int32_t sum_u = r * m.ur + g * m.ug + b * m.ub, sum_v = r * m.vr + g * m.vg + b * m.vb;
    uv[2 * n] = TenBitWord(32768 + ScaledWord((sum_u + (1 << 14)) >> 15, MoreOfCodes(m)));
    uv[2 * n + 1] = TenBitWord(32768 + ScaledWord((sum_v + (1 << 14)) >> 15, MoreOfCodes(m)));
  }
}

// Returns a 16-bit code in units of 1/256 of an 8-bit code; 257 c becomes 256 c.
inline uint16_t FineCode(uint16_t code) { return static_cast<uint16_t>(code - (code >> 8)); }

// Converts `count` pixels, whose first begins a group of kDitherColumns pixels, to 8-bit codes. The
// code of a fine code f is (f + more[n % 8]) >> 8 for column n of a smooth group, and (f +
// kDitherRound) >> 8 in other groups and next to 8-bit codes. more[k] <= 255.
STARFOCUS_REFERENCE void DitherWords(const uint16_t* rgb, size_t count, const uint16_t* more,
                                     uint8_t* out) {
  for (size_t first = 0; first < count; first += kDitherColumns) {
    const size_t end = count - first < kDitherColumns ? count : first + kDitherColumns;
    for (size_t c = 0; c < 3; ++c) {
      const int32_t start = FineCode(rgb[3 * first + c]);
      bool smooth = true;
      for (size_t n = first; n < end; ++n) {
        const int32_t change = FineCode(rgb[3 * n + c]) - start;
        smooth = smooth && change <= kDitherRange && change >= -kDitherRange;
      }
      for (size_t n = first; n < end; ++n) {
        const uint32_t fine = FineCode(rgb[3 * n + c]);
        const uint32_t dark = fine >> 7 < kDitherDark ? kDitherDark - (fine >> 7) : 0;
        const uint32_t snap = kDitherSnap + dark;
        const bool dithers = smooth && ((fine + snap) & 255) > 2 * snap;
        out[3 * n + c] = static_cast<uint8_t>((fine + (dithers ? more[n % 8] : kDitherRound)) >> 8);
      }
    }
  }
}

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_WORDS_H_
