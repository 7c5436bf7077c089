// SPDX-License-Identifier: Apache-2.0
// Adds up the borders of all processing steps. Each step declares its own border next to its code.
// Only this file adds borders.
#include "lib/base/config.h"
#include "lib/base/fixed.h"
#include "lib/engine/deblock.h"
#include "lib/engine/lens.h"
#include "lib/io/block_pixels.h"
#include "lib/io/highlights.h"
#include "lib/io/layers.h"
#include "lib/matting/coverage.h"
#include "lib/matting/mixed_pixels.h"
#include "lib/matting/rims.h"
#include "lib/optics/rules.h"
#include "lib/plan/cells.h"

namespace starfocus {
namespace {

int32_t CeilPixels(double value) {
  const auto whole = static_cast<int32_t>(value);
  return value > whole ? whole + 1 : whole;
}

int32_t ToWholeCells(int32_t pixels) { return (pixels + kCellSize - 1) / kCellSize * kCellSize; }

// Returns the largest absolute disparity, rounded up: the largest distance by which a point moves
// between the centre view and a side view.
int32_t LargestMove(const FullConfig& config) {
  const double nearer = config.disparity_max, farther = -config.disparity_min;
  return CeilPixels(nearer > farther ? nearer : farther);
}

// Returns the border of a block at `layer`. Rendering reads every cell that has a pixel within
// reach of the block, plus the border of upsampling. Blurring without views (gathering) reads the
// pixels within the blur radius and the upsampling border.
int32_t BorderOfLayer(int32_t blur, int layer) {
  const int32_t reach = ReachOf(blur << kDisparityBits);
  const int32_t rendered = (ToWholeCells(reach + kUpsampleBorder[layer]) >> layer) + kRenderBorder;
  const int32_t gathered = Min((blur + (1 << layer) - 1) >> layer, kMaxGather);
  return Max(rendered, UpsampleBorder(layer) + gathered);
}

int32_t DownToPicture(int32_t border, int layer) {
  for (; layer > 0; --layer) border = 2 * border + kDownBorder;
  return border;
}

}  // namespace

Borders AddBorders(const FullConfig& config, double max_blur, bool deblocks) {
  const int32_t blur = CeilPixels(max_blur), reach = ReachOf(blur << kDisparityBits);
  const bool one_view = config.views == 1;
  Borders borders;
  borders.deblocked = deblocks ? kDeblockRows : 0;
  borders.whole_block = reach + kRenderBorder;
  borders.cells = ToWholeCells(reach + kUpsampleBorder[config.tuning.max_layer]) / kCellSize;
  // Blocks use the depth edges of cells within the blur radius, and other statistics of cells
  // within the blur radius plus the border of upsampling.
  borders.centre = Max(borders.cells * kCellSize, ToWholeCells(reach) + kCellBorder);
  if (!one_view) borders.centre = Max(borders.centre, kSearchBack - 1);
  int32_t read = 0;  // by a block in any view
  for (int layer = 0; layer <= config.tuning.max_layer; ++layer) {
    int32_t& border = borders.layer[layer] = BorderOfLayer(blur, layer);
    read = Max(read, DownToPicture(border, layer));
    const int32_t moved = (border << layer) + LargestMove(config) + CapturedBorder(layer);
    if (!one_view) borders.views = Max(borders.views, moved);
  }
  borders.centre = Max(borders.centre, read);
  read = Max(read, borders.views);
  const int32_t mixed = HasRims(config) ? kRimBorder : kMixedPixelBorder;
  borders.centre = Max(borders.centre, borders.layer[0] + mixed);
  borders.matting = borders.centre;
  borders.centre = borders.matting + CoverageBorder(config);
  const int32_t behind = one_view || !Has(config, STARFOCUS_FEATURE_COVERAGE)
                             ? 0
                             : LargestMove(config) + CapturedBorder(0);
  borders.views = Max(borders.views, borders.centre + behind);
  if (config.highlights > 1 || HasDeep(config)) borders.highlights = read;
  if (config.highlights > 1) {
    const int32_t farthest = Max(borders.highlights, borders.centre);
    borders.views = Max(borders.views, farthest + LampRadius(LargestLamp(config.width)));
  }
  borders.streamed = borders.views + (ReadsImages(config) ? borders.views % 2 : 0);
  return borders;
}

}  // namespace starfocus
