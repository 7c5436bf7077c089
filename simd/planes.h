// SPDX-License-Identifier: Apache-2.0
// SIMD kernels that split rows of pixels into planes of R, G and B, and that shift planes by
// fractions of a pixel.
#ifndef STARFOCUS_SIMD_PLANES_H_
#define STARFOCUS_SIMD_PLANES_H_

#include <cstddef>
#include <cstdint>

#include "simd/samples.h"

namespace starfocus::simd::reference {

// Splits pixels into rows of R, G and B: plane[n] = rgb[3 n], plane[n + stride] = rgb[3 n + 1],
// plane[n + 2 stride] = rgb[3 n + 2], for n < count. No other elements of `plane` are written.
void SplitRow(const uint8_t* rgb, size_t count, size_t stride, uint8_t* plane);

// Sets out[n] to the interpolated sample `across` / 128 of a pixel to the right of sample n, and
// `down` / 128 of the way from `row` to `next`. `across` and `down` are in [0, 128). Interpolation
// is bilinear, first down and then across, and rounds half up after each direction. The rows have
// count + 1 samples. `out` is written in whole groups of kSliceLanes.
void InterpolateRow(const uint8_t* row, const uint8_t* next, int32_t across, int32_t down,
                    size_t count, uint8_t* out);

}  // namespace starfocus::simd::reference

#endif  // STARFOCUS_SIMD_PLANES_H_
