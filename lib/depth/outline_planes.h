// SPDX-License-Identifier: Apache-2.0
// The planes and the picture from which the outlines of a map are found (outlines.h), and the
// widths of one pass of the search.
#ifndef STARFOCUS_LIB_DEPTH_OUTLINE_PLANES_H_
#define STARFOCUS_LIB_DEPTH_OUTLINE_PLANES_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/fixed.h"
#include "lib/base/geometry.h"
#include "simd/kernels.h"

namespace starfocus {

// Units of distances to an outline per pixel. Distances are even; a set lowest bit marks a ridge,
// which is a pixel without same-sided neighbours that are farther from the outline. The middle of a
// thin structure is a ridge, and is trusted more than other pixels at its distance.
inline constexpr int32_t kDistance = 4;
// Largest width of the band on each side, and largest radius of the windows in which outlines are
// found, in pixels.
inline constexpr int32_t kMostBand = 10, kMostOutlineRadius = 12;
// Votes compare pixels up to kVoteReach pixels beyond the width of the band. Up to kFineReach,
// every second column and row is compared, up to kCoarseReach every third, otherwise every fourth.
inline constexpr int32_t kVoteReach = 7, kMostReach = kMostBand + kVoteReach, kFineReach = 13;
inline constexpr int32_t kCoarseReach = 15;
// The cells along a row or column in which displacements are measured. Cells of kSide pixels begin
// at both borders, and a cell of 1 to 2 kSide pixels is left in the middle, so that mirrored
// pictures have mirrored cells.
struct ShiftCells {
  static constexpr int32_t kSide = 4;
  int32_t length;  // in pixels

  int32_t Half() const { return (length - 1) / (2 * kSide); }
  int32_t Count() const { return 2 * Half() + 1; }
  // Returns the cell of a pixel.
  int32_t Of(int32_t pixel) const {
    const int32_t after = length - 1 - pixel;
    if (pixel < kSide * Half()) return pixel / kSide;
    return after < kSide * Half() ? Count() - 1 - after / kSide : Half();
  }
  // Returns the first pixel of a cell, or `length` for cell Count().
  int32_t Begin(int32_t cell) const {
    return cell <= Half() ? kSide * cell : length - kSide * (Count() - cell);
  }
};

struct OutlineCounts;
union OutlineScratch;

// Planes of the size of the picture, with contiguous rows, and memory of the workers.
struct OutlineMemory {
  int32_t width, height;
  int16_t* given;      // the map (kDisparityBits)
  int16_t* repaired;   // the map after the first pass
  int16_t* middle;     // in the band: mean of the two surfaces (kDisparityBits)
  int8_t* distance;    // signed distance to the outline, in 1/kDistance pixel; 0 outside the band
  int8_t* vote;        // -127 (surely farther) to 127 (surely nearer); 0 without samples
  int8_t* side;        // the same, by the second vote; 0 where the map is kept, and outside
  int8_t* shift;       // by how much the outline approaches this cell, in 1/kDistance pixel
  uint8_t* gain;       // agreement of the votes that the shift gains, in 1/255
  uint8_t* beside;     // pixels of this cell next to an outline
  uint8_t* displaced;  // those of them that change their side as the shift demands
  uint8_t* is_right;   // 1 if the map around this cell is right
  OutlineCounts* counts;    // one for each worker
  OutlineScratch* scratch;  // one for each worker

  ShiftCells Columns() const { return {width}; }
  ShiftCells Rows() const { return {height}; }
  size_t At(int32_t x, int32_t y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x);
  }
  // Returns `rect` extended by `margin` pixels and clipped to the picture.
  Rect Widened(const Rect& rect, int32_t margin) const {
    const int32_t left = Max(rect.x - margin, 0), top = Max(rect.y - margin, 0);
    return {left, top, Min(rect.x + rect.width + margin, width) - left,
            Min(rect.y + rect.height + margin, height) - top};
  }
};

// The picture, and its tiles, which are the jobs of each phase. Results do not depend on the tiles.
struct OutlinePicture {
  const simd::DepthKernels* kernels;
  Plane<const uint8_t> rgb;
  int32_t tiles, max_workers;
  Rect (*tile)(const void* data, int32_t index);  // tiles have at most kMostOutlineTile^2 pixels
  // Sets side[] to 0 in tile `index` where the map must be kept.
  void (*keep)(const void* data, int32_t index, int8_t* side);
  // Returns true if the map has a disparity at pixel (x, y), which was not filled in.
  bool (*known)(const void* data, int32_t x, int32_t y);
  const void* data;

  const uint8_t* Pixel(int32_t x, int32_t y) const { return rgb.Row(y) + 3 * ptrdiff_t{x}; }
  Rect Tile(int32_t index) const { return tile(data, index); }
};
inline constexpr int32_t kMostOutlineTile = 384;
// Disparities of a tile follow from the pixels up to kSideReach pixels around it.
inline constexpr int32_t kSideReach = 2 * kMostBand + 4;
inline constexpr size_t kMostRegion = kMostOutlineTile + 2 * kSideReach;

// How one pass searches for outlines.
struct OutlinePass {
  int32_t ramp;     // width of the map's edges, in 1/kDistance pixel
  int32_t radius;   // radius of the windows in which outlines are found
  int32_t band;     // width of the band on each side, in pixels
  int32_t trusted;  // trust grows from 0 at trusted/10 of the width of the band to 1 at its end
  int32_t clear;    // displacements need a gain of more than clear/256

  // Returns true if the map's edges are steps between neighbours.
  bool IsHard() const { return ramp < 2 * kDistance; }
};

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_OUTLINE_PLANES_H_
