// SPDX-License-Identifier: Apache-2.0
#include "simd/planes.h"

namespace starfocus::simd::reference {
namespace {

int Between(int a, int b, int part) { return (a * (128 - part) + b * part + 64) >> 7; }

}  // namespace

void SplitRow(const uint8_t* rgb, size_t count, size_t stride, uint8_t* plane) {
  for (size_t n = 0; n < count; ++n) {
    for (size_t c = 0; c < 3; ++c) plane[n + c * stride] = rgb[3 * n + c];
  }
}

void InterpolateRow(const uint8_t* row, const uint8_t* next, int32_t across, int32_t down,
                    size_t count, uint8_t* out) {
  for (size_t n = 0; n < count; ++n) {
    const int left = Between(row[n], next[n], down), right = Between(row[n + 1], next[n + 1], down);
    out[n] = static_cast<uint8_t>(Between(left, right, across));
  }
}

}  // namespace starfocus::simd::reference
