// SPDX-License-Identifier: Apache-2.0
// SIMD kernels that convert values of depth maps to disparities with 6 fractional bits, and that
// scale small depth maps to the size of a picture.
#ifndef STARFOCUS_SIMD_DEPTH_VALUES_H_
#define STARFOCUS_SIMD_DEPTH_VALUES_H_

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

#include "simd/disparities.h"
#include "simd/samples.h"

namespace starfocus::simd {

// Conversion from a value z of a depth map to a disparity, and the allowed range of disparities.
struct DepthRule {
  float scale, offset;
  float invalid;    // Value z of an unknown depth; NaN if there is no such value.
  bool reciprocal;  // True: the disparity is scale / z + offset; false: scale * z + offset.
  float low, high;  // Allowed range of disparities, within [-511, 511].
};

// Flags returned by DepthToDisparity: some disparity is unknown, or outside the allowed range.
inline constexpr uint32_t kUnknownDepth = 1, kDepthOutside = 2;

// Largest difference between neighbouring disparities on one surface. The value is equal to the
// engine's kSurfaceStep.
inline constexpr int16_t kBlendStep = 96;

// Bits of the distance in a value of DEPTH16.
inline constexpr int32_t kDepth16Distance = 0x1FFF;

// Fractional bits of the position of a picture column in a map. The position is kColumnOne times
// the index of the map column on the left, plus the share of the map column on the right.
inline constexpr int kColumnBits = 8;
inline constexpr uint32_t kColumnOne = 1u << kColumnBits;
// Number of elements that UpsampleRow may read after the elements of a row.
inline constexpr int kUpsampleSpare = 8;

namespace reference {

inline constexpr uint16_t kHalfSign = 0x8000, kHalfInfinity = 0x7C00;

inline float HalfToFloat(uint16_t half) {
  const uint32_t magnitude = half & (kHalfSign - 1u);
  if (magnitude > kHalfInfinity) return std::numeric_limits<float>::quiet_NaN();
  float value = static_cast<float>(magnitude) / (1 << 24);
  if (magnitude == kHalfInfinity) {
    value = std::numeric_limits<float>::infinity();
  } else if (magnitude >= 1 << 10) {
    // The biased exponent of a float is larger by 112 than that of a half-precision float.
    const uint32_t bits = (magnitude << 13) + (112u << 23);
    std::memcpy(&value, &bits, sizeof(value));
  }
  return (half & kHalfSign) != 0 ? -value : value;
}

inline int16_t BlendSamples(int32_t a, int32_t b, int32_t share) {
  const int32_t difference = b - a;
  if (difference < -kBlendStep || difference > kBlendStep) {
    return static_cast<int16_t>(share < 128 ? a : b);
  }
  return static_cast<int16_t>(a + ((share * difference + 128) >> 8));
}

// Convert bytes, 16-bit numbers, half-precision floats (IEEE 754 binary16) or DEPTH16 to z[n] for
// n < count. Infinity remains infinity: an infinite distance has a known disparity. DEPTH16 is a
// distance in the lower 13 bits, where 0 is unknown (NaN).
STARFOCUS_REFERENCE void BytesToDepth(const uint8_t* values, size_t count, float* z) {
  for (size_t n = 0; n < count; ++n) z[n] = static_cast<float>(values[n]);
}

STARFOCUS_REFERENCE void WordsToDepth(const uint16_t* values, size_t count, float* z) {
  for (size_t n = 0; n < count; ++n) z[n] = static_cast<float>(values[n]);
}

STARFOCUS_REFERENCE void HalvesToDepth(const uint16_t* values, size_t count, float* z) {
  for (size_t n = 0; n < count; ++n) z[n] = HalfToFloat(values[n]);
}

STARFOCUS_REFERENCE void Depth16ToDepth(const uint16_t* values, size_t count, float* z) {
  for (size_t n = 0; n < count; ++n) {
    const int32_t distance = values[n] & kDepth16Distance;
    z[n] = distance == 0 ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(distance);
  }
}

// Returns the disparity of z according to `rule`, with each operation rounded to single precision.
// The result is NaN if z is invalid or the disparity is not finite.
inline float DisparityOf(float z, const DepthRule& rule) {
  const float scaled = rule.reciprocal ? rule.scale / z : rule.scale * z;
  const float disparity = scaled + rule.offset;
  // Without a branch, so that compilers vectorize loops over this function.
  const bool known = bool(z != rule.invalid) & bool(disparity - disparity == 0.0f);
  return known ? disparity : std::numeric_limits<float>::quiet_NaN();
}

// Computes the disparity of each z[n] like DisparityOf. Sets out[n] to disparity * 64, rounded half
// up. If the disparity is NaN, out[n] is kNoSurface. If the disparity lies outside [low, high],
// out[n] is unspecified. Returns kUnknownDepth and kDepthOutside.
STARFOCUS_REFERENCE uint32_t DepthToDisparity(const float* z, size_t count, const DepthRule& rule,
                                              int16_t* out) {
  uint32_t flags = 0;
  for (size_t n = 0; n < count; ++n) {
    const float disparity = DisparityOf(z[n], rule);
    if (std::isnan(disparity)) {
      flags |= kUnknownDepth;
      out[n] = kNoSurface;
    } else if (disparity >= rule.low && disparity <= rule.high) {
      out[n] = static_cast<int16_t>(std::floor(disparity * 64.0f + 0.5f));
    } else {
      flags |= kDepthOutside;
      out[n] = 0;
    }
  }
  return flags;
}

// Interpolates between a[n] and b[n], where b has the weight `share` in [0, kColumnOne). If a[n]
// and b[n] differ by at most kBlendStep, out[n] is a + ((share (b - a) + 128) >> 8). If a[n] and
// b[n] differ by more than kBlendStep, out[n] is a[n] if share < 128, and b[n] otherwise.
STARFOCUS_REFERENCE void BlendRows(const int16_t* a, const int16_t* b, size_t count, uint32_t share,
                                   int16_t* out) {
  for (size_t n = 0; n < count; ++n) out[n] = BlendSamples(a[n], b[n], static_cast<int32_t>(share));
}

// Interpolates along a row like BlendRows. columns[n] is the position of output pixel n, in a row
// whose element `first` is row[0]. Positions increase by at most kColumnOne from pixel to pixel.
// The element to the right of the last position must exist. kUpsampleSpare elements after this
// element may be read, but do not affect the result.
STARFOCUS_REFERENCE void UpsampleRow(const int16_t* row, const uint32_t* columns, size_t count,
                                     uint32_t first, int16_t* out) {
  for (size_t n = 0; n < count; ++n) {
    const int16_t* const at = row + (columns[n] / kColumnOne - first);
    out[n] = BlendSamples(at[0], at[1], static_cast<int32_t>(columns[n] % kColumnOne));
  }
}

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_DEPTH_VALUES_H_
