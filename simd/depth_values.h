// SPDX-License-Identifier: Apache-2.0
// SIMD kernels that convert values of depth maps to disparities with 6 fractional bits, and rows of
// small maps to rows of pictures.
#ifndef STARFOCUS_SIMD_DEPTH_VALUES_H_
#define STARFOCUS_SIMD_DEPTH_VALUES_H_

#include <cstddef>
#include <cstdint>

#include "simd/disparities.h"

namespace starfocus::simd {

// Conversion from a value z of a depth map to a disparity, and the allowed range of disparities.
struct DepthRule {
  float scale, offset;
  float invalid;    // z of an unknown depth; NaN: no such value
  bool reciprocal;  // true: disparity is scale / z + offset; false: scale * z + offset
  float low, high;  // each in [-511, 511]
};

// Flags returned by DepthToDisparity.
enum DepthFlags : uint32_t { kUnknownDepth = 1, kDepthOutside = 2 };

// Neighbouring disparities that differ by at most this belong to one surface, as in the engine
// (kSurfaceStep).
inline constexpr int16_t kBlendStep = 96;

// Position of a picture column between two columns of a map: kColumnOne times the left column, plus
// the share of the right one.
inline constexpr int kColumnBits = 8;
inline constexpr uint32_t kColumnOne = 1u << kColumnBits;

namespace reference {

// Converts bytes, 16-bit numbers or half-precision floats (IEEE 754 binary16) to z[n]. Infinity and
// NaN become NaN.
void BytesToDepth(const uint8_t* values, size_t count, float* z);
void WordsToDepth(const uint16_t* values, size_t count, float* z);
void HalvesToDepth(const uint16_t* values, size_t count, float* z);

// Computes the disparity of each z[n] by the rule, with each operation rounded to single precision.
// Then out[n] is disparity * 64, rounded halves up. It is kNoSurface if z is invalid or the
// disparity is not finite, and unspecified if the disparity lies outside [low, high]. Returns
// DepthFlags.
uint32_t DepthToDisparity(const float* z, size_t count, const DepthRule& rule, int16_t* out);

// Interpolates between a[n] and b[n], where b has the weight `share` in [0, kColumnOne). If they
// differ by at most kBlendStep, out[n] is a + ((share (b - a) + 128) >> 8). Otherwise it is a if
// share < 128, else b.
void BlendRows(const int16_t* a, const int16_t* b, size_t count, uint32_t share, int16_t* out);

// Interpolates along a row like BlendRows. columns[n] is the position of pixel n. A pair is an
// element of the row (its low half) and the element to its right; the first pair is element
// `first`.
void SpreadRow(const int32_t* pairs, const uint32_t* columns, size_t count, uint32_t first,
               int16_t* out);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_DEPTH_VALUES_H_
