// SPDX-License-Identifier: Apache-2.0
#include "lib/engine/pictures.h"

#include <cstring>

#include "lib/base/fixed.h"
#include "lib/engine/reach.h"

namespace starfocus {

void SetViews(const sf_config& config, const Plane<const uint8_t>* views, Pictures* pictures) {
  for (int layer = 0; layer < SF_LAYERS; ++layer) {
    Window& window = pictures->windows[layer];
    window.layer = layer;
    window.width = LayerSize(config.width, layer);
    window.height = LayerSize(config.height, layer);
    window.picture_width = config.width;
    window.picture_height = config.height;
    window.views = config.views;
    window.transfer = &TransferOf(config.transfer);
    for (int view = 0; view < config.views; ++view) window.view[view] = views[view];
    window.disparity = {pictures->disparity.data, pictures->disparity.stride,
                        pictures->disparity.rows, 0};
    pictures->layers[layer].width = window.width;
    pictures->layers[layer].height = window.height;
  }
  pictures->windows[0].centre = views[0];
}

sf_status ConvertDisparity(const sf_config& config, const simd::Kernels& kernels, const float* row,
                           int16_t* out) {
  const auto width = static_cast<size_t>(config.width);
  if (!kernels.ConvertDisparity(row, width, config.disparity_min, config.disparity_max, out)) {
    for (size_t x = 0; x < width; ++x) {
      if (!(row[x] - row[x] == 0.0f)) return SF_ERROR_NOT_FINITE;
    }
    return SF_ERROR_DISPARITY;
  }
  CheckAll(ranges::kDisparity, out, width);
  return SF_OK;
}

void ForgetLayers(const sf_config& config, Pictures* pictures) {
  // Layer 1 lies in rings, of as many rows as a stripe may need: what the stripe before made stays.
  LayerPlane& ring = pictures->layers[1];
  ring.samples.rows = LayerRows(config, 1);
  for (int layer = 1; layer < SF_LAYERS; ++layer) {
    pictures->layers[layer].rows = {0, 0};
    std::memset(pictures->needed[layer], 0, static_cast<size_t>(Columns(config)));
  }
}

}  // namespace starfocus
