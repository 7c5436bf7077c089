// SPDX-License-Identifier: Apache-2.0
// SIMD kernels that convert between pixels of the three bytes R, G, B and pixels with other orders
// and sizes.
#ifndef STARFOCUS_SIMD_PIXELS_H_
#define STARFOCUS_SIMD_PIXELS_H_

#include <cstddef>
#include <cstdint>

#include "simd/samples.h"

namespace starfocus::simd {

// Layout of pixels. Pixels are `step` (3 or 4) bytes apart, and begin with R, G, B, or with B, G, R
// if `blue_first` is true.
struct PixelOrder {
  size_t step;
  bool blue_first;
};

namespace reference {

// Converts `count` pixels to R, G, B. The fourth byte of the last pixel is never read.
STARFOCUS_REFERENCE void PixelsToRgb(const uint8_t* pixels, size_t count, const PixelOrder& order,
                                     uint8_t* rgb) {
  const size_t red = order.blue_first ? 2 : 0;
  for (size_t n = 0; n < count; ++n, pixels += order.step, rgb += 3) {
    rgb[0] = pixels[red];
    rgb[1] = pixels[1];
    rgb[2] = pixels[2 - red];
  }
}

// Converts `count` pixels from R, G, B. If pixels have a fourth byte, this byte is set to 255.
STARFOCUS_REFERENCE void RgbToPixels(const uint8_t* rgb, size_t count, const PixelOrder& order,
                                     uint8_t* pixels) {
  const size_t red = order.blue_first ? 2 : 0;
  for (size_t n = 0; n < count; ++n, pixels += order.step, rgb += 3) {
    pixels[red] = rgb[0];
    pixels[1] = rgb[1];
    pixels[2 - red] = rgb[2];
    if (order.step == 4) pixels[3] = 255;
  }
}

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_PIXELS_H_
