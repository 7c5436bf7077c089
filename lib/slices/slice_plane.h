// SPDX-License-Identifier: Apache-2.0
// Defines the slice: the part of a scene within a range of disparities so narrow that all pixels
// move together from view to view. Also defines the limits on the size of buckets and on the number
// of slices in a bucket, and divides the surfaces of a bucket into slices (slices.cc).
//
// A slice plane stores a slice of a batch of a bucket: the pixels of the part and the surrounding
// pixels that some view shows. The stored pixels already include the blur of wide subapertures.
// Also computes the position of the slice in each view.
#ifndef STARFOCUS_LIB_SLICES_SLICE_PLANE_H_
#define STARFOCUS_LIB_SLICES_SLICE_PLANE_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/fixed.h"
#include "lib/base/geometry.h"
#include "lib/optics/view_grid.h"
#include "lib/slices/layered_depth.h"
#include "simd/kernels.h"

namespace starfocus {

// Limits on the number and thickness of the slices of a bucket. The compositor makes the slices
// coarser until all limits hold.
struct SliceRule {
  int32_t most;  // largest number of slices
  // Range of the disparities of a slice. The range is stated as the distance by which the nearest
  // and farthest disparity move apart at the rim of the aperture, in pixels of the layer
  // (kShiftBits). For blur radii above twice kSliceSharp, the range is proportional to the blur
  // radius minus kSliceSharp.
  int32_t range;
  int32_t area = 0;  // largest sum of SliceArea over all slices: MostSliceArea for the lens
};
inline constexpr int32_t kSliceSharp = 4 * kShiftOne;
inline constexpr SliceRule kSlices = {16, 3 * kShiftOne / 8};
inline constexpr SliceRule kFineSlices = {32, kShiftOne / 8};  // limits for mode `benchmark`
inline constexpr int32_t kMaxSlices = simd::kMaxSeen;

// A bucket is a part of a rectangle of the picture, and has its own slices. Large blocks are
// divided into buckets, because a large block may have more disparities than SliceRule::most thin
// slices can hold. Buckets are kBucket pixels wide and high, except that the last bucket may have
// up to kMostBucket pixels. A block that measures 68 pixels with its border is therefore one
// bucket, not two buckets of 64 and 4 pixels.
inline constexpr int32_t kBucket = 64;
inline constexpr int32_t kMostBucket = 80;

// Returns the side of the next bucket of a rectangle, of which `rest` pixels are not yet in a
// bucket.
constexpr int32_t SideOfBucket(int32_t rest) { return rest <= kMostBucket ? rest : kBucket; }

// Returns the side of the largest bucket of rectangles whose sides are at most `side` pixels.
constexpr int32_t LargestBucket(int32_t side) { return side < kMostBucket ? side : kMostBucket; }

// Size in pixels of the smallest batch of a bucket for which slices are made.
inline constexpr int32_t kLeastColumns = static_cast<int32_t>(simd::kSliceLanes);
inline constexpr int32_t kLeastRows = 8;

// A slice contains the disparities [low, high] (kDisparityBits); all pixels of the slice move like
// `disparity`. Slightly nearer disparities, up to `overlap`, belong to two slices: to this slice
// and to the next nearer slice. The overlap prevents gaps between the two slices.
struct Slice {
  int16_t low, high, overlap, disparity;
};

// Width of the largest subaperture that is applied during the shift, as a box over up to four
// pixels (kShiftBits). Wider subapertures are applied as a filter before the shift; compared with
// such a filter, the blur that interpolation adds is small.
inline constexpr int32_t kBoxSubaperture = 3 * kShiftOne;

// Returns the number of pixels on each side over which the filter of `subaperture` (kShiftBits)
// spreads a pixel. Returns 0 if no filter is applied before the shift.
constexpr int32_t SpreadRadius(int32_t subaperture) {
  static_assert(simd::kMaxSpread == 3, "wider boxes are cut off");
  return subaperture <= kBoxSubaperture ? 0 : subaperture <= 5 * kShiftOne ? 2 : simd::kMaxSpread;
}

// Returns the number of pixels beyond the rectangle that a slice of blur radius `rim` must include
// (`rim` and `subaperture` have kShiftBits). The result is the blur radius, rounded up, plus the
// reach of filters, boxes and interpolation.
constexpr int32_t SliceReach(int32_t rim, int32_t subaperture) {
  const bool is_box = subaperture > kShiftOne && subaperture <= kBoxSubaperture;
  return ((rim + kShiftOne - 1) >> kShiftBits) + (is_box ? 2 : SpreadRadius(subaperture) + 1);
}

// Subaperture for which SliceReach is largest (kShiftBits). Wider subapertures do not increase the
// reach of a slice.
inline constexpr int32_t kWidestSubaperture = 8 * kShiftOne;

// Returns the largest SliceReach for lenses with blur radii up to `max_blur` pixels, any N and the
// widest subapertures. The border kRounding covers the error of rounding the focus and a disparity
// to kDisparityBits. The border kRounding also covers the distance from the middle of a slice to
// its pixels. If a disparity bin holds several disparities (kSliceBins), the distance from the
// middle is up to two units of disparity.
constexpr int32_t LargestSliceReach(double max_blur) {
  constexpr double kRounding = 4.0 / (1 << kDisparityBits);
  const double rim = (max_blur + kRounding) * LargestSubapertureExtent() * kShiftOne;
  return SliceReach(static_cast<int32_t>(rim) + 1, kWidestSubaperture);
}

// Returns an area in pixels that measures the memory and the time that a slice costs. `reach` is
// the number of pixels by which the slice extends beyond a small batch of a bucket.
constexpr int32_t SliceArea(int32_t reach) { return (reach + 16) * (reach + 16); }

// Returns the largest sum of SliceArea over the slices of a bucket, for a lens with blur radii up
// to `blur` pixels. The sum allows five slices with a blur radius of `blur` or 32 pixels, whichever
// is larger. The limit determines how finely a bucket is divided into slices, and therefore the
// output bytes. To keep the output independent of memory, the limit depends only on the lens, not
// on the available memory or the storage format of slices.
constexpr int32_t MostSliceArea(double blur) {
  constexpr int32_t kLeastBlur = 32, kMargin = 3;
  return 5 * SliceArea(Max(static_cast<int32_t>(blur), kLeastBlur) + kMargin);
}

// Number of disparity bins. A bin holds a single disparity up to a blur of 64 pixels at full
// aperture.
inline constexpr int32_t kSliceBins = 2 * (64 << kDisparityBits) + 1;

// Finds the slices of a bucket, ordered from the nearest to the farthest. The slices hold all
// pixels of the surfaces that may splat into the bucket, which is in pixels of the surfaces.
// Returns the number of slices, at most rule.most.
int32_t FindSlices(const simd::Kernels& kernels, const LayeredDepth& surfaces, const ViewGrid& grid,
                   const SliceRule& rule, const Rect& bucket, Slice* slices);

// Finds the ranges of the disparities of all surfaces (LayeredDepth::ranges), which FindSlices and
// FillSlice read.
void FindStripRanges(const simd::Kernels& kernels, const LayeredDepth& surfaces);

struct SlicePlane {
  int32_t reach = 0;  // Number of pixels that the slice extends beyond the rectangle on each side.
  int32_t rows = 0;   // Number of rows of the rectangle, plus `reach` rows above and below.
  size_t plane = 0;   // Distance between planes in samples; a row has four planes.
  int32_t subaperture = 0;  // Width of a view's subaperture, kShiftBits.
  // Samples of the first row. Rows that the slice does not cover (`some` is 0) are not written.
  int16_t* samples = nullptr;
  simd::SliceCover* cover = nullptr;  // Coverage bits of each row.
};

// Returns the distance in samples between the planes of a slice that extends `reach` pixels beyond
// a rectangle.
constexpr size_t PlaneSamples(size_t width, size_t reach) {
  return simd::SliceSamples(simd::SliceSamples(width) + 2 * reach) + simd::kSliceLanes;
}
// Returns the size in bytes of one SliceCover for each of `rows` rows, rounded up to keep the
// alignment of the samples that follow.
constexpr size_t CoverBytes(size_t rows) {
  constexpr size_t kAligned = 4;
  return (rows + kAligned - 1) / kAligned * kAligned * sizeof(simd::SliceCover);
}

// Returns the size in bytes of `rows` rows of a slice.
constexpr size_t SliceRowBytes(size_t width, size_t rows, size_t reach) {
  return 4 * rows * PlaneSamples(width, reach) * sizeof(int16_t);
}

// Number of filtered rows in the buffer of FillSlice, and size of this buffer in bytes.
inline constexpr int32_t kFilteredRows = 2 * simd::kMaxSpread + 1;
constexpr size_t FilteredBytes(size_t width, size_t reach) {
  return SliceRowBytes(width, kFilteredRows, reach);
}

// Returns the size in bytes of a slice, including one SliceCover per row, and the samples that
// filters read before and after the slice.
constexpr size_t SliceBytes(size_t width, size_t height, size_t reach) {
  return SliceRowBytes(width, height + 2 * reach, reach) + 2 * simd::kSliceLanes * sizeof(int16_t) +
         CoverBytes(height + 2 * reach);
}

// Returns the number of rows in a strip of a slice of `rows` rows, including rows that are read
// after the last one.
constexpr size_t StripRows(size_t rows) { return rows + simd::kRowsAhead; }

// Returns the size in bytes of a slice in a strip, including its coverage.
constexpr size_t StripBytes(size_t height, size_t reach) {
  const size_t rows = StripRows(height + 2 * reach);
  return rows * simd::kStripRow * sizeof(int16_t) + simd::RowCovers(rows) * sizeof(simd::RowCover);
}

// Finds the position of each slice in each view. `offsets` has `count` elements, one per slice, for
// each view from -N to N along an axis.
void FindOffsets(const ViewGrid& grid, const Slice* slices, int32_t count,
                 simd::SliceOffset* offsets);

// Computes the size and the reach of the slice around `rect`.
void PlaceSlice(const ViewGrid& grid, int16_t disparity, const Rect& rect, SlicePlane* placed);

// Copies the slice's pixels in and around `rect`, which is in pixels of the surfaces. Repeats the
// outermost pixels beyond the ends of the surfaces. For wide subapertures, the function also
// applies the subaperture as a filter. `filtered` is scratch memory of FilteredBytes. Skips strips
// whose ranges contain no disparity of the slice. The caller sets the pointers `samples` and
// `cover` of `placed`. Returns the number of pixels that were read.
uint64_t FillSlice(const simd::Kernels& kernels, const LayeredDepth& surfaces, const Slice& slice,
                   const Rect& rect, int16_t* filtered, const SlicePlane& placed);

// Returns the strips of a slice's row that some view shows in the strip at column `x` of the
// rectangle. Bit k of the result stands for strip k of the row, as in SliceCover.
constexpr uint64_t StripsOf(const SlicePlane& placed, int32_t x) {
  const int32_t first = x / simd::kStripColumns,
                last = (x + simd::kStripColumns - 1 + 2 * placed.reach) / simd::kStripColumns;
  return (uint64_t{2} << last) - (uint64_t{1} << first);
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_SLICES_SLICE_PLANE_H_
