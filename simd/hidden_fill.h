// SPDX-License-Identifier: Apache-2.0
// SIMD kernels that fill hidden surfaces behind depth edges that no captured view shows.
#ifndef STARFOCUS_SIMD_HIDDEN_FILL_H_
#define STARFOCUS_SIMD_HIDDEN_FILL_H_

#include <cstddef>
#include <cstdint>

#include "simd/layered_depth.h"
#include "simd/slices.h"

namespace starfocus::simd {

// A row of the surfaces of a field, with the sources of the hidden ones in the format of HiddenRow.
// If the first surface covers only a part of a pixel, the sources are those of the surfaces behind
// the second one.
struct SourcedRow {
  SurfaceRow surfaces;
  const uint16_t* source[kSurfaces - 1];
};

// Farthest surface of each pixel of a row; R, G and B are `plane` samples apart. The source is 0 if
// a view shows the surface.
struct FarRow {
  int16_t* disparity;
  int16_t* rgb;
  uint16_t* source;
  size_t plane;
};

// The row `step` rows above a row, the row itself, and the row `step` rows below it, with the
// sources of the row itself. kSliceLanes more pixels can be read on either side. Colours are light,
// never negative.
struct FarRows {
  const int16_t* disparity[3];
  const int16_t* rgb[3];
  size_t plane;
  const uint16_t* source;
};

namespace reference {

// Copies the farthest surfaces of a row of `count` pixels, in whole groups of kSliceLanes. Returns
// the largest distance over which one of their colours is repeated, or 0.
int32_t TakeFarthest(const SourcedRow& row, size_t count, const FarRow& far);

// Writes the colours of the pixels n < count of a row that are repeated over at least half of
// `step`, in whole groups of kSliceLanes. Other pixels are not changed. The result is the mean of
// the pixel and of the mean of its four neighbours `step` pixels to the left, right, above and
// below. A neighbour whose disparity differs by more than `unit` is replaced by the pixel itself.
// All means are of two values, rounded halves up: left and right, above and below, these two means,
// and that mean and the pixel. `step` is at most kSliceLanes.
void SmoothFar(const FarRows& rows, int16_t unit, int32_t step, size_t count, int16_t* rgb);

// Copies the repeated colours of a row to the surface with these disparities, wherever that surface
// is the farthest. Processes whole groups of kSliceLanes: group c if bit c of `hiding` is set. The
// colours of the surface are `plane` samples apart.
void PutFarthest(const FarRow& far, const int16_t* disparity, uint64_t hiding, size_t plane,
                 int16_t* rgb);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_HIDDEN_FILL_H_
