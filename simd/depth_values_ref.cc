// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstring>
#include <limits>

#include "simd/depth_values.h"

namespace starfocus::simd::reference {
namespace {

constexpr uint16_t kHalfSign = 0x8000, kHalfInfinity = 0x7C00;

float HalfToFloat(uint16_t half) {
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

int16_t Blend(int32_t a, int32_t b, int32_t share) {
  const int32_t difference = b - a;
  if (difference < -kBlendStep || difference > kBlendStep) {
    return static_cast<int16_t>(share < 128 ? a : b);
  }
  return static_cast<int16_t>(a + ((share * difference + 128) >> 8));
}

}  // namespace

void BytesToDepth(const uint8_t* values, size_t count, float* z) {
  for (size_t n = 0; n < count; ++n) z[n] = static_cast<float>(values[n]);
}

void WordsToDepth(const uint16_t* values, size_t count, float* z) {
  for (size_t n = 0; n < count; ++n) z[n] = static_cast<float>(values[n]);
}

void HalvesToDepth(const uint16_t* values, size_t count, float* z) {
  for (size_t n = 0; n < count; ++n) z[n] = HalfToFloat(values[n]);
}

void Depth16ToDepth(const uint16_t* values, size_t count, float* z) {
  for (size_t n = 0; n < count; ++n) {
    const int32_t distance = values[n] & kDepth16Distance;
    z[n] = distance == 0 ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(distance);
  }
}

uint32_t DepthToDisparity(const float* z, size_t count, const DepthRule& rule, int16_t* out) {
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

void BlendRows(const int16_t* a, const int16_t* b, size_t count, uint32_t share, int16_t* out) {
  for (size_t n = 0; n < count; ++n) out[n] = Blend(a[n], b[n], static_cast<int32_t>(share));
}

void SpreadRow(const int16_t* row, const uint32_t* columns, size_t count, uint32_t first,
               int16_t* out) {
  for (size_t n = 0; n < count; ++n) {
    const int16_t* const at = row + (columns[n] / kColumnOne - first);
    out[n] = Blend(at[0], at[1], static_cast<int32_t>(columns[n] % kColumnOne));
  }
}

}  // namespace starfocus::simd::reference
