// SPDX-License-Identifier: Apache-2.0
#include "lib/engine/reach.h"

#include "lib/base/fixed.h"
#include "lib/input/excess.h"
#include "lib/plan/block_stats.h"

namespace starfocus {
namespace {

int32_t CeilPixels(double value) {
  const auto whole = static_cast<int32_t>(value);
  return value > whole ? whole + 1 : whole;
}

double AbsDouble(double value) { return value < 0 ? -value : value; }

double MaxDouble(double a, double b) { return a > b ? a : b; }

}  // namespace

Reach GetReach(double max_blur) {
  // A cell reaches at most r and half a pixel of rounding beyond itself, or a layer's margin more;
  // its pixels then lie less than a cell further away.
  const int32_t splat = CeilPixels(max_blur) + 1 + kLayerMargin[2];
  Reach reach;
  reach.border = CeilPixels(max_blur) + kCellSize + 2;
  reach.cells = (splat + kCellSize - 1) / kCellSize + 1;
  // 16 rows are what the taps of two downsampling filters read beyond that.
  reach.rows = (reach.cells + 1) * kCellSize + 16;
  return reach;
}

int32_t LayerRows(const sf_config& config, int layer) {
  int32_t rows = config.largest_block + 2 * GetReach(config.max_blur).rows;
  for (; layer > 0; --layer) rows = rows / 2 + 4;
  return rows;
}

int32_t HighlightReach(const sf_config& config) {
  return config.highlights > 1 ? LampReach(LargestLamp(config.width)) : 0;
}

int32_t StreamReach(const sf_config& config) {
  const int32_t reach = SideReach(config, config.max_blur);
  return config.images != 0 ? reach + reach % 2 : reach;
}

int32_t SideReach(const sf_config& config, double max_blur) {
  // A hole is read at most its disparity away from a place within the blur radius, by a filter of
  // 7 taps at most.
  const double disparity =
      MaxDouble(AbsDouble(config.disparity_min), AbsDouble(config.disparity_max));
  return GetReach(max_blur).rows + CeilPixels(max_blur) + CeilPixels(disparity) + 8 +
         HighlightReach(config);
}

}  // namespace starfocus
