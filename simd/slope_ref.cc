// SPDX-License-Identifier: Apache-2.0
#include "simd/samples.h"
#include "simd/slope.h"

namespace starfocus::simd::reference {

void MixSamples(const int16_t* less, const int16_t* more, const int16_t* share, size_t count,
                int16_t* out) {
  for (size_t n = 0; n < SliceSamples(count); ++n) {
    out[n] = static_cast<int16_t>(less[n] + Product15(more[n] - less[n], share[n]));
  }
}

void MoveSamples(const SampleRows& in, const HalfMove& move, int16_t* out, size_t out_stride) {
  const int16_t* row = in.samples;
  for (size_t y = 0; y < in.rows; ++y, row += in.stride, out += out_stride) {
    const int16_t *above = row - in.stride, *below = row + in.stride;
    for (size_t n = 0; n < SliceSamples(in.count); ++n) {
      const int16_t *left = row + n - 3, *right = row + n + 3;
      const int16_t across = Product15(Saturated(*right - *left), move.across);
      const int16_t down = Product15(Saturated(below[n] - above[n]), move.down);
      const int16_t value = Saturated(Saturated(row[n] + across) + down);
      out[n] = value < 0 ? int16_t{0} : value > kLayerWhite ? kLayerWhite : value;
    }
  }
}

}  // namespace starfocus::simd::reference
