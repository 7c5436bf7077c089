// SPDX-License-Identifier: Apache-2.0
// Kernels from values of depth maps to disparities of 6 fractional bits, and from rows of small
// maps to rows of pictures.
#ifndef STARFOCUS_SIMD_DEPTH_VALUES_H_
#define STARFOCUS_SIMD_DEPTH_VALUES_H_

#include <cstddef>
#include <cstdint>

#include "simd/disparities.h"

namespace starfocus::simd {

// What a value z of a depth map means, and the range of disparities that are allowed.
struct DepthRule {
  float scale, offset;
  float invalid;    // z that stands for an unknown depth; NaN: none does
  bool reciprocal;  // disparity is scale / z + offset; else scale * z + offset
  float low, high;  // 511 at most, either way
};

// What DepthToDisparity met, as bits.
enum DepthFlags : uint32_t { kUnknownDepth = 1, kDepthOutside = 2 };

// Disparities of neighbours that differ by no more are of one surface, as the engine takes it
// (kSurfaceStep).
inline constexpr int16_t kBlendStep = 96;

// A column of a picture between columns of a map: the left one times kColumnOne, and the share of
// the one to its right.
inline constexpr int kColumnBits = 8;
inline constexpr uint32_t kColumnOne = 1u << kColumnBits;

namespace reference {

// z[n] becomes the value of a byte, a 16-bit number or a half-precision float (IEEE 754 binary16;
// infinity and NaN become NaN).
void BytesToDepth(const uint8_t* values, size_t count, float* z);
void WordsToDepth(const uint16_t* values, size_t count, float* z);
void HalvesToDepth(const uint16_t* values, size_t count, float* z);

// Computes the disparity of each z[n] by the rule, each operation rounded to single precision; and
// out[n] = disparity * 64, rounded halves up, or kNoSurface where z is invalid or the disparity is
// not finite. Returns DepthFlags; out[n] is unspecified where a disparity lies outside of
// [low, high].
uint32_t DepthToDisparity(const float* z, size_t count, const DepthRule& rule, int16_t* out);

// out[n] lies between a[n] and b[n], at b's `share` in [0, kColumnOne): if they differ by at most
// kBlendStep it is a + ((share (b - a) + 128) >> 8), else the nearer one, a where share < 128.
void BlendRows(const int16_t* a, const int16_t* b, size_t count, uint32_t share, int16_t* out);

// The same along a row, for pixels whose columns[n] tells where they lie. Each pair is an element
// of a row (its low half) with the one to the right of it; the first pair is element `first`.
void SpreadRow(const int32_t* pairs, const uint32_t* columns, size_t count, uint32_t first,
               int16_t* out);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_DEPTH_VALUES_H_
