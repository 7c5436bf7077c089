// SPDX-License-Identifier: Apache-2.0
// Kernels that make a slice: they select the surfaces whose disparity lies in the slice's range,
// and spread them where one slice stands for a wide part of the lens.
//
// A slice holds R, G, B and coverage as samples with 15 fractional bits. The colours are already
// multiplied by the coverage, and a pixel that the slice covers all of has the coverage kSliceOne.
// A row holds its four planes side by side, `plane` samples apart.
#ifndef STARFOCUS_SIMD_SLICES_H_
#define STARFOCUS_SIMD_SLICES_H_

#include <cstddef>
#include <cstdint>

#include "simd/layered_depth.h"
#include "simd/padding.h"

namespace starfocus::simd {

inline constexpr int16_t kSliceOne = 32767;

// A row of the surfaces at each pixel, the nearest one first. Where a pixel has fewer surfaces, the
// disparity of the others lies below any slice.
struct SurfaceRow {
  const int16_t* disparity[kSurfaces];
  const int16_t* rgb[kSurfaces];  // light in three planes, `plane` samples apart
  const uint8_t* share;           // how much of the pixel the first surface covers
  size_t plane;
  // Bit c tells whether the pixels of group c of kSliceLanes are to be looked at in full. In other
  // groups the first surface counts as all of each pixel, and nothing behind it is read.
  uint64_t hiding;
};

// The disparities that a slice takes: those in [low, high], and those up to `overlap` >= high too.
// The first surface is excluded from that overlap where it ends or covers only a part of the pixel:
// it would be in two slices, and cover twice as much.
struct SliceRange {
  int16_t low, high, overlap;
};

// For each group of kSliceLanes samples of a row, 64 groups at most, the first one in bit 0:
// whether a slice covers some of its pixels, and whether it covers all of each.
struct SliceCover {
  uint64_t some, all;
};

// A symmetric filter of 2 reach + 1 taps with 15 fractional bits: `centre` in the middle, `inner`
// at the distances 1 .. reach - 1 and `outer` at the distance `reach`. The latter two are twice the
// tap, as they weigh the mean of the samples on both sides.
struct SliceTaps {
  int32_t reach;                 // [1, kMaxSpread]
  int16_t centre, inner, outer;  // >= 0
};
inline constexpr int32_t kMaxSpread = 3;

namespace reference {

// Selects what of the surfaces lies in the range, for each pixel n < count: the light of the first
// surface by its share, plus that of the next one in the range by the rest of the pixel, and the
// coverage of both; zeros where there is none. Of a pixel that both share, what the first one
// changes is rounded halves up. Whole groups of kSliceLanes are read and written; count is 64
// groups at most. Returns what of each group is covered.
SliceCover SelectSlice(const SurfaceRow& row, const SliceRange& range, size_t count, size_t plane,
                       int16_t* out);

// Filters samples that lie `step` apart: out[n] is the sum of the taps over in[n + k step],
// |k| <= reach, saturated. Each product with a sample, or with the mean of two (halves up), is
// rounded halves up by itself. Whole groups of kSliceLanes are read and written. Samples are not
// negative.
void SpreadSlice(const int16_t* in, ptrdiff_t step, const SliceTaps& taps, size_t count,
                 int16_t* out);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_SLICES_H_
