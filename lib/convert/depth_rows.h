// SPDX-License-Identifier: Apache-2.0
// Converts rows of depth maps to rows of disparities at the size of the picture.
#ifndef STARFOCUS_LIB_CONVERT_DEPTH_ROWS_H_
#define STARFOCUS_LIB_CONVERT_DEPTH_ROWS_H_

#include <cstddef>
#include <cstdint>

#include "simd/image_kernels.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// A depth map and the size of its picture.
struct DepthSource {
  starfocus_depth_map map;
  simd::DepthRule rule;
  int32_t width, height;  // size of the picture
  // Position in the map of each column of the picture (simd::SpreadRow); null if the map is as wide
  // as the picture.
  const uint32_t* columns;
  // First row of the picture that `map` contains; 0 if the map has fewer rows than the picture.
  int32_t first = 0;
};

// Computes the position in the map for each column of a picture.
void FillColumns(int32_t width, int32_t map_width, uint32_t* columns);

// Returns a source that converts `map` to the picture size of `config`. `columns` is the result of
// FillColumns.
DepthSource MakeDepthSource(const starfocus_config& config, const starfocus_depth_map& map,
                            const uint32_t* columns);

// Returns the number of bytes per value of a depth map of type `type`.
size_t DepthBytes(int32_t type);

// Writes the disparities of row y of the picture in fixed point (kDisparityBits). Unknown
// disparities are set to kNoSurface. Returns simd::DepthFlags of the source values.
uint32_t ReadDepthRow(const simd::ImageKernels& kernels, const DepthSource& depth, int32_t y,
                      int16_t* out);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_CONVERT_DEPTH_ROWS_H_
