// SPDX-License-Identifier: Apache-2.0
// SIMD kernels for a blur that changes across a picture. One kernel interpolates between a picture
// with less blur and a picture with more blur. The other kernel moves a picture by fractions of a
// pixel.
#ifndef STARFOCUS_SIMD_SLOPE_H_
#define STARFOCUS_SIMD_SLOPE_H_

#include <cstddef>
#include <cstdint>

#include "simd/resample.h"
#include "simd/samples.h"

namespace starfocus::simd {

// Half of the movement of a picture along rows and along columns, in pixels with 15 fractional
// bits. Both values are in (-1, 1).
struct HalfMove {
  int16_t across, down;
};

namespace reference {

// MixSamples and MoveSamples read and write rows in whole groups of kSliceLanes.

// Sets out[n] to less[n] + share[n] (more[n] - less[n]), with share[n] in [0, 1] and 15 fractional
// bits. The product is rounded half up. Samples must be in the valid range of resample.h.
STARFOCUS_REFERENCE void MixSamples(const int16_t* less, const int16_t* more, const int16_t* share,
                                    size_t count, int16_t* out) {
  for (size_t n = 0; n < SliceSamples(count); ++n) {
    out[n] = static_cast<int16_t>(less[n] + Product15(more[n] - less[n], share[n]));
  }
}

// Moves rows of samples with interleaved R, G and B, by adding the scalar product of `move` and the
// gradient. Output out[y][n] is
//   in[y][n] + across (in[y][n + 3] - in[y][n - 3]) + down (in[y + 1][n] - in[y - 1][n]).
// Each product is rounded half up, each difference and sum is saturated to 16 bits, and the
// result is clamped to the valid range. MoveSamples reads one more row above and below `in`, and
// one more pixel to the left and right of `in`. The unit of out_stride is one sample. `in` and
// `out` must not overlap.
STARFOCUS_REFERENCE void MoveSamples(const SampleRows& in, const HalfMove& move, int16_t* out,
                                     size_t out_stride) {
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

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_SLOPE_H_
