// SPDX-License-Identifier: Apache-2.0
// Reads values of depth maps of any type and meaning.
#ifndef STARFOCUS_LIB_IO_DEPTH_VALUES_H_
#define STARFOCUS_LIB_IO_DEPTH_VALUES_H_

#include <cstddef>
#include <cstdint>

#include "simd/depth_values.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Returns the number of bytes per value of a depth map of type `type`.
size_t DepthBytes(int32_t type);

// Returns the address of value x of row y of a map.
const void* ValueAt(const starfocus_depth_map& map, int32_t x, int32_t y);

// Returns the conversion of the values of a map to disparities that are limited to [low, high].
simd::DepthRule RuleOf(const starfocus_depth_map& map, float low, float high);

// Writes the disparities of `count` values of row y of a map, starting at value x, in single
// precision. Unknown disparities are NaN. All values must be inside the map. The function uses no
// table of kernels, so that small programs do not link the table.
void ReadDisparities(const starfocus_depth_map& map, int32_t x, int32_t y, int32_t count,
                     float* out);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_IO_DEPTH_VALUES_H_
