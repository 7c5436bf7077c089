// SPDX-License-Identifier: Apache-2.0
// The slices of a tile with the weights and offsets of all views of the aperture. Input of the
// compositor's strips.
#ifndef STARFOCUS_LIB_SLICES_SLICE_STACK_H_
#define STARFOCUS_LIB_SLICES_SLICE_STACK_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/geometry.h"
#include "lib/base/view_grid.h"
#include "lib/slices/layered_depth.h"
#include "lib/slices/slice.h"
#include "simd/kernels.h"

namespace starfocus {

// Number of views of a column that are summed in 16 bits. With more views the weights would be
// smaller, and their products with faint light would round to zero.
inline constexpr int32_t kGroupViews = 16;

// One of the equal shares of the weights of a group.
struct WeightShare {
  uint32_t index, count;
};

// Weights of views in the units of the kernels: aperture weights times scale / 2^16. A group whose
// weights exceed the limit of the kernels is added in several shares.
struct ScaledWeights {
  const ViewWeights* aperture;
  uint64_t scale;    // 21 bits
  uint32_t largest;  // largest weight of the aperture
  uint32_t
      least_covered;  // smaller sums of coverage give no colour, since rounding errors would show

  int16_t Weight(int32_t i, int32_t j, int extra_bits, const WeightShare& share) const {
    const uint64_t weight = (aperture->Weight(i, j) * (scale << extra_bits)) >> 16;
    return static_cast<int16_t>(weight * (share.index + 1) / share.count -
                                weight * share.index / share.count);
  }

  // Returns the number of shares in which the weights of views (i, first) to (i, last) are added.
  uint32_t Shares(int32_t i, int32_t first, int32_t last) const;

  // Returns the last j of the views from (i, first) to at most (i, last) whose weights have the
  // same magnitude. The magnitude is counted in powers of sixteen below the largest weight. In
  // steep openings, outer views weigh much less than the middle one. Summed with it, their products
  // with faint light would round to zero.
  int32_t LastAlike(int32_t i, int32_t first, int32_t last) const;

  // Returns the number of bits by which the scaled weights of views (i, first) to (i, last) can be
  // raised. It is 0 if a column is one group, unless all weights are of a lower power of sixteen.
  int ExtraBits(int32_t i, int32_t first, int32_t last) const;

  // Returns the largest j of the views (i, j).
  int32_t LastAcross(int32_t i) const {
    int32_t j = aperture->last;
    while (i * i + j * j > aperture->most) --j;
    return j;
  }
};

// Scales the weights of an aperture so that the sum of a group is at most kGroupSum, and each
// weight at most a quarter of it. For steep openings the limits are a multiple of that.
ScaledWeights ScaleWeights(const ViewWeights& aperture);

// A stack of slices; the nearest is the first.
struct SliceStack {
  const ViewGrid* grid;
  ScaledWeights weights;
  Rect inner;  // rectangle that contains the tile, in pixels of its surfaces
  int32_t count;
  Slice slices[kMaxSlices];
  SurfaceBands bands;                // bands of the surfaces of the slices
  const simd::SliceOffset* offsets;  // of views -N to N, `count` each

  // Returns the position of slice k in views (i, .) or (., i).
  const simd::SliceOffset& Offset(int32_t k, int32_t i) const {
    return offsets[(i + grid->n()) * count + k];
  }
};

}  // namespace starfocus

#endif  // STARFOCUS_LIB_SLICES_SLICE_STACK_H_
