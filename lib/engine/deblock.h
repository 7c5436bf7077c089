// SPDX-License-Identifier: Apache-2.0
// Layer-dependent deblocking (paper, V-C): interpolates linearly across the boundaries between
// blocks of different layers. The engine deblocks a stripe after all its blocks are refocused.
#ifndef STARFOCUS_LIB_ENGINE_DEBLOCK_H_
#define STARFOCUS_LIB_ENGINE_DEBLOCK_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/geometry.h"
#include "lib/io/output.h"
#include "simd/kernels.h"
#include "simd/light.h"

namespace starfocus {

// Number of rows at the end of a stripe that are finished only with the next stripe, because
// deblocking the boundary below reads them. Deblocking changes all kDeblockRows rows except the
// first.
inline constexpr int32_t kDeblockRows = 4;

// Layer of smallest blocks that are not refocused. The boundaries of such blocks are not deblocked.
inline constexpr uint8_t kNoLayer = 0xFF;

// Layer of each smallest block (kSmallestBlock) of the stripe, and of the last row of the previous
// stripe.
struct LayerMap {
  uint8_t* layers = nullptr;
  int32_t columns = 0;  // Number of smallest blocks per row.
  int32_t rows = 0;     // Number of rows of smallest blocks in this stripe.

  // Returns the layer of a smallest block; row -1 is the last row of the previous stripe.
  uint8_t& At(int32_t column, int32_t row) const {
    return layers[static_cast<size_t>(row + 1) * static_cast<size_t>(columns) +
                  static_cast<size_t>(column)];
  }
};

// A stripe to deblock.
struct Deblocking {
  const LayerMap* map;
  PictureRows out;        // Rows of the picture.
  int32_t width, height;  // Size of the picture.
  int32_t y;              // First row of the stripe.
  int32_t beta;           // Limit beta of equations (16) and (17), in codes.
  const simd::Encoding* transfer;
  const simd::Kernels* kernels;
};

// Deblocks the boundaries between rows of smallest blocks, in `columns` of these blocks: the
// boundary at the top of the stripe (y > 0) and the boundaries inside the stripe. All columns of a
// row must be finished before DeblockColumnBoundaries processes the row.
void DeblockRowBoundaries(const Deblocking& stripe, const Range& columns);

// Deblocks the boundaries between columns of smallest blocks, in `rows` of the picture.
void DeblockColumnBoundaries(const Deblocking& stripe, const Range& rows);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_DEBLOCK_H_
