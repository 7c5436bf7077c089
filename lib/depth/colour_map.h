// SPDX-License-Identifier: Apache-2.0
// A given disparity map, prepared for a repair by colour: converted to fixed point, with unknown
// pixels filled and its noise measured. Each pixel also gets its distance from the places where the
// map may be wrong.
#ifndef STARFOCUS_LIB_DEPTH_COLOUR_MAP_H_
#define STARFOCUS_LIB_DEPTH_COLOUR_MAP_H_

#include <cstdint>

#include "lib/base/fixed.h"
#include "lib/base/rows.h"
#include "lib/depth/estimate_plan.h"
#include "lib/depth/map_rows.h"
#include "simd/colours.h"

namespace starfocus {

// Pixels farther than this from all steps and ramps are taken as correct.
inline constexpr int32_t kDoubtReach = 5;
// Largest displacement of a step, in pixels.
inline constexpr int32_t kDisplacement = 3;
inline constexpr int32_t kThinDoubt = kDisplacement + 1;
inline constexpr int32_t kDoubtMargin = kDoubtReach + 1 + kDisplacement;

// Returns the difference of two pixels' colours.
inline int32_t ColourDifference(const uint8_t* a, const uint8_t* b) {
  const int32_t red = a[0] - b[0], green = a[1] - b[1], blue = a[2] - b[2];
  return simd::ColourDifference(red + green + blue, red - green, green - blue);
}

// Converts a disparity to kDisparityBits. Rounds halves away from zero.
inline int16_t ToFixed(float disparity) {
  const float scaled = disparity * (1 << kDisparityBits);
  return static_cast<int16_t>(scaled < 0 ? scaled - 0.5F : scaled + 0.5F);
}

// Input of jobs: the picture, the given map, and rows of `width` 16-bit disparities.
struct ColourMap {
  const EstimatePlan& plan;
  const starfocus_light_field& light_field;
  const int16_t* disparity;

  const uint8_t* Pixel(int32_t x, int32_t y) const {
    const Plane<const uint8_t> view = RowsOf(light_field.views[0]);
    return static_cast<const uint8_t*>(view.data) + static_cast<size_t>(y) * view.stride +
           3 * static_cast<size_t>(x);
  }
  size_t At(int32_t x, int32_t y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(plan.width) + static_cast<size_t>(x);
  }
};

// Converts light_field.depth, which has at least one finite pixel. Other pixels get the nearest
// finite one of their row; rows without any get the nearest row that has one. Among two equally
// near ones the farther surface is taken.
void ReadMap(const EstimatePlan& plan, const starfocus_light_field& light_field,
             int16_t* disparity);

// Returns the standard deviation of the map's noise, kDisparityBits, or 0 if it is invisible. It is
// computed from the median difference of pixels from the mean of their neighbours, which edges do
// not affect.
int32_t MeasureNoise(const EstimatePlan& plan, const int16_t* disparity);

// Returns true if two disparities in the rectangle, extended by `margin` pixels, differ by more
// than `step`.
bool HasStep(const ColourMap& map, const Rect& rect, int32_t margin, int32_t step);

// Returns true if one of the pixel's neighbours in the tile belongs to another surface.
bool IsBesideStep(const ColourMap& map, const Rect& tile, int32_t x, int32_t y);

// Fills `tile` of `doubt`. The doubt is 0 on ramps and unknown pixels and 1 at steps. It grows by
// one for each pixel away from these, up to kDoubtReach + 1. kThinDoubt marks surfaces too thin to
// have been grown by as much as steps are displaced. `scratch` has room for the tile and
// kDoubtMargin pixels around it.
void MeasureDoubt(const ColourMap& map, const Rect& tile, uint8_t* scratch, uint8_t* doubt);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_COLOUR_MAP_H_
