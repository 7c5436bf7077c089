// SPDX-License-Identifier: Apache-2.0
// The slices of a tile, as all views of the aperture show them.
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

// Views of a column that are summed in 16 bits. Of more, and so smaller, weights products with
// faint light would be rounded to nothing.
inline constexpr int32_t kGroupViews = 16;

// One of the equal shares of the weights of a group.
struct WeightShare {
  uint32_t index, count;
};

// Weights of views as the kernels sum them: aperture weights times scale / 2^16. A group of larger
// weights than the kernels take is added share by share.
struct ScaledWeights {
  const ViewWeights* aperture;
  uint64_t scale;          // 21 bits
  uint32_t largest;        // weight of the aperture
  uint32_t least_covered;  // sums of less than this are no colour: what rounding adds would show

  int16_t Weight(int32_t i, int32_t j, int extra_bits, const WeightShare& share) const {
    const uint64_t weight = (aperture->Weight(i, j) * (scale << extra_bits)) >> 16;
    return static_cast<int16_t>(weight * (share.index + 1) / share.count -
                                weight * share.index / share.count);
  }

  // Returns the number of shares that the weights of views (i, first) to (i, last) are added in.
  uint32_t Shares(int32_t i, int32_t first, int32_t last) const;

  // Returns the last j of the views from (i, first) to at most (i, last) whose weights are alike:
  // of the same power of sixteen below the aperture's largest. Steep openings have views of much
  // less weight than the middle one; summed with it, their products with faint light would be
  // rounded to nothing.
  int32_t LastAlike(int32_t i, int32_t first, int32_t last) const;

  // Bits that the weights of views (i, first) to (i, last) can have more than the scale gives them:
  // none with a group a column, unless all are of a lower power of sixteen.
  int ExtraBits(int32_t i, int32_t first, int32_t last) const;

  // Largest j of the views (i, j).
  int32_t LastAcross(int32_t i) const {
    int32_t j = aperture->last;
    while (i * i + j * j > aperture->most) --j;
    return j;
  }
};

// Scales the weights of an aperture so that those of a group are at most kGroupSum together, and
// each of them a quarter of it; of steep openings a multiple of that.
ScaledWeights ScaleWeights(const ViewWeights& aperture);

// The nearest slice comes first.
struct SliceStack {
  const ViewGrid* grid;
  ScaledWeights weights;
  Rect inner;  // the rectangle that the tile is a part of, in pixels of its surfaces
  int32_t count;
  Slice slices[kMaxSlices];
  SurfaceBands bands;                // of the surfaces that they are cut from
  const simd::SliceOffset* offsets;  // of views -N to N, `count` each

  // Where views (i, .) or (., i) show slice k.
  const simd::SliceOffset& Offset(int32_t k, int32_t i) const {
    return offsets[(i + grid->n()) * count + k];
  }
};

}  // namespace starfocus

#endif  // STARFOCUS_LIB_SLICES_SLICE_STACK_H_
