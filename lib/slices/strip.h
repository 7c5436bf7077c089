// SPDX-License-Identifier: Apache-2.0
// A strip: kSliceLanes columns of a part of a tile, all views of which are composited while its
// slices are in the nearest cache.
#ifndef STARFOCUS_LIB_SLICES_STRIP_H_
#define STARFOCUS_LIB_SLICES_STRIP_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/call_progress.h"
#include "lib/slices/slice_plane.h"
#include "lib/slices/slice_stack.h"
#include "simd/kernels.h"

namespace starfocus {

// Two cells side by side in a part of a tile: they see slices of their own.
struct CellPair {
  int32_t x, y, rows;  // in the part of the tile
  int32_t count;       // slices seen
  uint8_t shown[kMaxSlices];
};

// A pixel of light has sums of R, G, B and of what is covered.
inline constexpr size_t kPixelSums = 4;

// What all strips of a part of a tile share. G: the smaller of 2 N + 1 and kGroupViews.
struct StripJob {
  const simd::Kernels* kernels;
  const SliceStack* stack;
  const SlicePlane* planes;  // of each slice, filled for the part
  int16_t* weights;          // G: of a group of views
  int16_t* memory;           // StripBytes of each slice
  uint32_t* sums;            // kPixelSums of each pixel of the strip: output, by rows of the part
  CancelToken* cancel;       // null: it goes on to the end
};

// The pairs [first, end) of a part of a tile that lie at column x, at least one.
struct StripPairs {
  int32_t x;
  const CellPair *first, *end;
};

// Sums all views of the pairs into job.sums.
void CompositeStrip(const StripJob& job, const StripPairs& pairs);

// The sums of a row of the part.
inline uint32_t* SumsOfRow(uint32_t* sums, int32_t row) {
  return sums + kPixelSums * simd::kSliceLanes * static_cast<size_t>(row);
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_SLICES_STRIP_H_
