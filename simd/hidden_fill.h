// SPDX-License-Identifier: Apache-2.0
// Kernels that fill what lies behind depth edges where no captured view shows it.
#ifndef STARFOCUS_SIMD_HIDDEN_FILL_H_
#define STARFOCUS_SIMD_HIDDEN_FILL_H_

#include <cstddef>
#include <cstdint>

#include "simd/layered_depth.h"
#include "simd/slices.h"

namespace starfocus::simd {

// A row of the surfaces of a field with the sources of those that are hidden, as HiddenRow has
// them. Of a pixel that the first surface covers only in part, they are those of the surfaces
// behind the second one.
struct SourcedRow {
  SurfaceRow surfaces;
  const uint16_t* source[kSurfaces - 1];
};

// The farthest surface of each pixel of a row: R, G and B lie `plane` samples apart. The source is
// 0 where a view shows the surface.
struct FarRow {
  int16_t* disparity;
  int16_t* rgb;
  uint16_t* source;
  size_t plane;
};

// The rows a step above a row, that row, and the one a step below it; of the row itself the
// sources. Around its pixels kSliceLanes more can be read on either side. Colours are light, never
// negative.
struct FarRows {
  const int16_t* disparity[3];
  const int16_t* rgb[3];
  size_t plane;
  const uint16_t* source;
};

namespace reference {

// Copies the farthest surfaces of a row of `count` pixels, in whole groups of kSliceLanes. Returns
// the largest distance over which one of their colours is repeated, 0 if none is.
int32_t TakeFarthest(const SourcedRow& row, size_t count, const FarRow& far);

// Writes the colours of those pixels n < count of a row, in whole groups of kSliceLanes, that are
// repeated over at least half of `step`, and leaves the others as they are. Such a pixel becomes
// the mean of itself and of the mean of its four neighbours `step` pixels to the left, right, above
// and below; a neighbour whose disparity differs by more than `unit` is stood in for by the pixel
// itself. All means are of two, with halves up: of left and right, of above and below, of these,
// and of that and the pixel. `step` is at most kSliceLanes.
void SmoothFar(const FarRows& rows, int16_t unit, int32_t step, size_t count, int16_t* rgb);

// Copies the colours of a row that are repeated to the surface of these disparities, where it is
// the farthest one: in whole groups of kSliceLanes, of those in which bit c of `hiding` is set. The
// colours of the surface lie `plane` samples apart.
void PutFarthest(const FarRow& far, const int16_t* disparity, uint64_t hiding, size_t plane,
                 int16_t* rgb);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_HIDDEN_FILL_H_
