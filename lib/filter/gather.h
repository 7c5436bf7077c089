// SPDX-License-Identifier: Apache-2.0
// 8x8 cells of one surface: every pixel gathered from the centre view with the ideal PSF (4) of
// the blur around it. Where disparity hardly changes as far as the blur reaches, that is what all
// views of the aperture together show.
#ifndef STARFOCUS_LIB_FILTER_GATHER_H_
#define STARFOCUS_LIB_FILTER_GATHER_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/call_progress.h"
#include "lib/base/rules.h"
#include "lib/filter/blur.h"
#include "lib/input/block_pixels.h"
#include "lib/plan/block_stats.h"
#include "lib/plan/gathered_cells.h"
#include "simd/kernels.h"

namespace starfocus {

static_assert(kMaxGather <= simd::kMaxDisc, "");

// The kernels of a lens.
struct GatherPsfs {
  const Psf* of_step;
  int32_t last_step;
  int32_t mean_square;  // of the opening
};

struct GatherJob {
  const Window* window;  // at the layer of the cells
  const CellGrid* grid;
  BlockCells cells;  // of a block, its corner a multiple of kCellSize
  BlurScale scale;
  GatherPsfs blur;
  const simd::Kernels* kernels;
  CancelToken* cancel;  // once it ends, what is gathered into is left half made
};

// What is gathered into, from the first pixel of the block's LayerFrame on: codes at layer 0,
// samples of kLayerBits at the others.
struct Gathered {
  uint8_t* codes;
  int16_t* samples;
  size_t stride;  // from row to row
};

// Gathers the cells of a block that are to be; `field` has room for its LayerFrame and a border of
// kMaxGather pixels. Returns their pixels in the picture.
uint64_t GatherCells(const GatherJob& job, BlockPixels* field, const Gathered& out);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_FILTER_GATHER_H_
