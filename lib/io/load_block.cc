// SPDX-License-Identifier: Apache-2.0
#include "lib/io/load_block.h"

#include <cstring>

#include "lib/io/picture_edge.h"

namespace starfocus {
namespace {

// Fills the pixels outside [first, last) of a row with the nearest pixel inside. The range must not
// be empty.
void RepeatEdges(int32_t first, int32_t last, int32_t width, int16_t* rgb, int16_t* disparity) {
  for (int32_t column = 0; column < first; ++column) {
    std::memcpy(rgb + 3 * column, rgb + 3 * first, 3 * sizeof(*rgb));
    disparity[column] = disparity[first];
  }
  for (int32_t column = last; column < width; ++column) {
    std::memcpy(rgb + 3 * column, rgb + 3 * (last - 1), 3 * sizeof(*rgb));
    disparity[column] = disparity[last - 1];
  }
}

// Copies every 2^kLayer-th value. The inner loop has a fixed length, so that the compiler can
// unroll the loop.
template <int kLayer>
void CopyEvery(const int16_t* from, int32_t count, int16_t* to) {
  constexpr int32_t kGroup = 8;
  int32_t n = 0;
  for (; n + kGroup <= count; n += kGroup, from += kGroup << kLayer, to += kGroup) {
    for (int32_t k = 0; k < kGroup; ++k) to[k] = from[k << kLayer];
  }
  for (int32_t k = 0; n + k < count; ++k) to[k] = from[k << kLayer];
}

// Copies the disparities of `count` pixels of the layer from column x on. The last column of a
// layer may lie outside the picture.
void CopyDisparity(const Window& window, const int16_t* row, int32_t x, int32_t count,
                   int16_t* disparity) {
  const int32_t column = x * (1 << window.layer), last = window.picture_width - 1;
  const int32_t inside = Clamp((last >> window.layer) + 1 - x, 0, count);
  if (window.layer == 0) {
    std::memcpy(disparity, row + x, sizeof(*disparity) * static_cast<size_t>(inside));
  } else if (window.layer == 1) {
    CopyEvery<1>(row + column, inside, disparity);
  } else {
    CopyEvery<2>(row + column, inside, disparity);
  }
  for (int32_t k = inside; k < count; ++k) disparity[k] = row[last];
}

}  // namespace

void LoadLight(const Window& window, int32_t x, int32_t y, int32_t count, int16_t* rgb) {
  if (window.layer == 0) {
    if (count > 0) window.reader.Light(0, x, y, count, rgb);
    return;
  }
  const int16_t* from = window.samples.Row(y) + 3 * x;
  for (int32_t k = 0; k < 3 * count; ++k) {
    rgb[k] = static_cast<int16_t>(from[k] << (kLightBits - simd::kLayerBits));
  }
}

void LoadBlock(const Window& window, const Rect& rect, const Border& border, BlockPixels* field) {
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
    int16_t* rgb = field->Rgb(0, row);
    int16_t* disparity = field->Disparity(0, row);
    const int16_t* from_disparity =
        window.disparity.Row(Min(y << window.layer, window.picture_height - 1));
    LoadLight(window, field->x + first, y, last - first, rgb + 3 * first);
    CopyDisparity(window, from_disparity, field->x + first, last - first, disparity + first);
    RepeatEdges(first, last, field->width, rgb, disparity);
  }
  ExtendEdges(window, field);
}

}  // namespace starfocus
