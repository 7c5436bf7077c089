// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/refocus/partition_map.h"

#include <algorithm>

#include "examples/cli/pictures/tint.h"
#include "starfocus/experimental.h"

namespace starfocus {
namespace {

// Colours of the layers follow the paper's Fig. 14: red for L = 0, blue for L = 2.
constexpr uint8_t kLayerColors[STARFOCUS_LAYERS][3] = {
    {230, 60, 50}, {60, 180, 75}, {50, 110, 235}};
constexpr int kTintPercent = 40;

// Tints a block, and draws an outline along the first row and column of the block. The outline
// along the last row and column belongs to the neighbouring blocks. The first pixel of `map` is
// pixel (left, top) of the picture.
void DrawBlock(const starfocus_block& block, int left, int top, Image* map) {
  const uint8_t* color = kLayerColors[block.layer];
  const int begin = std::max(block.x, left);
  const int end = std::min(block.x + block.width, left + map->width);
  const int bottom = std::min(block.y + block.height, top + map->height);
  for (int y = std::max(block.y, top); y < bottom; ++y) {
    for (int x = begin; x < end; ++x) {
      uint8_t* pixel = map->row(y - top) + 3 * (x - left);
      const bool outline = x == block.x || y == block.y;
      Tint(color, outline ? 100 : kTintPercent, pixel);
    }
  }
}

}  // namespace

void CollectBlock(void* data, const starfocus_block* block) {
  static_cast<std::vector<starfocus_block>*>(data)->push_back(*block);
}

Image DrawPartition(const Image& picture, int left, int top,
                    const std::vector<starfocus_block>& blocks) {
  Image map = picture;
  for (const starfocus_block& block : blocks) DrawBlock(block, left, top, &map);
  return map;
}

}  // namespace starfocus
