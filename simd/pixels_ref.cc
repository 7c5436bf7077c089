// SPDX-License-Identifier: Apache-2.0
#include "simd/pixels.h"

namespace starfocus::simd::reference {

void PixelsToRgb(const uint8_t* pixels, size_t count, const PixelOrder& order, uint8_t* rgb) {
  const size_t red = order.blue_first ? 2 : 0;
  for (size_t n = 0; n < count; ++n, pixels += order.step, rgb += 3) {
    rgb[0] = pixels[red];
    rgb[1] = pixels[1];
    rgb[2] = pixels[2 - red];
  }
}

void RgbToPixels(const uint8_t* rgb, size_t count, const PixelOrder& order, uint8_t* pixels) {
  const size_t red = order.blue_first ? 2 : 0;
  for (size_t n = 0; n < count; ++n, pixels += order.step, rgb += 3) {
    pixels[red] = rgb[0];
    pixels[1] = rgb[1];
    pixels[2 - red] = rgb[2];
    if (order.step == 4) pixels[3] = 255;
  }
}

}  // namespace starfocus::simd::reference
