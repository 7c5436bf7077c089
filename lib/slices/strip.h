// SPDX-License-Identifier: Apache-2.0
// A strip: kSliceLanes columns of a section, all views of which are composited while its slices are
// in the nearest cache.
#ifndef STARFOCUS_LIB_SLICES_STRIP_H_
#define STARFOCUS_LIB_SLICES_STRIP_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/call_progress.h"
#include "lib/slices/slice_plane.h"
#include "lib/slices/slice_stack.h"
#include "simd/kernels.h"

namespace starfocus {

// Parts of a section, kLeastRows high and kSliceLanes wide, that see slices of their own.
struct SectionPart {
  int32_t x, y, rows;  // in the section
  int32_t count;       // slices seen
  uint8_t shown[kMaxSlices];
};

// A pixel of light has sums of R, G, B and of what is covered.
inline constexpr size_t kPixelSums = 4;

// What all strips of a section share. G: the smaller of 2 N + 1 and kGroupViews.
struct StripJob {
  const simd::Kernels* kernels;
  const SliceStack* stack;
  const SlicePlane* planes;  // of each slice, filled for the section
  int16_t* weights;          // G: of a group of views
  int16_t* memory;           // StripBytes of each slice
  uint32_t* sums;       // kPixelSums of each pixel of the strip: output, by rows of the section
  CancelToken* cancel;  // null: it goes on to the end
};

// The parts [first, end) of a section that lie at column x, at least one.
struct StripParts {
  int32_t x;
  const SectionPart *first, *end;
};

// Sums all views of the parts into job.sums.
void CompositeStrip(const StripJob& job, const StripParts& parts);

// The sums of a row of the section.
inline uint32_t* SumsOfRow(uint32_t* sums, int32_t row) {
  return sums + kPixelSums * simd::kSliceLanes * static_cast<size_t>(row);
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_SLICES_STRIP_H_
