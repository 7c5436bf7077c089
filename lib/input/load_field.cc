// SPDX-License-Identifier: Apache-2.0
#include "lib/input/load_field.h"

#include <cstring>

#include "lib/input/picture_edge.h"

namespace starfocus {
namespace {

// Fills what lies outside [first, last) of a row, which is not empty, with its ends.
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

}  // namespace

void LoadLight(const simd::Kernels& kernels, const Window& window, int32_t x, int32_t y,
               int32_t count, int16_t* rgb) {
  const size_t samples = 3 * static_cast<size_t>(count);
  if (window.lamp > 0) {
    for (int32_t p = 0; p < count; ++p) ReadExcess(ViewOf(window, 0), x + p, y, rgb + 3 * p);
    return;
  }
  if (window.layer == 0) {
    kernels.Decode(window.centre.Row(y) + 3 * x, samples, window.transfer->encoding, rgb);
    return;
  }
  const int16_t* from = window.samples.Row(y) + 3 * x;
  for (size_t k = 0; k < samples; ++k) {
    rgb[k] = static_cast<int16_t>(from[k] << (kLightBits - simd::kLayerBits));
  }
}

void LoadField(const simd::Kernels& kernels, const Window& window, const Rect& rect,
               const Border& border, Field* field) {
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
    LoadLight(kernels, window, field->x + first, y, last - first, rgb + 3 * first);
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

}  // namespace starfocus
