// SPDX-License-Identifier: Apache-2.0
// Configuration of the engines of `calibrate` and `steps`, which read the data inside an engine.
#ifndef STARFOCUS_EXAMPLES_LAB_LAB_CONFIG_H_
#define STARFOCUS_EXAMPLES_LAB_LAB_CONFIG_H_

#include "platform/light_field.h"
#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"

namespace starfocus {

// Returns the configuration for a light field and every blur radius up to STARFOCUS_MAX_BLUR. The
// other fields have their defaults.
inline starfocus::Config ConfigOf(const LightField& light_field) {
  const starfocus_disparity_stats stats = MeasureDisparity(light_field.disparity);
  starfocus::Config config;
  config.width = light_field.width();
  config.height = light_field.height();
  ConfigureViews(light_field, &config);
  config.disparity_min = stats.min;
  config.disparity_max = stats.max;
  config.max_blur = STARFOCUS_MAX_BLUR;
  config.tuning.line_scan = starfocus_line_scan_renderer();
  return config;
}

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_LAB_LAB_CONFIG_H_
