// SPDX-License-Identifier: Apache-2.0
// Kernels between pixels of three bytes, R, G, B, and of other orders and sizes.
#ifndef STARFOCUS_SIMD_PIXELS_H_
#define STARFOCUS_SIMD_PIXELS_H_

#include <cstddef>
#include <cstdint>

namespace starfocus::simd {

// Pixels that lie `step` bytes apart, 3 or 4, and begin with R, G, B, or B, G, R if `blue_first`.
struct PixelOrder {
  size_t step;
  bool blue_first;
};

namespace reference {

// Copies the colours of `count` pixels. A fourth byte of the last pixel is not read.
void PixelsToRgb(const uint8_t* pixels, size_t count, const PixelOrder& order, uint8_t* rgb);

// And back; the fourth byte of each pixel, where there is one, becomes 255.
void RgbToPixels(const uint8_t* rgb, size_t count, const PixelOrder& order, uint8_t* pixels);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_PIXELS_H_
