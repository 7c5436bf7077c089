// SPDX-License-Identifier: Apache-2.0
// Reduces the noise of a disparity map by averaging disparities within surfaces.
#ifndef STARFOCUS_LIB_DEPTH_COLOUR_SMOOTH_H_
#define STARFOCUS_LIB_DEPTH_COLOUR_SMOOTH_H_

#include <cstdint>

#include "lib/depth/colour_map.h"
#include "simd/depth_kernels.h"

namespace starfocus {

inline constexpr int32_t kMostSmoothRadius = 4;

// Parameters for smoothing a map. A pixel is averaged with every `step`-th neighbour within
// `radius` pixels whose disparity differs by at most `tolerance` (kDisparityBits). Neighbours of
// similar colour have the largest weights.
struct Smoothing {
  int32_t radius, step, tolerance;
};

// A ring buffer of rows around the row that is being smoothed. Each row consists of the planes of
// simd::SmoothRows.
struct SmoothMemory {
  static constexpr int32_t kRows = 2 * kMostSmoothRadius + 1;
  static constexpr int32_t kPlane = kMostTileSide + 2 * kMostSmoothRadius;

  int32_t rows[kRows][4 * kPlane];
};

// Smooths the pixels of `tile` and writes the smoothed disparities to the map `smooth`.
void SmoothTile(const ColourMap& map, const Smoothing& smoothing, const Rect& tile,
                const simd::DepthKernels& kernels, SmoothMemory* memory, int16_t* smooth);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_COLOUR_SMOOTH_H_
