// SPDX-License-Identifier: Apache-2.0
#include "examples/board/camera.h"

#include <algorithm>
#include <cmath>
#include <new>

#include "platform/file.h"
#include "platform/problem.h"
#include "starfocus/experimental.h"

namespace starfocus {

Error Camera::Load(const std::string& folder, starfocus_mode mode) {
  if (Error error = LoadLightField(folder, {}).MoveTo(&light_field_)) return error;
  FloatMap& map = light_field_.disparity;
  starfocus_status status =
      starfocus_fill_disparity(map.values.data(), map.stride(), map.width, map.height, nullptr);
  if (status != STARFOCUS_OK) {
    return Expected(DisparityPath(folder), "a map with finite disparities", "none");
  }
  stats_ = MeasureDisparity(map);
  const double range = double(stats_.max) - double(stats_.min);
  for (double aperture = 1; aperture > 0.1; aperture /= 2) {
    if (aperture * range <= STARFOCUS_MAX_BLUR) apertures_.push_back(aperture);
  }
  if (apertures_.empty()) {
    return Expected(DisparityPath(folder), "a disparity range of at most 1000 pixels",
                    std::to_string(range));
  }
  Config config;
  config.width = light_field_.width();
  config.height = light_field_.height();
  ConfigureViews(light_field_, &config);
  config.disparity_min = stats_.min;
  config.disparity_max = stats_.max;
  config.max_blur = std::max(1.0, std::ceil(apertures_[0] * range));
  config.max_workers = runner_.workers();
  starfocus_problem problem = {};
  status = engine_.Init(config, &problem);
  starfocus_workspace_size(&config, &workspace_bytes_, nullptr);
  if (status == STARFOCUS_OK) {
    starfocus_callbacks callbacks = {};
    callbacks.runner = ThreadRunner::Run;
    callbacks.runner_data = &runner_;
    status = engine_.SetCallbacks(callbacks);
  }
  if (status != STARFOCUS_OK) {
    return Expected(folder, "a light field that the engine accepts",
                    Describe(status, &problem).text);
  }
  picture_ = Image(config.width, config.height);
  mode_ = mode;
  return {};
}

starfocus_status Camera::Take(double focus, double aperture) {
  Params params;
  params.study.mode = mode_;
  params.focus = focus;
  params.aperture = aperture;
  return engine_.Refocus(params, EngineRows(light_field_),
                         starfocus_image_rgb(picture_.pixels.data(), picture_.stride()));
}

}  // namespace starfocus
