#include "lib/input/field.h"

#include <cstring>

#include "lib/input/picture_edge.h"

namespace starfocus {

namespace {

// Fills what lies outside [first, last), not empty, of a row.
void RepeatEdges(int32_t first, int32_t last, int32_t width, uint8_t* rgb, int16_t* disparity) {
  for (int32_t column = 0; column < first; ++column) {
    std::memcpy(rgb + 3 * column, rgb + 3 * first, 3);
    disparity[column] = disparity[first];
  }
  for (int32_t column = last; column < width; ++column) {
    std::memcpy(rgb + 3 * column, rgb + 3 * (last - 1), 3);
    disparity[column] = disparity[last - 1];
  }
}

}  // namespace

void LoadField(const Window& window, const Rect& rect, const Border& border, Field* field) {
  field->transposed = false;
  field->width = border.left + rect.width + border.right;
  field->height = border.top + rect.height + border.bottom;
  field->x = rect.x - border.left;
  field->y = rect.y - border.top;
  field->inner = {border.left, border.top, rect.width, rect.height};
  const int32_t first = Clamp(-field->x, 0, field->width);
  const int32_t last = Clamp(window.width - field->x, 0, field->width);  // exclusive
  for (int32_t row = 0; row < field->height; ++row) {
    const int32_t y = Clamp(field->y + row, 0, window.height - 1);
    uint8_t* rgb = field->Rgb(0, row);
    int16_t* disparity = field->Disparity(0, row);
    const uint8_t* from = window.centre.Row(y);
    const int16_t* from_disparity =
        window.disparity.Row(Min(y << window.layer, window.picture_height - 1));
    std::memcpy(rgb + 3 * first, from + 3 * (field->x + first),
                3 * static_cast<size_t>(last - first));
    if (window.layer == 0) {
      std::memcpy(disparity + first, from_disparity + field->x + first,
                  sizeof(*disparity) * static_cast<size_t>(last - first));
    } else {
      for (int32_t column = first; column < last; ++column) {
        const int32_t x = (field->x + column) << window.layer;
        disparity[column] = from_disparity[Min(x, window.picture_width - 1)];
      }
    }
    RepeatEdges(first, last, field->width, rgb, disparity);
  }
  if (window.reads != nullptr && window.layer == 0) {
    window.reads->centre_pixels +=
        static_cast<uint64_t>(last - first) * static_cast<uint64_t>(field->height);
  }
  LookBeyond(window, field);
}

void TransposePixels(const simd::Kernels& kernels, const Field& from, Field* to) {
  kernels.transpose(from.rgb, RgbStride(from.width), static_cast<size_t>(from.height),
                    static_cast<size_t>(from.width), to->rgb, RgbStride(to->width));
}

void TransposeDisparity(const Field& from, Field* to) {
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

DiagonalLine GetDiagonal(const Field& field, bool anti, int32_t index) {
  const int32_t x = Max(0, index - (field.height - 1));
  const int32_t y = anti ? Min(index, field.height - 1) : Max(0, field.height - 1 - index);
  const int32_t rest = anti ? y + 1 : field.height - y;
  return {x, y, Min(field.width - x, rest)};
}

void LoadDiagonals(const Field& field, bool anti, Diagonals* diagonals) {
  diagonals->anti = anti;
  uint32_t offset = 0;
  const ptrdiff_t step = anti ? 1 - ptrdiff_t{field.width} : 1 + ptrdiff_t{field.width};
  const auto stride = static_cast<ptrdiff_t>(RgbStride(field.width));
  const ptrdiff_t rgb_step = anti ? 3 - stride : 3 + stride;
  for (int32_t index = 0; index < Diagonals::Count(field); ++index) {
    const DiagonalLine line = GetDiagonal(field, anti, index);
    diagonals->offsets[index] = offset;
    const uint8_t* from = field.Rgb(line.x, line.y);
    const int16_t* from_disparity = field.Disparity(line.x, line.y);
    for (int32_t t = 0; t < line.length; ++t, ++offset) {
      std::memcpy(diagonals->rgb + 3 * size_t{offset}, from, 3);
      diagonals->disparity[offset] = *from_disparity;
      from += rgb_step;
      from_disparity += step;
    }
  }
}

}  // namespace starfocus
