// SPDX-License-Identifier: Apache-2.0
// How blur changes across a cell that is gathered, as the cells around it tell: the radius of each
// pixel, and how far a surface that leans moves what it blurs (docs/method.md, Gathering).
#ifndef STARFOCUS_LIB_FILTER_SLOPE_H_
#define STARFOCUS_LIB_FILTER_SLOPE_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/geometry.h"
#include "lib/plan/block_stats.h"
#include "simd/kernels.h"

namespace starfocus {

// Fractional bits of radii on a slope.
inline constexpr int kSlopeBits = 10;

// The smallest and the largest blur radius of some pixels, kSlopeBits.
struct RadiusRange {
  int32_t low, high;
};

class Slope {
 public:
  // Of the cell at (column, row) of the grid at a layer. The cells around it must be stored. At a
  // corner of cells the radius is the mean of the four that meet there, nearer than the focus
  // counted as negative, and between them it is bilinear.
  Slope(const CellGrid& grid, const BlurScale& scale, int32_t column, int32_t row, int32_t layer);

  // The radii of pixels of the layer, which may lie beyond the cell.
  RadiusRange RangeOf(const Rect& pixels) const;

  // Writes by how much each of some pixels of the layer lies between two radii: share[3 n] to
  // share[3 n + 2] are that of pixel n of a row, in [0, 1], 15 fractional bits, and rows are
  // `stride` samples apart. The square of the radius counts: what lies between two kernels is as
  // wide as the one between their radii, in the mean square.
  void FindShares(const RadiusRange& between, const Rect& pixels, size_t stride,
                  int16_t* share) const;

  // How far all views together see the cell's pixels moved, of a lens whose light has the mean
  // square `spread` (MeanSquare) along an axis: `spread` times the radius times its gradient, up to
  // two pixels.
  simd::HalfMove Move(int32_t spread) const;

 private:
  int64_t Scaled(int32_t x, int32_t y) const;
  int ScaledBits() const {
    return 8 + layer_;
  }  // the square of a cell's half pixels, and the layer
  int32_t At(int32_t x, int32_t y) const;

  int32_t layer_;
  int32_t left_, top_;  // of the cell, in half pixels of the picture
  int32_t corners_[4];  // signed radii in pixels of the picture, kSlopeBits, row by row
};

}  // namespace starfocus

#endif  // STARFOCUS_LIB_FILTER_SLOPE_H_
