// SPDX-License-Identifier: Apache-2.0
#include "lib/plan/gathered_cells.h"

#include "lib/base/fixed.h"

namespace starfocus {

Rect LayerFrame(const Rect& block, int32_t layer) {
  const int32_t margin = LayerMargin(layer), rest = (1 << layer) - 1;
  return {(block.x >> layer) - margin, (block.y >> layer) - margin,
          ((block.width + rest) >> layer) + 2 * margin,
          ((block.height + rest) >> layer) + 2 * margin};
}

Rect BlockCells::PixelsOf(int32_t x, int32_t y) const {
  const Rect frame = LayerFrame(block, layer);
  const int32_t left = x == block.x ? frame.x : x >> layer;
  const int32_t top = y == block.y ? frame.y : y >> layer;
  const bool last_column = x + kCellSize >= block.x + block.width;
  const bool last_row = y + kCellSize >= block.y + block.height;
  const int32_t right = last_column ? frame.x + frame.width : (x + kCellSize) >> layer;
  const int32_t bottom = last_row ? frame.y + frame.height : (y + kCellSize) >> layer;
  return {left, top, right - left, bottom - top};
}

bool BlockCells::AreGathered(const Rect& part) const {
  const auto column = [&](int32_t x) {
    return Clamp(x * (1 << layer), block.x, block.x + block.width - 1) / kCellSize;
  };
  const auto row = [&](int32_t y) {
    return Clamp(y * (1 << layer), block.y, block.y + block.height - 1) / kCellSize;
  };
  for (int32_t y = row(part.y); y <= row(part.y + part.height - 1); ++y) {
    for (int32_t x = column(part.x); x <= column(part.x + part.width - 1); ++x) {
      if (!IsGathered(x * kCellSize, y * kCellSize)) return false;
    }
  }
  return true;
}

}  // namespace starfocus
