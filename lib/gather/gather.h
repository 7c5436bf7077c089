// SPDX-License-Identifier: Apache-2.0
// Gathering: blurs 8x8 cells of a single surface without views. Each gathered pixel is the mean of
// its neighbours in the centre view, weighted by the ideal PSF (4) of its blur. If disparity varies
// little within reach of the blur, this weighted mean equals the mean of all views of the aperture.
// On a slope, each pixel has its own radius, and the blurred image is displaced (Slope).
#ifndef STARFOCUS_LIB_GATHER_GATHER_H_
#define STARFOCUS_LIB_GATHER_GATHER_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/geometry.h"
#include "lib/base/jobs.h"
#include "lib/io/block_pixels.h"
#include "lib/io/input.h"
#include "lib/optics/psf.h"
#include "lib/optics/rules.h"
#include "lib/plan/cells.h"
#include "lib/plan/smooth_cells.h"
#include "simd/kernels.h"

namespace starfocus {

// Fractional bits of radii on a slope.
inline constexpr int kSlopeBits = 10;

// Blur across a gathered cell on a slope, derived from the surrounding cells: the radius of each
// pixel, and the displacement of the blurred image of a slanted surface (docs/method.md,
// Gathering).
class Slope {
 public:
  // Describes the cell at (column, row) of the grid, at a layer. The grid must store the cells
  // around the described cell. The radius at a corner is the mean radius of the four adjacent
  // cells, with opposite signs in front of and behind the focus. Radii between the corners are
  // interpolated bilinearly.
  Slope(const CellGrid& grid, const BlurScale& scale, int32_t column, int32_t row, int32_t layer);

  // Returns the smallest and the largest radius (kSlopeBits) of pixels of the layer, which may lie
  // outside the cell.
  Range RangeOf(const Rect& pixels) const;

  // Writes the mix of the larger PSF for each pixel, in [0, 1] with 15 fractional bits. Elements
  // mix[3 n] to mix[3 n + 2] belong to pixel n of a row. Rows are `stride` samples apart. The
  // mix is the position of the pixel's squared radius between the squares of the radii
  // `between.first` and `between.last` (kSlopeBits). With this mix, a mixture of two PSFs has the
  // mean square width of the intermediate PSF.
  void FindMix(const Range& between, const Rect& pixels, size_t stride, int16_t* mix) const;

  // Returns the displacement of the cell's pixels in the mean of all views. The displacement is
  // `spread` times the radius times the gradient of the radius, at most two pixels. `spread` is the
  // mean square of the lens's light along an axis (MeanSquare).
  simd::HalfMove Move(int32_t spread) const;

 private:
  int64_t Scaled(int32_t x, int32_t y) const;
  // Returns the extra fractional bits of Scaled: log2 of the squared number of half pixels along a
  // cell, plus the layer.
  int ScaledBits() const { return 8 + layer_; }
  int32_t At(int32_t x, int32_t y) const;

  int32_t layer_;
  int32_t left_, top_;  // Upper left corner of the cell, in half pixels of the picture.
  int32_t corners_[4];  // Signed blur radii at the four corners, in pixels of the picture,
                        // kSlopeBits, row by row.
};

static_assert(kMaxGather <= simd::kMaxDisc, "");

struct GatherJob {
  const Input* input;
  const CellGrid* grid;
  BlockCells cells;  // cells of a block whose coordinates are multiples of kCellSize
  BlurScale scale;
  const Psf* psfs;  // PSFs of the lens for the indices (PsfIndex) up to last_step
  int32_t last_step;
  int32_t mean_square;  // MeanSquare of the opening
  CancelToken* cancel;  // cancels the call; the output is incomplete after cancellation
};

// Blurs, without views, the cells of a block that GatherMap selects. `field` must have room for the
// LayerFrame of the block and a border of kMaxGather pixels. The output starts at the first pixel
// of the LayerFrame, in rows `stride` samples apart: codes or, if `codes` is null, samples with
// kLayerBits. Layers other than 0 have no codes. Returns the number of pixels of the picture that
// the blurred cells cover.
uint64_t GatherCells(const GatherJob& job, BlockPixels* field, uint8_t* codes, int16_t* samples,
                     size_t stride);

// Depth-dependent blur of the centre view alone (references [13] and [14] of the paper), for
// comparison with rendered views. Each output pixel is the mean of its neighbours, weighted by the
// ideal PSF (4) of its blur radius.
struct BlurJob {
  const Input* input;
  BlurScale scale;
  const Psf* psfs_of_radius;
  Rect rect;
  int32_t border;       // Largest Psf::size in the picture, in pixels.
  CancelToken* cancel;  // Cancels the call; rows are then missing.
};

// Receives the sums of a run of pixels of one row, with `bits` fractional bits more than codes.
struct SumsOfRun {
  void (*store)(void* data, const uint32_t* sums, const Rect& run, int bits);
  void* data;
};

// Blurs job.rect. Scratch memory: `rgb` holds the light of the extended rectangle in packed rows,
// `accumulators` 3 * rect.width sums.
void BlurRectangle(const BlurJob& job, int16_t* rgb, uint32_t* accumulators, const SumsOfRun& runs);

// Calls store(sums, run, bits) in place of SumsOfRun.
template <class Store>
void BlurRectangle(const BlurJob& job, int16_t* rgb, uint32_t* accumulators, const Store& store) {
  const SumsOfRun runs = {[](void* data, const uint32_t* sums, const Rect& run, int bits) {
                            (*static_cast<const Store*>(data))(sums, run, bits);
                          },
                          const_cast<Store*>(&store)};
  BlurRectangle(job, rgb, accumulators, runs);
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_GATHER_GATHER_H_
