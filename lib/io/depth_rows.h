// SPDX-License-Identifier: Apache-2.0
// Converts rows of depth maps to rows of disparities at the size of the picture.
#ifndef STARFOCUS_LIB_IO_DEPTH_ROWS_H_
#define STARFOCUS_LIB_IO_DEPTH_ROWS_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/geometry.h"
#include "lib/io/depth_values.h"
#include "simd/image_kernels.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Largest number of columns that ReadDepth converts at once, in arrays on the stack. Wider
// rectangles are divided into pieces of this width.
inline constexpr int32_t kDepthPiece = 255;

// A depth map and the size of its picture.
struct DepthSource {
  starfocus_depth_map map;
  simd::DepthRule rule;
  int32_t width, height;  // size of the picture
  // Positions in the map of columns of the picture (simd::SpreadRow), starting with
  // `first_column`; null if the map has the size of the picture.
  const uint32_t* columns;
  // First row of the picture that `map` contains; 0 if the map has fewer rows than the picture.
  int32_t first = 0;
  int32_t first_column = 0;
};

// Computes the positions in a map for the columns of a picture, starting with `first_column`.
void FillColumns(int32_t width, int32_t map_width, int32_t first_column, int32_t count,
                 uint32_t* columns);

// Writes the disparities of a rectangle of the picture in fixed point (kDisparityBits). Unknown
// disparities are set to kNoSurface. out.Row(y) receives row y, starting with column rect.x.
// Converts each value of the map at most twice, so a call for several rows takes less time than one
// call for each row. Returns simd::DepthFlags of the source values.
uint32_t ReadDepth(const simd::ImageKernels& kernels, const DepthSource& depth, const Rect& rect,
                   const Plane<int16_t>& out);

// Returns simd::DepthFlags of the values of the map that ReadDepth reads for whole rows.
uint32_t CheckDepth(const simd::ImageKernels& kernels, const DepthSource& depth, const Range& rows);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_IO_DEPTH_ROWS_H_
