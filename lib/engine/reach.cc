// SPDX-License-Identifier: Apache-2.0
#include "lib/engine/reach.h"

#include "lib/base/fixed.h"
#include "lib/base/rules.h"
#include "lib/input/excess.h"
#include "lib/input/picture_edge.h"
#include "lib/plan/block_stats.h"

namespace starfocus {
namespace {

int32_t CeilPixels(double value) {
  const auto whole = static_cast<int32_t>(value);
  return value > whole ? whole + 1 : whole;
}

double AbsDouble(double value) { return value < 0 ? -value : value; }

double MaxDouble(double a, double b) { return a > b ? a : b; }

// A hole is read at most its disparity away from a place within the blur radius, by a filter of 7
// taps at most.
int32_t DisplacedReach(const sf_config& config, double max_blur) {
  const double disparity =
      MaxDouble(AbsDouble(config.disparity_min), AbsDouble(config.disparity_max));
  return CeilPixels(max_blur) + CeilPixels(disparity) + 8;
}

}  // namespace

Reach GetReach(double max_blur) {
  const int32_t blur = CeilPixels(max_blur);
  // A cell reaches at most r and half a pixel of rounding beyond itself, or a layer's margin more;
  // its pixels then lie less than a cell further away.
  const int32_t splat = blur + 1 + kLayerMargin[2];
  Reach reach;
  reach.border = blur + kCellSize + 2;
  reach.cells = (splat + kCellSize - 1) / kCellSize + 1;
  // Cells look at the row next to theirs.
  reach.rows = Max(kLookBack, reach.cells * kCellSize + 1);
  for (int layer = 1; layer < SF_LAYERS; ++layer) {
    // Borders of blocks are whole cells (ReachBlock). Their last one begins within the splat.
    const int32_t border = (blur + kLayerMargin[layer]) / kCellSize * kCellSize + kCellSize;
    int32_t rows = (border >> layer) + 1;  // with the neighbour of a subaperture
    reach.layer_rows[layer] = rows;
    // The taps of each downsampling filter read 3 rows beyond.
    for (int above = layer; above > 0; --above) rows = 2 * rows + 3;
    reach.rows = Max(reach.rows, rows);
  }
  return reach;
}

int32_t LayerRows(const sf_config& config, int layer) {
  return (config.largest_block >> layer) + 2 * GetReach(config.max_blur).layer_rows[layer];
}

int32_t HighlightReach(const sf_config& config) {
  return config.highlights > 1 ? LampReach(LargestLamp(config.width)) : 0;
}

int32_t StreamReach(const sf_config& config) {
  const int32_t reach = SideReach(config, config.max_blur);
  return config.images != 0 ? reach + reach % 2 : reach;
}

int32_t HighlightsAround(const sf_config& config, double max_blur) {
  return (GetReach(max_blur).cells + 1) * kCellSize + 16 + DisplacedReach(config, max_blur);
}

int32_t SideReach(const sf_config& config, double max_blur) {
  const int32_t highlights = HighlightReach(config);
  if (highlights > 0) return HighlightsAround(config, max_blur) + highlights;
  const int32_t rows = GetReach(max_blur).rows;
  return config.views == 1 ? rows : rows + DisplacedReach(config, max_blur);
}

}  // namespace starfocus
