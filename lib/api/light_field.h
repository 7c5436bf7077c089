// SPDX-License-Identifier: Apache-2.0
// A light field in the caller's memory.
#ifndef STARFOCUS_LIB_API_LIGHT_FIELD_H_
#define STARFOCUS_LIB_API_LIGHT_FIELD_H_

#include "lib/api/validate.h"
#include "lib/engine/engine.h"
#include "starfocus/starfocus.h"

namespace starfocus {

inline const float* DisparityRow(const sf_light_field& light_field, int32_t y) {
  return light_field.disparity +
         static_cast<size_t>(y) * (light_field.disparity_stride / sizeof(float));
}

// Whether it has bytes within `extent`.
bool OverlapsLightField(const Extent& extent, const sf_config& config,
                        const sf_light_field& light_field);

// Points the engine's windows at it.
void SetPictures(const sf_light_field& light_field, EngineState* engine);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_API_LIGHT_FIELD_H_
