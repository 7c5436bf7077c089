// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/pictures/difference.h"

#include <algorithm>
#include <cmath>
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

}  // namespace starfocus
