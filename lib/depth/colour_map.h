// SPDX-License-Identifier: Apache-2.0
// Prepares a given disparity map for a repair by colour. The functions convert the map to fixed
// point, fill unknown pixels, measure the noise, and reduce the noise by averaging disparities
// within surfaces.
#ifndef STARFOCUS_LIB_DEPTH_COLOUR_MAP_H_
#define STARFOCUS_LIB_DEPTH_COLOUR_MAP_H_

#include <cstdint>
#include <cstring>

#include "lib/base/fixed.h"
#include "lib/depth/maps.h"
#include "lib/io/image.h"
#include "simd/matting.h"

namespace starfocus {

// Converts a disparity to fixed point (kDisparityBits). Halves are rounded away from zero.
inline int16_t ToFixed(float disparity) {
  const float scaled = disparity * (1 << kDisparityBits);
  return static_cast<int16_t>(scaled < 0 ? scaled - 0.5F : scaled + 0.5F);
}

// Input of the jobs of a repair: the picture, the given map, and the given map in fixed point. A
// row of the fixed-point map has setup.width disparities.
struct ColourMap {
  const SweepSetup& setup;
  const starfocus_light_field& light_field;
  const int16_t* disparity;

  const uint8_t* Pixel(int32_t x, int32_t y) const {
    const Plane<const uint8_t> view = RowsOf(light_field.views[0]);
    return static_cast<const uint8_t*>(view.data) + static_cast<size_t>(y) * view.stride +
           3 * static_cast<size_t>(x);
  }
};

// Converts rows of light_field.depth to fixed point. A pixel that is not finite gets the
// disparity of the nearest finite pixel in its row. If two finite pixels are equally near, the
// smaller disparity is copied. Rows without a finite pixel remain unknown.
void ReadRows(const SweepSetup& setup, const starfocus_light_field& light_field, const Range& rows,
              int16_t* disparity);

// Copies rows without a finite pixel from the nearest row with a finite pixel. If two rows are
// equally near, the smaller disparities are copied. At least one row must have a finite pixel. Call
// FillUnknownRows after ReadRows has read all rows.
void FillUnknownRows(const SweepSetup& setup, int16_t* disparity);

// Number of differences that CountNoise counts apart. The last one stands for all larger ones.
inline constexpr int32_t kNoiseCounts = 1024;

// Adds the pixels of `rows`, except the pixels at the edges of the picture, to the numbers of
// pixels by the absolute difference between four times the pixel's disparity and the sum of the
// disparities of its neighbours.
void CountNoise(const SweepSetup& setup, const int16_t* disparity, const Range& rows,
                uint32_t* counts);

// Returns the standard deviation of the map's noise in kDisparityBits from the numbers of
// CountNoise, or 0 if the noise is invisible. The deviation is computed from the median difference
// between a pixel and the mean of its neighbours. Edges do not affect the median.
int32_t NoiseOf(const uint32_t* counts);

inline constexpr int32_t kMostSmoothRadius = 4;

// A ring buffer of kSmoothRows rows around the row that is being smoothed. Each row consists of the
// four planes that SmoothDisparity reads, kSmoothPlane samples apart.
inline constexpr int32_t kSmoothRows = 2 * kMostSmoothRadius + 1;
inline constexpr int32_t kSmoothPlane = kMostTileSide + 2 * kMostSmoothRadius;
inline constexpr size_t kSmoothSamples = size_t{kSmoothRows} * 4 * kSmoothPlane;

// Smooths the pixels of `tile` and writes the smoothed disparities to the map `smooth`. A pixel is
// averaged with every `step`-th neighbour within `radius` pixels, at most kMostSmoothRadius, whose
// disparity differs by at most `tolerance` (kDisparityBits). Neighbours of similar colour have the
// largest weights. `ring` is scratch memory of kSmoothSamples samples.
void SmoothTile(const ColourMap& map, int32_t radius, int32_t step, int32_t tolerance,
                const Rect& tile, const simd::DepthKernels& kernels, int32_t* ring,
                int16_t* smooth);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_COLOUR_MAP_H_
