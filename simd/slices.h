// SPDX-License-Identifier: Apache-2.0
// SIMD kernels that make a slice. The kernels select the surfaces whose disparity lies in the
// slice's range. If one view stands for a wide part of the lens, the kernels also spread the
// selected surfaces.
//
// A slice holds R, G, B and coverage as samples with 15 fractional bits. The colours are
// premultiplied by the coverage. A fully covered pixel has the coverage kSliceOne. The four planes
// of a row are `plane` samples apart.
#ifndef STARFOCUS_SIMD_SLICES_H_
#define STARFOCUS_SIMD_SLICES_H_

#include <cstddef>
#include <cstdint>

#include "simd/layered_depth.h"
#include "simd/samples.h"

namespace starfocus::simd {

inline constexpr int16_t kSliceOne = 32767;

// A row of pixels with up to kSurfaces surfaces each, ordered from the nearest to the farthest.
// Missing surfaces have a disparity below any slice.
struct SurfaceRow {
  const int16_t* disparity[kSurfaces];
  const int16_t* rgb[kSurfaces];  // Light in three planes, `plane` samples apart.
  // Share of the pixel that the first surface covers, with kSliceBits fractional bits.
  const uint8_t* share;
  size_t plane;
  // Bit c is set if group c of kSliceLanes pixels may have more than one surface. In all other
  // groups, the first surface covers each pixel completely, and no other surface is read.
  uint64_t hiding;
};

// Range of the disparities of a slice. The slice contains the disparities in [low, high], and the
// overlap, which is the disparities above `high` up to `overlap`. A first surface that ends at a
// pixel, or that covers only a part of the pixel, is excluded from the overlap. Without this
// exclusion, the surface would be in two slices, and its coverage would count twice.
struct SliceRange {
  int16_t low, high, overlap;
};

// Coverage of up to 64 groups of kSliceLanes samples of a row. Bit c of `some` is set if the slice
// covers any pixel of group c. Bit c of `all` is set if the slice completely covers all pixels of
// group c.
struct SliceCover {
  uint64_t some, all;
};

// A symmetric filter of 2 reach + 1 taps with 15 fractional bits. `centre` is the middle tap,
// `inner` applies at the distances 1 .. reach - 1, and `outer` at the distance `reach`. `inner` and
// `outer` are twice the taps, because each weights the mean of the two samples on both sides.
struct SliceTaps {
  int32_t reach;                 // Distance in samples of the outermost taps, [1, kMaxSpread].
  int16_t centre, inner, outer;  // Filter coefficients, >= 0.
};
inline constexpr int32_t kMaxSpread = 3;

namespace reference {

// Selects the surfaces in the range, for each pixel n < count. A first surface in the range
// contributes its light times its share. The next surface in the range contributes its light times
// the rest of the pixel. The fourth output plane is the sum of the coverage of all selected
// surfaces. All outputs are zero if no surface is in the range. If both surfaces share a pixel, the
// contribution of the first surface is rounded half up. Whole groups of kSliceLanes are read and
// written; `count` is at most 64 groups. Returns the coverage of each group.
SliceCover SelectSlice(const SurfaceRow& row, const SliceRange& range, size_t count, size_t plane,
                       int16_t* out);

// Filters samples that are `step` apart. Output out[n] is the saturated sum of the products of
// taps and samples in[n + k step], |k| <= reach. The two samples at an equal distance on both sides
// are averaged before the multiplication. Each mean and each product is rounded half up. Whole
// groups of kSliceLanes are read and written. Samples must not be negative.
void SpreadSlice(const int16_t* in, ptrdiff_t step, const SliceTaps& taps, size_t count,
                 int16_t* out);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_SLICES_H_
