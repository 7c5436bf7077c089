// SPDX-License-Identifier: Apache-2.0
// Layer-dependent deblocking (paper, V-C): linear interpolation across the boundaries of blocks of
// different layers.
#ifndef STARFOCUS_LIB_FILTER_DEBLOCK_H_
#define STARFOCUS_LIB_FILTER_DEBLOCK_H_

#include <cstddef>
#include <cstdint>

#include "lib/input/window.h"
#include "simd/kernels.h"

namespace starfocus {

// Rows at the end of a stripe that wait for the next one: what a boundary below them reads. Of
// these it changes all but the first.
inline constexpr int32_t kDeblockRows = 4;

// The layer of smallest blocks that are not refocused; nothing is joined to them.
inline constexpr uint8_t kNoLayer = 0xFF;

// The layer of every smallest block (kSmallestBlock) of the stripe before, of which it has the last
// row, and of this one.
struct LayerMap {
  uint8_t* layers = nullptr;
  int32_t columns = 0;  // smallest blocks per row
  int32_t rows = 0;     // of this stripe

  // row -1: the stripe before.
  uint8_t& At(int32_t column, int32_t row) const {
    return layers[static_cast<size_t>(row + 1) * static_cast<size_t>(columns) +
                  static_cast<size_t>(column)];
  }
};

struct DeblockJob {
  const LayerMap* map;
  Plane<uint8_t> out;     // the picture's rows
  int32_t width, height;  // of the picture
  int32_t y;              // of the stripe's first row
  int32_t beta;           // of (16) and (17), in codes
  const Transfer* transfer;
  const simd::Kernels* kernels;
};

// Boundaries between rows of smallest blocks, at the top of the stripe (y > 0) and inside it, for
// their columns [begin, end). All of a row's must be done before its boundaries between columns.
void DeblockRows(const DeblockJob& job, int32_t begin, int32_t end);

// Boundaries between columns of smallest blocks, for picture rows [first, last).
void DeblockColumns(const DeblockJob& job, int32_t first, int32_t last);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_FILTER_DEBLOCK_H_
