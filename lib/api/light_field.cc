// SPDX-License-Identifier: Apache-2.0
#include "lib/api/light_field.h"

namespace starfocus {

bool OverlapsLightField(const Extent& extent, const sf_config& config,
                        const sf_light_field& light_field) {
  const auto width = static_cast<size_t>(config.width);
  for (int view = 0; view < config.views; ++view) {
    const sf_plane& plane = light_field.views[view];
    if (Overlaps(extent, ExtentOf(plane.data, plane.stride, config.height, 3 * width))) return true;
  }
  return Overlaps(extent, ExtentOf(light_field.disparity, light_field.disparity_stride,
                                   config.height, sizeof(float) * width));
}

void SetPictures(const sf_light_field& light_field, EngineState* engine) {
  Plane<const uint8_t> views[kMaxViews];
  for (int view = 0; view < engine->config.views; ++view) {
    views[view] = {light_field.views[view].data, light_field.views[view].stride, 0, 0};
  }
  SetPlanes(engine->config, *engine->kernels, views, &engine->pictures);
}

}  // namespace starfocus
