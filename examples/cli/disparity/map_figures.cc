// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/disparity/map_figures.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

namespace starfocus {

std::vector<int64_t> Histogram(const FloatMap& map, const starfocus_disparity_stats& stats,
                               int bins) {
  std::vector<int64_t> counts(static_cast<size_t>(bins));
  const double range = double(stats.max) - stats.min;
  for (float d : map.values) {
    if (!std::isfinite(d)) continue;
    const double place = range > 0 ? (double(d) - stats.min) / range * bins : 0;
    const int bin = static_cast<int>(place);
    ++counts[size_t(bin < bins ? bin : bins - 1)];
  }
  return counts;
}

Image DrawDisparity(const FloatMap& map) {
  const auto ends = std::minmax_element(map.values.begin(), map.values.end());
  const float low = *ends.first, range = *ends.second - low;
  Image picture(map.width, map.height);
  for (size_t i = 0; i < map.values.size(); ++i) {
    const float place = range > 0 ? (map.values[i] - low) / range : 0;
    std::fill_n(picture.pixels.begin() + static_cast<ptrdiff_t>(3 * i), 3,
                static_cast<uint8_t>(place * 255 + 0.5F));
  }
  return picture;
}

Image DrawDepth(const FloatMap& map, const starfocus_disparity_stats& stats) {
  constexpr int kSteps = static_cast<int>(std::size(kDepthColors)) - 1;
  const float low = stats.min, range = stats.max - low;
  Image picture(map.width, map.height);
  for (size_t i = 0; i < map.values.size(); ++i) {
    const float place = range > 0 ? (map.values[i] - low) / range * kSteps : 0;
    const int step = std::min(static_cast<int>(place), kSteps - 1);
    const float part = place - static_cast<float>(step);
    for (size_t c = 0; c < 3; ++c) {
      const float from = kDepthColors[step][c], to = kDepthColors[step + 1][c];
      picture.pixels[3 * i + c] = static_cast<uint8_t>(from + part * (to - from) + 0.5F);
    }
  }
  return picture;
}

FloatMap SampleMap(const FloatMap& map, int width, int height) {
  FloatMap small;
  small.width = width;
  small.height = height;
  small.values.reserve(size_t(width) * size_t(height));
  for (int64_t y = 0; y < height; ++y) {
    const auto row = static_cast<int>((2 * y + 1) * map.height / (2 * int64_t{height}));
    for (int64_t x = 0; x < width; ++x) {
      small.values.push_back(
          map.at(static_cast<int>((2 * x + 1) * map.width / (2 * int64_t{width})), row));
    }
  }
  return small;
}

}  // namespace starfocus
