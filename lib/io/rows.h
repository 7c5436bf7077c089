// SPDX-License-Identifier: Apache-2.0
// Access to formats that the engine reads in place, without conversion: packed RGB and float
// disparities.
#ifndef STARFOCUS_LIB_IO_ROWS_H_
#define STARFOCUS_LIB_IO_ROWS_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/geometry.h"
#include "starfocus/image.h"

namespace starfocus {

inline bool IsInPlace(const starfocus_image& image) {
  return image.format == STARFOCUS_FORMAT_RGB &&
         (image.pixel_stride == 0 || image.pixel_stride == 3);
}

inline bool IsInPlace(const starfocus_depth_map& map, int32_t width, int32_t height) {
  return map.type == STARFOCUS_DEPTH_FLOAT && map.meaning == STARFOCUS_DEPTH_LINEAR &&
         map.scale == 1 && map.offset == 0 && map.has_invalid == 0 && map.width == width &&
         map.height == height;
}

// Returns the rows of a packed RGB image. The first row of the image is row `first` of the picture.
inline Plane<const uint8_t> RowsOf(const starfocus_image& image, int32_t first = 0) {
  return {static_cast<const uint8_t*>(image.planes[0]), image.strides[0], 0, first};
}

// Returns the rows of a map of float disparities.
inline Plane<const float> RowsOf(const starfocus_depth_map& map) {
  return {static_cast<const float*>(map.data), map.stride / sizeof(float), 0, 0};
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_IO_ROWS_H_
