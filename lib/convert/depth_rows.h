// SPDX-License-Identifier: Apache-2.0
// Rows of depth maps as rows of a picture's disparities.
#ifndef STARFOCUS_LIB_CONVERT_DEPTH_ROWS_H_
#define STARFOCUS_LIB_CONVERT_DEPTH_ROWS_H_

#include <cstddef>
#include <cstdint>

#include "simd/image_kernels.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// A depth map for a picture.
struct DepthSource {
  starfocus_depth_map map;
  simd::DepthRule rule;
  int32_t width, height;  // of the picture
  const uint32_t*
      columns;        // of the picture, in the map (simd::SpreadRow); null: the map is as wide
  int32_t first = 0;  // row of the picture that `map` begins with, if it is as high
};

// Fills in where each column of pictures of that width lies in the map.
void FillColumns(int32_t width, int32_t map_width, uint32_t* columns);

// Returns the map for pictures of `config`, with the columns that FillColumns made.
DepthSource MakeDepthSource(const starfocus_config& config, const starfocus_depth_map& map,
                            const uint32_t* columns);

// Returns the bytes of a value.
size_t DepthBytes(int32_t type);

// Writes the disparities of row y of the picture, kDisparityBits; unknown ones are kNoSurface.
// Returns simd::DepthFlags of the values they were made of.
uint32_t ReadDepthRow(const simd::ImageKernels& kernels, const DepthSource& depth, int32_t y,
                      int16_t* out);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_CONVERT_DEPTH_ROWS_H_
