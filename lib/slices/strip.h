// SPDX-License-Identifier: Apache-2.0
// Composites a strip, which consists of kSliceLanes adjacent pixel columns in a tile. All views of
// a strip are composited while the slices of the strip are in the L1 cache.
#ifndef STARFOCUS_LIB_SLICES_STRIP_H_
#define STARFOCUS_LIB_SLICES_STRIP_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/call_progress.h"
#include "lib/slices/slice_plane.h"
#include "lib/slices/slice_stack.h"
#include "simd/kernels.h"

namespace starfocus {

// Two adjacent cells (squares of up to 8x8 pixels), with the slices that are visible in these
// cells.
struct CellPair {
  int32_t x, y, rows;  // Position in the part of the tile, and height, both in pixels.
  int32_t count;       // Number of slices that are visible in the two cells.
  uint8_t shown[kMaxSlices];
};

// Sums of a pixel: R, G, B and coverage.
inline constexpr size_t kPixelSums = 4;

// Input, scratch memory and output for the strips of a part of a tile. G is kGroupViews or the
// number of views in the middle column of the aperture, whichever is smaller.
struct StripJob {
  const simd::Kernels* kernels;
  const SliceStack* stack;
  const SlicePlane* planes;  // One plane per slice, filled for the current part of the tile.
  int16_t* weights;          // Weights of a group of views: G elements.
  int16_t* memory;           // Scratch memory: StripBytes for each slice.
  uint32_t* sums;            // Output: kPixelSums per pixel, in the order of rows.
  CancelToken* cancel;       // Null: the job is never cancelled.
};

// The cell pairs [first, end) of a part of a tile that lie at column x. The range contains at least
// one pair.
struct StripPairs {
  int32_t x;
  const CellPair *first, *end;
};

// Writes the sums over all views of the cell pairs to job.sums.
void CompositeStrip(const StripJob& job, const StripPairs& pairs);

// Returns a pointer to the sums of row `row` in the buffer StripJob::sums.
inline uint32_t* SumsOfRow(uint32_t* sums, int32_t row) {
  return sums + kPixelSums * simd::kSliceLanes * static_cast<size_t>(row);
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_SLICES_STRIP_H_
