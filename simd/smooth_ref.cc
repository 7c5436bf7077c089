// SPDX-License-Identifier: Apache-2.0
#include "simd/colours.h"
#include "simd/smooth.h"

namespace starfocus::simd::reference {
namespace {

int32_t SmoothWeight(const int32_t* own, const int32_t* other, size_t plane) {
  const auto differs = [&](size_t k) { return own[k * plane] - other[k * plane]; };
  const int32_t difference = ColourDifference(differs(1), differs(2), differs(3));
  return difference < kMostSmoothWeight ? kMostSmoothWeight - difference : 1;
}

}  // namespace

void SmoothDisparity(const SmoothRows& rows, size_t count, int16_t* smooth) {
  for (size_t n = 0; n < count; ++n) {
    const int32_t* own = rows.own + n;
    SmoothSums sums = {0, 0};
    for (size_t k = 0; k < rows.count; ++k) {
      for (int32_t x = -rows.radius; x <= rows.radius; x += rows.step) {
        const int32_t* other = rows.rows[k] + static_cast<ptrdiff_t>(n) + x;
        const int32_t apart = *other < *own ? *own - *other : *other - *own;
        if (apart > rows.tolerance) continue;
        const int32_t weight = SmoothWeight(own, other, rows.plane);
        sums.disparity += weight * *other;
        sums.weights += weight;
      }
    }
    smooth[n] = sums.Mean();
  }
}

}  // namespace starfocus::simd::reference
