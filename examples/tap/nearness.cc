// SPDX-License-Identifier: Apache-2.0
#include "examples/tap/nearness.h"

#include <algorithm>
#include <cmath>

#include "examples/scene/render.h"

namespace starfocus {

double PreviewPsnr(const Image& preview, const Image& full, int shift) {
  const LightCurve curve(STARFOCUS_TRANSFER_SRGB);
  double light[256];
  for (int code = 0; code < 256; ++code) light[code] = curve.Decode({double(code), 0, 0}).r;
  double squares = 0;
  for (int y = 0; y < preview.height; ++y) {
    const int top = y << shift, bottom = std::min(full.height, (y + 1) << shift);
    for (int x = 0; x < preview.width; ++x) {
      const int left = x << shift, right = std::min(full.width, (x + 1) << shift);
      double sums[3] = {};
      for (int row = top; row < bottom; ++row) {
        const uint8_t* rgb = full.row(row);
        for (int k = 3 * left; k < 3 * right; ++k) sums[k % 3] += light[rgb[k]];
      }
      const double area = double(bottom - top) * (right - left);
      const Color mean = curve.Encode({sums[0] / area, sums[1] / area, sums[2] / area});
      const uint8_t* found = preview.row(y) + 3 * x;
      const double codes[3] = {mean.r, mean.g, mean.b};
      for (int c = 0; c < 3; ++c) {
        const double error = std::floor(codes[c] + 0.5) - found[c];
        squares += error * error;
      }
    }
  }
  return 10 * std::log10(255.0 * 255 * double(preview.pixels.size()) / squares);
}

}  // namespace starfocus
