// SPDX-License-Identifier: Apache-2.0
// SIMD kernels that make a slice. They select the surfaces whose disparity lies in the slice's
// range, and spread them if one view stands for a wide part of the lens.
//
// A slice holds R, G, B and coverage as samples with 15 fractional bits. The colours are
// premultiplied by the coverage; a fully covered pixel has the coverage kSliceOne. The four planes
// of a row are `plane` samples apart.
#ifndef STARFOCUS_SIMD_SLICES_H_
#define STARFOCUS_SIMD_SLICES_H_

#include <cstddef>
#include <cstdint>

#include "simd/layered_depth.h"
#include "simd/padding.h"

namespace starfocus::simd {

inline constexpr int16_t kSliceOne = 32767;

// A row of the surfaces at each pixel, the nearest one first. Missing surfaces have a disparity
// below any slice.
struct SurfaceRow {
  const int16_t* disparity[kSurfaces];
  const int16_t* rgb[kSurfaces];  // light in three planes, `plane` samples apart
  const uint8_t* share;           // share of the pixel that the first surface covers
  size_t plane;
  // Bit c is set if all surfaces of group c of kSliceLanes pixels are used. In other groups the
  // first surface covers each pixel completely, and no other surface is read.
  uint64_t hiding;
};

// Range of the disparities of a slice: those in [low, high], and also those up to `overlap` >=
// high. The first surface is excluded from the overlap where it ends or covers only a part of the
// pixel. It would otherwise be in two slices and cover twice as much.
struct SliceRange {
  int16_t low, high, overlap;
};

// Coverage of up to 64 groups of kSliceLanes samples of a row, the first in bit 0. `some` has the
// groups of which a slice covers some pixels, `all` those of which it covers all pixels completely.
struct SliceCover {
  uint64_t some, all;
};

// A symmetric filter of 2 reach + 1 taps with 15 fractional bits. The taps are `centre` in the
// middle, `inner` at the distances 1 .. reach - 1 and `outer` at the distance `reach`. `inner` and
// `outer` are twice the tap, since they weight the mean of the samples on both sides.
struct SliceTaps {
  int32_t reach;                 // [1, kMaxSpread]
  int16_t centre, inner, outer;  // >= 0
};
inline constexpr int32_t kMaxSpread = 3;

namespace reference {

// Selects the surfaces in the range, for each pixel n < count. The output is the light of the first
// surface times its share, plus that of the next surface in the range times the rest of the pixel.
// The fourth plane is the coverage of both. All are zero if there is no surface. If both surfaces
// share a pixel, the contribution of the first one is rounded halves up. Whole groups of
// kSliceLanes are read and written; count is at most 64 groups. Returns the coverage of each group.
SliceCover SelectSlice(const SurfaceRow& row, const SliceRange& range, size_t count, size_t plane,
                       int16_t* out);

// Filters samples that are `step` apart: out[n] is the sum of the taps times in[n + k step], |k| <=
// reach, saturated. Each product with a sample, or with the mean of two (rounded halves up), is
// rounded halves up separately. Whole groups of kSliceLanes are read and written. Samples are not
// negative.
void SpreadSlice(const int16_t* in, ptrdiff_t step, const SliceTaps& taps, size_t count,
                 int16_t* out);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_SLICES_H_
