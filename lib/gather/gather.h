// SPDX-License-Identifier: Apache-2.0
// Gathering: blurs 8x8 cells of a single surface without views. Each gathered pixel is the mean of
// its neighbours in the centre view, weighted by the ideal PSF (4) of its blur. If disparity varies
// little within reach of the blur, this weighted mean equals the mean of all views of the aperture.
#ifndef STARFOCUS_LIB_GATHER_GATHER_H_
#define STARFOCUS_LIB_GATHER_GATHER_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/call_progress.h"
#include "lib/gather/blur.h"
#include "lib/io/block_pixels.h"
#include "lib/optics/rules.h"
#include "lib/plan/cells.h"
#include "lib/plan/smooth_cells.h"
#include "simd/kernels.h"

namespace starfocus {

static_assert(kMaxGather <= simd::kMaxDisc, "");

// PSFs of a lens, indexed by BlurStep.
struct GatherPsfs {
  const Psf* of_step;
  int32_t last_step;
  int32_t mean_square;  // MeanSquare of the opening
};

struct GatherJob {
  const Window* window;  // window at the layer of the cells
  const CellGrid* grid;
  BlockCells cells;  // cells of a block whose coordinates are multiples of kCellSize
  BlurScale scale;
  GatherPsfs blur;
  const simd::Kernels* kernels;
  CancelToken* cancel;  // cancels the call; the output is incomplete after cancellation
};

// Output, starting at the first pixel of the block's LayerFrame: codes at layer 0, samples with
// kLayerBits at other layers.
struct Gathered {
  uint8_t* codes;
  int16_t* samples;
  size_t stride;  // distance between rows, in samples
};

// Blurs, without views, the cells of a block that GatherMap selects. `field` must have room for the
// LayerFrame of the block and a border of kMaxGather pixels. Returns the number of pixels of the
// picture that the blurred cells cover.
uint64_t GatherCells(const GatherJob& job, BlockPixels* field, const Gathered& out);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_GATHER_GATHER_H_
