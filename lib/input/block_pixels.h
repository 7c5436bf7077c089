// SPDX-License-Identifier: Apache-2.0
// The extended rectangle that a block is refocused from, as lines in the three orientations of the
// star (paper, IV-B): rows, columns (90 degrees) and diagonals (the lossless 45 degree layout).
#ifndef STARFOCUS_LIB_INPUT_BLOCK_PIXELS_H_
#define STARFOCUS_LIB_INPUT_BLOCK_PIXELS_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/geometry.h"

namespace starfocus {

// Samples from row to row of pixels that rows are transposed into: a pixel is copied with the
// sample behind it.
constexpr size_t RgbStride(int32_t width) { return 3 * static_cast<size_t>(width) + 1; }

// Pixel `column` of row `row` of `in` becomes pixel `row` of row `column` of `out`. Strides are in
// samples. A sample past the end of each row is read, and one past the end of each row of `out`
// written, in the order of the rows of `in`: so a picture can be transposed in strips of rows.
void Transpose(const int16_t* in, size_t in_stride, int32_t rows, int32_t columns, int16_t* out,
               size_t out_stride);

// A copy of the extended rectangle. Positions are oriented: in a transposed field x runs down the
// picture and y across it.
struct BlockPixels {
  bool transposed = false;
  int32_t width = 0, height = 0;  // of the extended rectangle
  int32_t x = 0, y = 0;           // of its pixel (0, 0) in the picture
  Rect inner = {0, 0, 0, 0};      // the rectangle itself, in pixels of the field
  int16_t* rgb = nullptr;         // light: rows of RgbStride(width) samples
  int16_t* disparity = nullptr;   // rows of `width`, kDisparityBits

  int16_t* Rgb(int32_t column, int32_t row) const {
    return rgb + static_cast<size_t>(row) * RgbStride(width) + 3 * static_cast<size_t>(column);
  }
  int16_t* Disparity(int32_t column, int32_t row) const {
    return disparity + static_cast<size_t>(row) * static_cast<size_t>(width) +
           static_cast<size_t>(column);
  }
};

// Rows become columns; to->disparity, or after it to->rgb, must be set and differ from `from`'s.
void TransposeDisparity(const BlockPixels& from, BlockPixels* to);
void TransposePixels(const BlockPixels& from, BlockPixels* to);

// The diagonal lines of a field: direction (1, 1), or (1, -1) when anti.
struct Diagonals {
  bool anti = false;
  int16_t* rgb = nullptr;  // all lines packed one after the other
  int16_t* disparity = nullptr;
  uint32_t* offsets = nullptr;  // pixels before each line; Count(field) of them

  static int32_t Count(const BlockPixels& field) { return field.width + field.height - 1; }
};

// Where diagonal `index` of a field starts, and its number of pixels; it goes on to (x + t, y + t),
// or (x + t, y - t) when anti.
struct DiagonalLine {
  int32_t x, y, length;
};
DiagonalLine GetDiagonal(const BlockPixels& field, bool anti, int32_t index);

// Copies the diagonals; the arrays must be set, each with room for the whole field.
void LoadDiagonals(const BlockPixels& field, bool anti, Diagonals* diagonals);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_INPUT_BLOCK_PIXELS_H_
