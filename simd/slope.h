// SPDX-License-Identifier: Apache-2.0
// SIMD kernels for a blur that changes across a picture. They interpolate between two pictures that
// are blurred less and more, and move a picture by fractions of a pixel.
#ifndef STARFOCUS_SIMD_SLOPE_H_
#define STARFOCUS_SIMD_SLOPE_H_

#include <cstddef>
#include <cstdint>

#include "simd/padding.h"
#include "simd/resample.h"

namespace starfocus::simd {

// Half of the distance by which a picture is moved, along rows and along columns, in pixels with 15
// fractional bits, (-1, 1).
struct HalfMove {
  int16_t across, down;
};

namespace reference {

// Both kernels read and write rows in whole groups of kSliceLanes.

// Sets out[n] to less[n] + share[n] (more[n] - less[n]), with share[n] in [0, 1] and 15 fractional
// bits. The product is rounded halves up. Samples are in range.
void MixSamples(const int16_t* less, const int16_t* more, const int16_t* share, size_t count,
                int16_t* out);

// Moves rows of samples, R, G and B interleaved, against the direction of `move` along their
// gradient. out[y][n] is
//   in[y][n] + across (in[y][n + 3] - in[y][n - 3]) + down (in[y + 1][n] - in[y - 1][n]).
// Each product is rounded halves up, each difference and sum is saturated to 16 bits, and the
// result is clamped to the valid range. The rows above and below and one pixel on each side are
// read, too. out_stride is in samples; `in` and `out` do not overlap.
void MoveSamples(const SampleRows& in, const HalfMove& move, int16_t* out, size_t out_stride);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_SLOPE_H_
