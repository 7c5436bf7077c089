// SPDX-License-Identifier: Apache-2.0
#include "lib/io/block_pixels.h"

#include <cstring>

#include "lib/base/fixed.h"

namespace starfocus {

void Transpose(const int16_t* in, size_t in_stride, int32_t rows, int32_t columns, int16_t* out,
               size_t out_stride) {
  for (int32_t row = 0; row < rows; ++row, in += in_stride, out += 3) {
    const int16_t* from = in;
    int16_t* to = out;
    for (int32_t column = 0; column < columns; ++column, from += 3, to += out_stride) {
      std::memcpy(to, from, 4 * sizeof(*to));
    }
  }
}

void TransposePixels(const BlockPixels& from, BlockPixels* to) {
  Transpose(from.rgb, RgbStride(from.width), from.height, from.width, to->rgb,
            RgbStride(to->width));
}

void TransposeDisparity(const BlockPixels& from, BlockPixels* to) {
  to->transposed = !from.transposed;
  to->width = from.height;
  to->height = from.width;
  to->x = from.y;
  to->y = from.x;
  to->inner = {from.inner.y, from.inner.x, from.inner.height, from.inner.width};
  for (int32_t row = 0; row < to->height; ++row) {
    int16_t* disparity = to->Disparity(0, row);
    const int16_t* from_disparity = from.Disparity(row, 0);
    for (int32_t column = 0; column < to->width; ++column, from_disparity += from.width) {
      disparity[column] = *from_disparity;
    }
  }
}

DiagonalLine GetDiagonal(const BlockPixels& field, bool anti, int32_t index) {
  const int32_t x = Max(0, index - (field.height - 1));
  const int32_t y = anti ? Min(index, field.height - 1) : Max(0, field.height - 1 - index);
  const int32_t rest = anti ? y + 1 : field.height - y;
  return {x, y, Min(field.width - x, rest)};
}

void LoadDiagonals(const BlockPixels& field, bool anti, Diagonals* diagonals) {
  diagonals->anti = anti;
  uint32_t offset = 0;
  const ptrdiff_t step = anti ? 1 - ptrdiff_t{field.width} : 1 + ptrdiff_t{field.width};
  const auto stride = static_cast<ptrdiff_t>(RgbStride(field.width));
  const ptrdiff_t rgb_step = anti ? 3 - stride : 3 + stride;
  for (int32_t index = 0; index < Diagonals::Count(field); ++index) {
    const DiagonalLine line = GetDiagonal(field, anti, index);
    diagonals->offsets[index] = offset;
    const int16_t* from = field.Rgb(line.x, line.y);
    const int16_t* from_disparity = field.Disparity(line.x, line.y);
    for (int32_t t = 0; t < line.length; ++t, ++offset) {
      std::memcpy(diagonals->rgb + 3 * size_t{offset}, from, 3 * sizeof(*from));
      diagonals->disparity[offset] = *from_disparity;
      from += rgb_step;
      from_disparity += step;
    }
  }
}

}  // namespace starfocus
