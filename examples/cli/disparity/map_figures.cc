// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/disparity/map_figures.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

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

}  // namespace starfocus
