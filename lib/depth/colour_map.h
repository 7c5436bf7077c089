// SPDX-License-Identifier: Apache-2.0
// Prepares a given disparity map for a repair by colour. The functions convert the map to fixed
// point, fill unknown pixels, measure the noise, and reduce the noise by averaging disparities
// within surfaces. Other functions measure the doubt of each pixel, which is the distance from the
// pixel to the nearest pixel at which the map may be wrong.
#ifndef STARFOCUS_LIB_DEPTH_COLOUR_MAP_H_
#define STARFOCUS_LIB_DEPTH_COLOUR_MAP_H_

#include <cstdint>
#include <cstring>

#include "lib/base/fixed.h"
#include "lib/depth/maps.h"
#include "lib/io/image.h"
#include "simd/matting.h"

namespace starfocus {

// Largest doubt, in pixels, of a doubtful pixel. Pixels farther from all steps and ramps are
// assumed to be correct.
inline constexpr int32_t kDoubtReach = 5;
// Largest distance in pixels by which a map may displace a step.
inline constexpr int32_t kDisplacement = 3;
inline constexpr int32_t kThinDoubt = kDisplacement + 1;
inline constexpr int32_t kDoubtMargin = kDoubtReach + 1 + kDisplacement;

// Returns the difference between the colours of two pixels.
inline int32_t ColourDifference(const uint8_t* a, const uint8_t* b) {
  const int32_t red = a[0] - b[0], green = a[1] - b[1], blue = a[2] - b[2];
  return simd::ColourDifference(red + green + blue, red - green, green - blue);
}

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
  // Returns the distance in bytes between rows of the picture.
  size_t ColourStride() const { return RowsOf(light_field.views[0]).stride; }
};

// Calls act(k) for each doubtful pixel k of a row of `count` pixels.
template <class Act>
void ForDoubtful(const uint8_t* doubt, int32_t count, const Act& act) {
  constexpr uint64_t kNoDoubt = uint64_t{0x0101010101010101} * (kDoubtReach + 1);
  for (int32_t k = 0; k < count; ++k) {
    uint64_t eight = 0;
    if (k + 8 <= count) std::memcpy(&eight, doubt + k, sizeof eight);
    if (eight == kNoDoubt) {
      k += 7;
    } else if (doubt[k] <= kDoubtReach) {
      act(k);
    }
  }
}

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

// Returns true if any two disparities in `rect`, extended by `margin` pixels, differ by more than
// `step`.
bool HasStep(const ColourMap& map, const Rect& rect, int32_t margin, int32_t step);

// Returns true if pixel (x, y) has a neighbour in the tile that belongs to another surface.
bool IsBesideStep(const ColourMap& map, const Rect& tile, int32_t x, int32_t y);

// Computes the doubt of the pixels of `tile`. The doubt is 0 on ramps and at unknown pixels, and 1
// at steps. The doubt increases by 1 per pixel of distance from ramps, unknown pixels and steps, up
// to kDoubtReach + 1, which all pixels without doubt have. A map may have widened surfaces by
// displacing their steps. Surfaces that are too thin to have been widened have doubt kThinDoubt.
// `scratch` has one byte per pixel of the tile, extended by kDoubtMargin pixels on each side.
void MeasureDoubt(const ColourMap& map, const Rect& tile, uint8_t* scratch, uint8_t* doubt);

inline constexpr int32_t kMostSmoothRadius = 4;

// A ring buffer of kSmoothRows rows around the row that is being smoothed. Each row consists of the
// four planes of simd::SmoothRows, kSmoothPlane samples apart.
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
