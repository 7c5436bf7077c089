// SPDX-License-Identifier: Apache-2.0
// Depth maps of any type and meaning: reads their values, converts rows to rows of disparities at
// the size of the picture, and fills unknown disparities.
#ifndef STARFOCUS_LIB_IO_DEPTH_MAP_H_
#define STARFOCUS_LIB_IO_DEPTH_MAP_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/geometry.h"
#include "simd/depth_values.h"
#include "simd/kernels.h"
#include "starfocus/image.h"
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

inline bool IsInPlace(const starfocus_depth_map& map, int32_t width, int32_t height) {
  return map.type == STARFOCUS_DEPTH_FLOAT && map.meaning == STARFOCUS_DEPTH_LINEAR &&
         map.scale == 1 && map.offset == 0 && map.has_invalid == 0 && map.width == width &&
         map.height == height;
}

// Returns the rows of a map of float disparities.
inline Plane<const float> RowsOf(const starfocus_depth_map& map) {
  return {static_cast<const float*>(map.data), map.stride / sizeof(float), 0, 0};
}

// Largest number of columns that ReadDepth converts at once, in arrays on the stack. Wider
// rectangles are divided into pieces of this width.
inline constexpr int32_t kDepthPiece = 255;

// A depth map and the size of its picture.
struct DepthSource {
  starfocus_depth_map map;
  simd::DepthRule rule;
  int32_t width, height;  // size of the picture
  // Positions in the map of columns of the picture (simd::UpsampleRow), starting with
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
// call for each row. Returns the flags (simd::kUnknownDepth) of the source values.
uint32_t ReadDepth(const simd::ImageKernels& kernels, const DepthSource& depth, const Rect& rect,
                   const Plane<int16_t>& out);

// Returns the flags (simd::kUnknownDepth) of the values of the map that ReadDepth reads for whole
// rows.
uint32_t CheckDepth(const simd::ImageKernels& kernels, const DepthSource& depth, const Range& rows);

// Returns true if a disparity is known, that is, neither NaN nor infinite.
inline bool IsFinite(float value) { return value - value == 0.0f; }

// Fills the elements between the known elements `left` and `right`. If `left` is -1 or `right` is
// `length`, the line has no known element on that side of the gap. A gap between two surfaces gets
// the farther disparity, because unknown values at an edge mostly belong to the surface that the
// edge hides.
template <class Line>
void FillGap(const Line& line, int32_t length, int32_t left, int32_t right) {
  if (left < 0 && right >= length) return;
  const int32_t a = left < 0 ? right : left, b = right >= length ? left : right;
  const auto farther = line[a] < line[b] ? line[a] : line[b];
  for (int32_t k = left + 1; k < right; ++k) line[k] = farther;
}

// Fills all gaps of a line of `length` elements. is_known(element) returns false in gaps. Returns
// false and leaves the line unchanged if the line has no known element.
template <class Line, class IsKnown>
bool FillGaps(const Line& line, int32_t length, const IsKnown& is_known) {
  int32_t last = -1;
  for (int32_t k = 0; k <= length; ++k) {
    if (k < length && !is_known(line[k])) continue;
    FillGap(line, length, last, k);
    if (k < length) last = k;
  }
  return last >= 0;
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_IO_DEPTH_MAP_H_
