// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/map_stabiliser.h"

#include <cstddef>
#include <cstdint>

#include "platform/problem.h"
#include "platform/y4m.h"
#include "starfocus/starfocus.hpp"

namespace starfocus {

Error MapStabiliser::Start(const std::string& path, const LightField& frame) {
  starfocus::Config config;
  config.width = frame.width();
  config.height = frame.height();
  config.disparity_min = range_.min;
  config.disparity_max = range_.max;
  config.max_workers = pool_.workers();
  starfocus_problem problem = {};
  size_t bytes = 0;
  starfocus_status status = starfocus_stabiliser_size(&config, &bytes, &problem);
  if (status == STARFOCUS_ERROR_TOO_LARGE) return OutOfMemory(path, "stabilise its disparities");
  if (status == STARFOCUS_OK) {
    memory_.reset(::operator new (bytes, std::align_val_t{STARFOCUS_ALIGNMENT}));
    status = starfocus_stabiliser_init(&config, memory_.get(), bytes, &stabiliser_, &problem);
  }
  if (status == STARFOCUS_OK) return {};
  return Error::Internal(path, "a frame whose map can be stabilised",
                         Describe(status, &problem).text);
}

Error MapStabiliser::Stabilise(const std::string& path, LightField* frame,
                               starfocus_stabiliser_report* report) {
  if (stabiliser_ == nullptr) {
    if (Error error = Start(path, *frame)) return error;
  }
  const auto width = static_cast<size_t>(frame->width());
  const bool covers = !frame->coverage.empty();
  starfocus_light_field field = NewLightField();
  const bool is_planar = !frame->planar.samples.empty();
  const PlanarImage narrow = is_planar ? Narrow(frame->planar) : PlanarImage();
  field.views[0] = is_planar
                       ? EngineImage(narrow)
                       : starfocus_image_rgb(frame->views[0].row(0), frame->views[0].stride());
  field.depth = EngineMap(frame->disparity);
  field.coverage = covers ? frame->coverage.data() : nullptr;
  field.coverage_stride = width;
  starfocus_disparity_output map = {};
  map.disparity = frame->disparity.values.data();
  map.disparity_stride = frame->disparity.stride();
  map.coverage = covers ? frame->coverage.data() : nullptr;
  map.coverage_stride = width;
  const starfocus_callbacks callbacks = {ThreadRunner::Run, &pool_, nullptr, nullptr, nullptr};
  const starfocus_status status =
      starfocus_stabilise_disparity(stabiliser_, &callbacks, &field, &map, report);
  if (status == STARFOCUS_OK) return {};
  return Error::Internal(path, "a frame whose map can be stabilised",
                         Describe(status, starfocus_stabiliser_problem(stabiliser_)).text);
}

}  // namespace starfocus
