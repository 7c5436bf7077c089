// SPDX-License-Identifier: Apache-2.0
// Converts a light field in any format to packed RGB and float disparities of the picture's size,
// which estimates and repairs read in place.
#ifndef STARFOCUS_LIB_DEPTH_CONVERTED_FIELD_H_
#define STARFOCUS_LIB_DEPTH_CONVERTED_FIELD_H_

#include <cstddef>

#include "lib/base/jobs.h"
#include "starfocus/depth.h"

namespace starfocus {

// Memory of a converted light field.
struct ConvertedMemory {
  uint8_t* views[STARFOCUS_MAX_VIEWS];
  float* disparity;   // Null: the light field has no map.
  uint32_t* columns;  // Positions in the map of the columns of the picture (FillColumns).
};

// Lays out the memory at `base`; without a map if `has_map` is false. If `base` is null, only
// computes the size. Returns the number of bytes, or kTooLarge.
size_t LayOutConverted(const starfocus_depth_config& config, bool has_map, void* base,
                       ConvertedMemory* memory);

// Replaces the views of *field, and its map if memory.disparity is not null, by converted copies.
// Images and maps that are read in place are not copied. Disparities are rounded to 1/64 pixel and
// limited to the configured range; unknown disparities are NaN. A set has at most `most_jobs` jobs.
// Returns STARFOCUS_OK, STARFOCUS_ERROR_CANCELLED or STARFOCUS_ERROR_RUNNER.
starfocus_status ConvertField(const starfocus_depth_config& config, const ConvertedMemory& memory,
                              int32_t most_jobs, Jobs* jobs, starfocus_light_field* field);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_CONVERTED_FIELD_H_
