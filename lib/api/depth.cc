// SPDX-License-Identifier: Apache-2.0
// The C ABI of estimating and repairing disparities: checks, memory.
#include "starfocus/depth.h"

#include <cmath>
#include <cstring>

#include "lib/api/validate.h"
#include "lib/depth/colour_repair.h"
#include "lib/depth/repair.h"

namespace starfocus {
namespace {

sf_status CheckDepthConfig(const sf_depth_config& config, bool repairs) {
  if (config.version != SF_ABI_VERSION) return SF_ERROR_VERSION;
  for (const uint32_t value : config.reserved) {
    if (value != 0) return SF_ERROR_RESERVED;
  }
  if (config.width < 1 || config.width > SF_MAX_SIZE || config.height < 1 ||
      config.height > SF_MAX_SIZE) {
    return SF_ERROR_SIZE;
  }
  const bool one = config.views == 1 && repairs;
  if (!one && config.views != 5 && config.views != 9 && config.views != 17) return SF_ERROR_VIEWS;
  // The comparison is written so that NaN fails.
  if (!(config.disparity_min >= -SF_MAX_DISPARITY && config.disparity_max <= SF_MAX_DISPARITY &&
        config.disparity_min <= config.disparity_max)) {
    return SF_ERROR_DISPARITY_RANGE;
  }
  const bool workers = config.max_workers >= 1 && config.max_workers <= SF_MAX_WORKERS;
  return workers ? SF_OK : SF_ERROR_WORKERS;
}

// Checks that an output overlaps neither views nor workspace.
sf_status CheckApart(const sf_depth_config& config, const sf_light_field& light_field,
                     const Extent& workspace, const Extent& output) {
  if (Overlaps(output, workspace)) return SF_ERROR_OVERLAP;
  const auto width = static_cast<size_t>(config.width);
  for (int view = 0; view < config.views; ++view) {
    const sf_plane& plane = light_field.views[view];
    if (Overlaps(output, ExtentOf(plane.data, plane.stride, config.height, 3 * width))) {
      return SF_ERROR_OVERLAP;
    }
  }
  return SF_OK;
}

sf_status CheckOutputs(const sf_depth_config& config, const sf_light_field& light_field,
                       const Extent& workspace, const MapOutput& output) {
  const auto width = static_cast<size_t>(config.width);
  const Extent map = ExtentOf(output.disparity, output.stride * sizeof(float), config.height,
                              width * sizeof(float));
  sf_status status = CheckApart(config, light_field, workspace, map);
  if (status != SF_OK || output.confidence == nullptr) return status;
  const Extent confidence =
      ExtentOf(output.confidence, output.confidence_stride, config.height, width);
  status = CheckApart(config, light_field, workspace, confidence);
  return status == SF_OK && Overlaps(map, confidence) ? SF_ERROR_OVERLAP : status;
}

// Checks the map that is to be repaired: its finite values lie in the configured range, and there
// is one.
sf_status CheckGiven(const sf_depth_config& config, const sf_light_field& light_field) {
  bool any = false;
  for (int32_t y = 0; y < config.height; ++y) {
    const float* row = light_field.disparity +
                       static_cast<size_t>(y) * light_field.disparity_stride / sizeof(float);
    for (int32_t x = 0; x < config.width; ++x) {
      if (!std::isfinite(row[x])) continue;
      any = true;
      if (row[x] < config.disparity_min || row[x] > config.disparity_max) {
        return SF_ERROR_DISPARITY;
      }
    }
  }
  return any ? SF_OK : SF_ERROR_ALL_INVALID;
}

// Checks that the outputs and the workspace leave the map that is repaired alone.
sf_status CheckGivenApart(const sf_depth_config& config, const sf_light_field& light_field,
                          const Extent& workspace, const MapOutput& output) {
  const auto width = static_cast<size_t>(config.width);
  const Extent given = ExtentOf(light_field.disparity, light_field.disparity_stride, config.height,
                                width * sizeof(float));
  const Extent map = ExtentOf(output.disparity, output.stride * sizeof(float), config.height,
                              width * sizeof(float));
  if (Overlaps(given, workspace) || Overlaps(given, map)) return SF_ERROR_OVERLAP;
  if (output.confidence != nullptr &&
      Overlaps(given,
               ExtentOf(output.confidence, output.confidence_stride, config.height, width))) {
    return SF_ERROR_OVERLAP;
  }
  return CheckGiven(config, light_field);
}

EstimatePlan PlanOf(const sf_depth_config& config, bool repairs) {
  EstimatePlan plan = MakePlan(config);
  plan.repairs = repairs;
  return plan;
}

sf_status SizeOf(const sf_depth_config* config, bool repairs, size_t* bytes) {
  if (config == nullptr || bytes == nullptr) return SF_ERROR_NULL;
  const sf_status status = CheckDepthConfig(*config, repairs);
  if (status != SF_OK) return status;
  const EstimatePlan plan = PlanOf(*config, repairs);
  EstimateMemory* counted = nullptr;
  ColourMemory* of_colour = nullptr;
  const size_t needed = config->views == 1
                            ? LayOutColourRepair(plan, config->max_workers, nullptr, &of_colour)
                            : LayOutEstimate(plan, config->max_workers, nullptr, &counted);
  if (needed == kTooLarge) return SF_ERROR_TOO_LARGE;
  *bytes = needed;
  return SF_OK;
}

// What a call works with.
struct DepthCall {
  const sf_depth_config* config;
  const sf_light_field* light_field;
  void* workspace;
  size_t bytes;
};

// Checks all arguments of a call.
sf_status CheckCall(const DepthCall& call, bool repairs, const MapOutput& output, size_t stride) {
  size_t needed = 0;
  sf_status status = SizeOf(call.config, repairs, &needed);
  if (status == SF_OK) status = CheckMemory(call.workspace);
  if (status != SF_OK) return status;
  if (call.bytes < needed) return SF_ERROR_WORKSPACE_SMALL;
  const sf_depth_config& config = *call.config;
  const sf_light_field& light_field = *call.light_field;
  const int32_t width = config.width, height = config.height;
  status = CheckViews(config.views, width, height, light_field);
  if (status == SF_OK) status = CheckMap(output.disparity, stride, width, height);
  if (status == SF_OK && repairs) {
    status = CheckMap(light_field.disparity, light_field.disparity_stride, width, height);
  }
  if (status != SF_OK) return status;
  if (output.confidence != nullptr &&
      !ValidStride(output.confidence_stride, static_cast<size_t>(width), height)) {
    return SF_ERROR_STRIDE;
  }
  const auto begin = reinterpret_cast<uintptr_t>(call.workspace);
  status = CheckOutputs(config, light_field, {begin, begin + needed}, output);
  if (status != SF_OK || !repairs) return status;
  return CheckGivenApart(config, light_field, {begin, begin + needed}, output);
}

// Makes a map under the watch of the caller's progress function.
template <class Make>
sf_status Watched(const sf_depth_config& config, Watch* watch, const Make& make) {
  watch->Begin(config.progress, config.progress_data, 0, config.height);
  const sf_status status = make();
  if (status != SF_OK) return status;
  watch->SetRows(config.height);
  return watch->Ask() ? SF_OK : SF_ERROR_CANCELLED;
}

// Estimates, or repairs.
sf_status MakeMap(const DepthCall& call, bool repairs, const MapOutput& output,
                  const Runner& runner) {
  const EstimatePlan plan = PlanOf(*call.config, repairs);
  const simd::DepthKernels& kernels = simd::BestDepthKernels();
  if (call.config->views == 1) {
    ColourMemory* memory = nullptr;
    LayOutColourRepair(plan, call.config->max_workers, call.workspace, &memory);
    return Watched(*call.config, &memory->jobs.watch, [&] {
      return RepairByColour(plan, *call.light_field, kernels, runner, output, memory);
    });
  }
  EstimateMemory* memory = nullptr;
  LayOutEstimate(plan, call.config->max_workers, call.workspace, &memory);
  const EstimateZones zones(plan, call.config->max_workers, call.workspace);
  return Watched(*call.config, &memory->jobs.watch, [&] {
    return repairs ? Repair(plan, *call.light_field, kernels, runner, output, memory)
                   : Estimate(plan, *call.light_field, kernels, runner, output, memory);
  });
}

// Checks a call and does it. The output is as the caller says: its stride in bytes, without a
// range.
sf_status RunCall(const DepthCall& call, bool repairs, const MapOutput& asked,
                  const Runner& runner) {
  if (call.config == nullptr || call.light_field == nullptr || call.workspace == nullptr) {
    return SF_ERROR_NULL;
  }
  MapOutput output = asked;
  output.stride = asked.stride / sizeof(float);
  output.lowest = call.config->disparity_min;
  output.highest = call.config->disparity_max;
  const sf_status status = CheckCall(call, repairs, output, asked.stride);
  return status == SF_OK ? MakeMap(call, repairs, output, runner) : status;
}

}  // namespace
}  // namespace starfocus

void sf_depth_config_init(sf_depth_config* config) {
  if (config == nullptr) return;
  std::memset(config, 0, sizeof(*config));
  config->version = SF_ABI_VERSION;
  config->views = 5;
  config->max_workers = 1;
}

sf_status sf_estimate_size(const sf_depth_config* config, size_t* bytes) {
  return starfocus::SizeOf(config, false, bytes);
}

sf_status sf_repair_size(const sf_depth_config* config, size_t* bytes) {
  return starfocus::SizeOf(config, true, bytes);
}

sf_status sf_estimate_disparity(const sf_depth_config* config, const sf_light_field* light_field,
                                float* disparity, size_t stride, uint8_t* confidence,
                                size_t confidence_stride, void* workspace, size_t bytes,
                                sf_runner runner, void* runner_data) {
  return starfocus::RunCall({config, light_field, workspace, bytes}, false,
                            {disparity, stride, 0, 0, confidence, confidence_stride},
                            {runner, runner_data});
}

sf_status sf_repair_disparity(const sf_depth_config* config, const sf_light_field* light_field,
                              float* disparity, size_t stride, uint8_t* confidence,
                              size_t confidence_stride, void* workspace, size_t bytes,
                              sf_runner runner, void* runner_data) {
  return starfocus::RunCall({config, light_field, workspace, bytes}, true,
                            {disparity, stride, 0, 0, confidence, confidence_stride},
                            {runner, runner_data});
}
