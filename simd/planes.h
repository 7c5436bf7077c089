// SPDX-License-Identifier: Apache-2.0
// SIMD kernels that split rows of pixels into planes of R, G and B, and that shift planes by
// fractions of a pixel.
#ifndef STARFOCUS_SIMD_PLANES_H_
#define STARFOCUS_SIMD_PLANES_H_

#include <cstddef>
#include <cstdint>

#include "simd/samples.h"

namespace starfocus::simd::reference {

inline int InterpolateByte(int a, int b, int part) {
  return (a * (128 - part) + b * part + 64) >> 7;
}

// Splits pixels into rows of R, G and B: plane[n] = rgb[3 n], plane[n + stride] = rgb[3 n + 1],
// plane[n + 2 stride] = rgb[3 n + 2], for n < count. No other elements of `plane` are written.
STARFOCUS_REFERENCE void SplitRow(const uint8_t* rgb, size_t count, size_t stride, uint8_t* plane) {
  for (size_t n = 0; n < count; ++n) {
    for (size_t c = 0; c < 3; ++c) plane[n + c * stride] = rgb[3 * n + c];
  }
}

// Sets out[n] to the interpolated sample `across` / 128 of a pixel to the right of sample n, and
// `down` / 128 of the way from `row` to `next`. `across` and `down` are in [0, 128). Interpolation
// is bilinear, first down and then across, and rounds half up after each direction. The rows have
// count + 1 samples. `out` is written in whole groups of kSliceLanes.
STARFOCUS_REFERENCE void InterpolateRow(const uint8_t* row, const uint8_t* next, int32_t across,
                                        int32_t down, size_t count, uint8_t* out) {
  for (size_t n = 0; n < count; ++n) {
    const int left = InterpolateByte(row[n], next[n], down),
              right = InterpolateByte(row[n + 1], next[n + 1], down);
    out[n] = static_cast<uint8_t>(InterpolateByte(left, right, across));
  }
}

}  // namespace starfocus::simd::reference

#endif  // STARFOCUS_SIMD_PLANES_H_
