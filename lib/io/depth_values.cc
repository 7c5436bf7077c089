// SPDX-License-Identifier: Apache-2.0
#include "lib/io/depth_values.h"

#include <cstring>
#include <limits>

namespace starfocus {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

}  // namespace

size_t DepthBytes(int32_t type) {
  return type == STARFOCUS_DEPTH_FLOAT ? sizeof(float)
         : type == STARFOCUS_DEPTH_U8  ? 1
                                       : sizeof(uint16_t);
}

const void* ValueAt(const starfocus_depth_map& map, int32_t x, int32_t y) {
  return static_cast<const uint8_t*>(map.data) + static_cast<size_t>(y) * map.stride +
         static_cast<size_t>(x) * DepthBytes(map.type);
}

simd::DepthRule RuleOf(const starfocus_depth_map& map, float low, float high) {
  const float invalid = map.has_invalid != 0 ? static_cast<float>(map.invalid) : kUnknown;
  return {static_cast<float>(map.scale),
          static_cast<float>(map.offset),
          invalid,
          map.meaning == STARFOCUS_DEPTH_RECIPROCAL,
          low,
          high};
}

void ReadDisparities(const starfocus_depth_map& map, int32_t x, int32_t y, int32_t count,
                     float* out) {
  const void* const values = ValueAt(map, x, y);
  const auto n = static_cast<size_t>(count);
  if (map.type == STARFOCUS_DEPTH_FLOAT) {
    std::memcpy(out, values, n * sizeof(float));
  } else if (map.type == STARFOCUS_DEPTH_U8) {
    simd::reference::BytesToDepth(static_cast<const uint8_t*>(values), n, out);
  } else if (map.type == STARFOCUS_DEPTH_U16) {
    simd::reference::WordsToDepth(static_cast<const uint16_t*>(values), n, out);
  } else if (map.type == STARFOCUS_DEPTH_DEPTH16) {
    simd::reference::Depth16ToDepth(static_cast<const uint16_t*>(values), n, out);
  } else {
    simd::reference::HalvesToDepth(static_cast<const uint16_t*>(values), n, out);
  }
  const simd::DepthRule rule = RuleOf(map, 0, 0);
  for (size_t k = 0; k < n; ++k) out[k] = simd::reference::DisparityOf(out[k], rule);
}

}  // namespace starfocus
