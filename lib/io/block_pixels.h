// SPDX-License-Identifier: Apache-2.0
// Stores the pixels from which a block is refocused, as lines in three orientations (paper, IV-B).
// The lines are rows, columns (90 degrees) and diagonals (the lossless 45 degree layout). Line
// scans, and the blur without views (lib/gather/gather.h), read these lines.
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

// Transposes pixels: pixel `column` of row `row` of `in` becomes pixel `row` of row `column` of
// `out`. Strides are in samples. The function reads one sample past the end of each row of `in` and
// writes one sample past the end of each row of `out`. Rows of `in` are read in order, so a picture
// can be transposed in strips of rows.
void Transpose(const int16_t* in, size_t in_stride, int32_t rows, int32_t columns, int16_t* out,
               size_t out_stride);

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

// Transpose a field. The output array (to->disparity or to->rgb) must be set and must differ from
// the input array. TransposeDisparity must be called before TransposePixels.
void TransposeDisparity(const BlockPixels& from, BlockPixels* to);
void TransposePixels(const BlockPixels& from, BlockPixels* to);

// Diagonal lines of a field in direction (1, 1), or (1, -1) if `anti`.
struct Diagonals {
  bool anti = false;
  int16_t* rgb = nullptr;  // all lines, packed
  int16_t* disparity = nullptr;
  uint32_t* offsets = nullptr;  // number of pixels stored before each of the Count(field) lines

  static int32_t Count(const BlockPixels& field) { return field.width + field.height - 1; }
};

// Start and length of a diagonal in pixels. From pixel to pixel of the diagonal, x increases by 1,
// and y increases by 1, or decreases by 1 if `anti`.
struct DiagonalLine {
  int32_t x, y, length;
};
DiagonalLine GetDiagonal(const BlockPixels& field, bool anti, int32_t index);

// Copies all diagonals of a field. The arrays of `diagonals` must be set, and each array must have
// room for the whole field.
void LoadDiagonals(const BlockPixels& field, bool anti, Diagonals* diagonals);

// Extends surfaces beyond the edges of the picture with the content of side views.

// Number of pixels inside the picture's edge that are searched for surfaces that may cover a pixel
// outside. The rows stored around a stripe suffice for a search over kLookBack pixels. If
// disparities differ by less than kLookBack, a search over fewer pixels finds all covering surfaces
// (docs/constants.md).
inline constexpr int32_t kLookBack = 32;

// In a field, replaces the repeated edge pixels of the picture by a continuation of the surface at
// the edge. Pixels beyond the edge get their colour from the captured view that shows them. The
// number of pixels that the view shows is the displacement of the edge in that view. The continued
// surface ends earlier if a nearer surface covers the continued surface in the captured view.
// Pixels farther outside repeat the colour of the last continued pixel. Pixels beyond corners, and
// fields of light fields without side views, are not changed.
void ExtendEdges(const Input& input, BlockPixels* field);

// Writes the light of `count` pixels of a layer of the centre view. The pixels start at (x, y) and
// must be inside the layer.
void LoadLight(const Input& input, int layer, int32_t x, int32_t y, int32_t count, int16_t* rgb);

// Copies `rect` of a layer and its border to field->rgb and field->disparity, which must be set.
// Each sample of the centre view is decoded once for all views of the aperture. Pixels outside the
// picture repeat its edge, or contain the content of side views (ExtendEdges).
void LoadBlock(const Input& input, int layer, const Rect& rect, const Border& border,
               BlockPixels* field);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_IO_BLOCK_PIXELS_H_
