// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/pictures.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

namespace starfocus {

Difference MeasureDifference(const Image& a, const Image& b) {
  Difference difference;
  uint64_t squares = 0;
  for (size_t i = 0; i < a.pixels.size(); ++i) {
    const int d = std::abs(int{a.pixels[i]} - int{b.pixels[i]});
    squares += uint64_t(d) * uint64_t(d);
    difference.largest = std::max(difference.largest, d);
  }
  const double mean = double(squares) / double(a.pixels.size());
  difference.psnr = squares == 0 ? INFINITY : 10 * std::log10(255.0 * 255.0 / mean);
  return difference;
}

Image DrawDifference(const Image& a, const Image& b, int white) {
  Image map(a.width, a.height);
  for (size_t i = 0; i < map.pixels.size(); i += 3) {
    int most = 0;
    for (size_t c = 0; c < 3; ++c) {
      most = std::max(most, std::abs(int{a.pixels[i + c]} - int{b.pixels[i + c]}));
    }
    // As the difference grows from 0 to `white`, first red, then green, then blue rises to the
    // maximum.
    const int way = std::min(most, white) * 3 * 255 / white;
    for (int c = 0; c < 3; ++c) {
      map.pixels[i + size_t(c)] = static_cast<uint8_t>(std::clamp(way - 255 * c, 0, 255));
    }
  }
  return map;
}

namespace {

// Returns the overlap of source sample `source` and target sample `target`, in units of 1/targets.
int64_t Overlap(int64_t source, int64_t target, int64_t sources, int64_t targets) {
  const int64_t low = std::max(source * targets, target * sources);
  const int64_t high = std::min((source + 1) * targets, (target + 1) * sources);
  return std::max<int64_t>(0, high - low);
}

// Averages the part of the source that pixel (x, y) of the target covers.
void BoxPixel(const Image& source, int x, int y, Image* target) {
  const int64_t sw = source.width, sh = source.height, tw = target->width, th = target->height;
  int64_t sum[3] = {0, 0, 0};
  for (int64_t j = y * sh / th; j < sh && j * th < (y + 1) * sh; ++j) {
    for (int64_t i = x * sw / tw; i < sw && i * tw < (x + 1) * sw; ++i) {
      const int64_t weight = Overlap(i, x, sw, tw) * Overlap(j, y, sh, th);
      const uint8_t* pixel = source.row(static_cast<int>(j)) + 3 * i;
      for (int c = 0; c < 3; ++c) sum[c] += weight * pixel[c];
    }
  }
  for (int c = 0; c < 3; ++c) {
    target->row(y)[3 * x + c] = static_cast<uint8_t>((sum[c] + sw * sh / 2) / (sw * sh));
  }
}

}  // namespace

Image Shrink(const Image& source, int width, int height) {
  if (source.width <= width && source.height <= height) return source;
  const int64_t fitted = int64_t(source.width) * height / source.height;
  const int64_t across = std::clamp<int64_t>(fitted, 1, width);
  const int64_t down = std::max<int64_t>(1, source.height * across / source.width);
  Image target(static_cast<int>(across), static_cast<int>(down));
  for (int y = 0; y < target.height; ++y) {
    for (int x = 0; x < target.width; ++x) BoxPixel(source, x, y, &target);
  }
  return target;
}

}  // namespace starfocus
