// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>

#include "simd/coverage.h"
#include "simd/samples.h"

namespace starfocus::simd::reference {

void CoverPlaces(const int16_t* near, const uint8_t* coverage, const int16_t* far,
                 const CoverView& view, int16_t* covered) {
  for (size_t n = 0; n < kSliceLanes; ++n) {
    const int16_t nearer = Saturated(near[n] - far[n]);
    const int16_t beside = Saturated(Product15(nearer, view.along) - view.place);
    const bool covers = nearer > view.least && beside >= -view.within && beside <= view.within;
    if (covers && coverage[n] > covered[n]) covered[n] = coverage[n];
  }
}

void SumNear(const NearRows& rows, NearSums* sums) {
  *sums = {};
  for (int32_t y = -kNearReach; y <= kNearReach; ++y) {
    for (int32_t x = -kNearReach; x <= kNearReach; ++x) {
      const int16_t tap = kNearTaps[std::abs(y)][std::abs(x)];
      for (size_t n = 0; n < kSliceLanes; ++n) {
        const ptrdiff_t here = static_cast<ptrdiff_t>(n), there = here + y * rows.stride + x;
        const int16_t beyond = Saturated(rows.disparity[there] - rows.disparity[here]);
        if (beyond > rows.step || beyond < -rows.step) continue;
        const int32_t weight = rows.weight[there] * tap;
        sums->weight[n] = static_cast<int16_t>(sums->weight[n] + weight);
        for (int c = 0; c < 3; ++c) {
          const int16_t part = Product15(rows.light[c][there], weight);
          sums->light[c][n] = static_cast<int16_t>(sums->light[c][n] + part);
        }
      }
    }
  }
}

}  // namespace starfocus::simd::reference
