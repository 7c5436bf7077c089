// SPDX-License-Identifier: Apache-2.0
// Accesses the given map of a repair and the output planes of a map.
#ifndef STARFOCUS_LIB_DEPTH_MAP_ROWS_H_
#define STARFOCUS_LIB_DEPTH_MAP_ROWS_H_

#include <cstddef>
#include <cstdint>

#include "lib/io/rows.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Output planes of a map. Disparities are clamped to [lowest, highest]; confidence and coverage may
// be null.
struct MapOutput {
  float* disparity;
  size_t stride;  // distance between rows of `disparity`, in floats
  float lowest, highest;
  uint8_t* confidence;
  size_t confidence_stride;
  uint8_t* coverage;
  size_t coverage_stride;

  float Clamped(float value) const {
    return value < lowest ? lowest : value > highest ? highest : value;
  }
};

// Returns row y of the given map.
inline const float* GivenAt(const starfocus_light_field& light_field, int32_t y) {
  return RowsOf(light_field.depth).Row(y);
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_MAP_ROWS_H_
