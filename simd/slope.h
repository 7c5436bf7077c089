// SPDX-License-Identifier: Apache-2.0
// Kernels of blur that changes across a picture: what lies between two pictures that are blurred
// less and more, and a picture moved by parts of a pixel.
#ifndef STARFOCUS_SIMD_SLOPE_H_
#define STARFOCUS_SIMD_SLOPE_H_

#include <cstddef>
#include <cstdint>

#include "simd/padding.h"
#include "simd/resample.h"

namespace starfocus::simd {

// Half of how far a picture is moved, in pixels with 15 fractional bits, (-1, 1): along rows and
// along columns.
struct HalfMove {
  int16_t across, down;
};

namespace reference {

// Both kernels read and write rows in whole groups of kSliceLanes.

// out[n] is less[n] + share[n] (more[n] - less[n]), share[n] in [0, 1] with 15 fractional bits, the
// product rounded halves up. Samples are in range.
void MixSamples(const int16_t* less, const int16_t* more, const int16_t* share, size_t count,
                int16_t* out);

// Moves rows of samples, R, G and B interleaved, against the direction of `move` along their
// gradient: out[y][n] is in[y][n] + across (in[y][n + 3] - in[y][n - 3]) + down (in[y + 1][n] -
// in[y - 1][n]), each product rounded halves up, each difference and sum saturated to 16 bits, and
// the result clamped to what is in range. The rows above and below and a pixel on each side are
// read as well. out_stride is in samples; `in` and `out` don't overlap.
void MoveSamples(const SampleRows& in, const HalfMove& move, int16_t* out, size_t out_stride);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_SLOPE_H_
