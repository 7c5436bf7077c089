// SPDX-License-Identifier: Apache-2.0
// Loads the pixels from which a block is refocused: copies the pixels of an extended rectangle, and
// continues surfaces beyond the edges of the picture.
#ifndef STARFOCUS_LIB_IO_BLOCK_PIXELS_H_
#define STARFOCUS_LIB_IO_BLOCK_PIXELS_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/geometry.h"
#include "lib/io/input.h"

namespace starfocus {

// Stride in samples between the rows of an RGB picture that can be transposed. The extra sample at
// the end of a row exists because transposing copies each pixel together with the sample after it.
constexpr size_t RgbStride(int32_t width) { return 3 * static_cast<size_t>(width) + 1; }

// Copy of the pixels of an extended rectangle: a rectangle and its border. Coordinates are
// oriented: in a transposed field, x runs down the picture and y runs across.
struct BlockPixels {
  bool transposed = false;
  int32_t width = 0, height = 0;  // Size of the extended rectangle.
  int layer = 0;                  // Layer L of the pixels.
  int32_t x = 0, y = 0;           // Position of pixel (0, 0) in the layer.
  Rect inner = {0, 0, 0, 0};      // The rectangle without its border, in pixels of the field.
  int16_t* rgb = nullptr;         // Light: rows of RgbStride(width) samples.
  int16_t* disparity = nullptr;   // Rows of `width` samples, kDisparityBits.

  int16_t* Rgb(int32_t column, int32_t row) const {
    return rgb + static_cast<size_t>(row) * RgbStride(width) + 3 * static_cast<size_t>(column);
  }
  int16_t* Disparity(int32_t column, int32_t row) const {
    return disparity + static_cast<size_t>(row) * static_cast<size_t>(width) +
           static_cast<size_t>(column);
  }
};

// Number of pixels inside the picture's edge that are searched for surfaces that may cover a pixel
// outside. The rows stored around a stripe suffice for a search over kSearchBack pixels. If
// disparities differ by less than kSearchBack, a search over fewer pixels finds all covering
// surfaces (docs/constants.md).
inline constexpr int32_t kSearchBack = 32;

// Writes the light of `count` pixels of a layer of the centre view. The pixels start at (x, y) and
// must be inside the layer.
void LoadLight(const Input& input, int layer, int32_t x, int32_t y, int32_t count, int16_t* rgb);

// Copies `rect` of a layer and its border to field->rgb and field->disparity, which must be set.
// Each sample of the centre view is decoded once for all views of the aperture. Pixels outside the
// picture repeat its edge, or continue the surface at the edge with the content of side views.
void LoadBlock(const Input& input, int layer, const Rect& rect, const Border& border,
               BlockPixels* field);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_IO_BLOCK_PIXELS_H_
