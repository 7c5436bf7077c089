// SPDX-License-Identifier: Apache-2.0
// Divides the surfaces of a tile into slices: ranges of disparity so narrow that the pixels of a
// slice move together from view to view. The compositor calls FindSlices for each tile.
#ifndef STARFOCUS_LIB_SLICES_SLICES_H_
#define STARFOCUS_LIB_SLICES_SLICES_H_

#include <cstdint>

#include "lib/base/geometry.h"
#include "lib/optics/view_grid.h"
#include "lib/slices/layered_depth.h"
#include "lib/slices/slice_plane.h"
#include "simd/kernels.h"

namespace starfocus {

// Number of disparity bins. A bin holds a single disparity up to a blur of 64 pixels at full
// aperture.
inline constexpr int32_t kSliceBins = 2 * (64 << kDisparityBits) + 1;

// Finds the slices of a tile, ordered from the nearest to the farthest. The slices hold all pixels
// of the surfaces that may splat into the tile, which is in pixels of the surfaces. Also finds the
// range of disparities in each of the kMaxBands bands of the surfaces, for FillSlice. Returns the
// number of slices, at most rule.most.
int32_t FindSlices(const simd::Kernels& kernels, const LayeredDepth& surfaces, const ViewGrid& grid,
                   const SliceRule& rule, const Rect& tile, Slice* slices,
                   simd::DisparityRange* bands);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_SLICES_SLICES_H_
