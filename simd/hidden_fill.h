// SPDX-License-Identifier: Apache-2.0
// SIMD kernels that inpaint surfaces that are hidden behind depth edges and that no captured view
// shows.
#ifndef STARFOCUS_SIMD_HIDDEN_FILL_H_
#define STARFOCUS_SIMD_HIDDEN_FILL_H_

#include <cstddef>
#include <cstdint>

#include "simd/layered_depth.h"
#include "simd/slices.h"

namespace starfocus::simd {

// A row of the surfaces of a field, with the sources of the hidden surfaces in the format of
// HiddenRow. Element source[k] belongs to surface k + 1. If the first surface covers only a part of
// a pixel, source[0] belongs to surface 2 instead.
struct SourcedRow {
  SurfaceRow surfaces;
  const uint16_t* source[kSurfaces - 1];
};

// Farthest surface of each pixel of a row. The planes R, G and B are `plane` samples apart.
// `source` is 0 at pixels at which a captured view shows the farthest surface.
struct FarRow {
  int16_t* disparity;
  int16_t* rgb;
  uint16_t* source;
  size_t plane;
};

// A row (index 1), the row `step` rows above (index 0) and the row `step` rows below (index 2).
// `source` belongs to row 1. At both ends of the rows, kSliceLanes more pixels must be readable.
// Colours are light and not negative.
struct FarRows {
  const int16_t* disparity[3];
  const int16_t* rgb[3];
  size_t plane;
  const uint16_t* source;
};

namespace reference {

// Copies the farthest surfaces of a row of `count` pixels, in whole groups of kSliceLanes. Returns
// the largest distance over which a copied colour is repeated, or 0 if no colour is repeated.
int32_t TakeFarthest(const SourcedRow& row, size_t count, const FarRow& far);

// Smooths the colours of those pixels n < count of a row whose colours are repeated over a distance
// of at least step / 2. Other pixels are not changed. Whole groups of kSliceLanes are processed.
// `step` is at most kSliceLanes. The new colour of a pixel is the mean of its old colour and the
// mean of its four neighbours at a distance of `step` pixels. If the disparity of a neighbour
// differs by more than `unit`, the pixel itself replaces the neighbour. The mean of the neighbours
// is the mean of two means: the mean of left and right, and the mean of above and below. Each mean
// is rounded half up.
void SmoothFar(const FarRows& rows, int16_t unit, int32_t step, size_t count, int16_t* rgb);

// Copies the repeated colours of a row to a surface, at all pixels at which this surface is the
// farthest. `disparity` and `rgb` are the row of the surface; the planes of `rgb` are `plane`
// samples apart. Processes group c of kSliceLanes pixels if bit c of `hiding` is set.
void PutFarthest(const FarRow& far, const int16_t* disparity, uint64_t hiding, size_t plane,
                 int16_t* rgb);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_HIDDEN_FILL_H_
