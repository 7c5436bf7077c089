// SPDX-License-Identifier: Apache-2.0
// Fuzz target: estimates and repairs maps with any configuration, size, stride and content, and
// computes maps and coverage from mattes.
#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "starfocus/depth.h"
#include "starfocus/matte.h"
#include "starfocus/starfocus.hpp"
#include "tests/fuzz/engine_input.h"
#include "tests/support/hair.h"

namespace {

using namespace starfocus::fuzz;

// Makes a configuration. Most configurations are valid; a few have arbitrary bytes in one field.
test::Config MakeConfig(Input* input) {
  test::Config config;
  const int side = input->Rarely() ? 200 : input->Rarely() ? 80 : 24;
  config.width = input->Int(1, side);
  config.height = input->Int(1, side);
  config.views = kViews[input->Int(0, 3)];
  if (input->Rarely()) {
    config.views = input->Int(2, 4);
    for (int32_t k = 1; k < config.views; ++k) {
      config.positions[k] = {input->Real(-1, 1), input->Real(-1, 1)};
    }
  }
  DrawDisparities(input, &config);
  config.max_workers = input->Rarely() ? STARFOCUS_MAX_WORKERS : 1;
  SpoilRarely(input, static_cast<starfocus_config*>(&config), kNumbersOfConfig);
  return config;
}

void FillMap(const test::Config& config, Input* input, Rows<float>* map) {
  Rows<uint8_t> levels(map->count, 1, 0, input);
  FillRuns(input, &levels);
  for (size_t i = 0; i < map->count; ++i) map->values[i] = DisparityOf(config, levels.values[i]);
  while (input->Rarely()) {
    map->values[input->Value<uint32_t>() % map->count] = input->Value<float>();
  }
}

// Makes a picture of strands above a body, and a map in which the strands form a closed outline.
void FillHair(const test::Config& config, Input* input, Rows<uint8_t>* picture, Rows<float>* map) {
  const test::Strands strands = test::DrawStrands(input);
  uint8_t colours[6];
  input->Bytes(colours, sizeof(colours));
  for (int32_t y = 0; y < config.height; ++y) {
    for (int32_t x = 0; x < config.width; ++x) {
      const bool is_far = 3 * y<config.height, is_body = 3 * y> 2 * config.height;
      const int covers = is_far ? 0 : is_body ? 255 : strands.CoverageAt(x, y);
      const size_t row = static_cast<size_t>(y), column = static_cast<size_t>(x);
      for (size_t c = 0; c < 3; ++c) {
        picture->values[row * picture->stride + 3 * column + c] =
            test::Mixture(covers, colours[c], colours[3 + c]);
      }
      map->values[row * map->stride + column] =
          is_far ? config.disparity_min : config.disparity_max;
    }
  }
}

starfocus_depth_map DepthOf(const test::Config& config, const Rows<float>& map) {
  return starfocus_depth_float(map.values.get(), map.stride * sizeof(float), config.width,
                               config.height);
}

starfocus_disparity_output OutputOf(Rows<float>* map, Rows<uint8_t>* coverage) {
  starfocus_disparity_output out = {};
  out.disparity = map->values.get();
  out.disparity_stride = map->stride * sizeof(float);
  out.coverage = coverage->values.get();
  out.coverage_stride = coverage->stride;
  return out;
}

// Checks that all values of the map are in the range of the configuration, rounded to floats.
void CheckMap(const test::Config& config, const Rows<float>& map) {
  const auto least = static_cast<float>(config.disparity_min);
  const auto most = static_cast<float>(config.disparity_max);
  for (int32_t y = 0; y < config.height; ++y) {
    for (int32_t x = 0; x < config.width; ++x) {
      const float value = map.values[static_cast<size_t>(y) * map.stride + static_cast<size_t>(x)];
      Must(value >= least && value <= most);
    }
  }
}

// Computes coverage from a matte and a map of known values, and both planes from the matte alone.
void UseMatte(const test::Config& config, const Rows<float>& map, Input* input) {
  const int32_t width = input->Int(1, 90), height = input->Int(1, 90), step = input->Int(0, 4);
  Rows<uint8_t> samples(static_cast<size_t>((width - 1) * std::max(step, 1) + 1), height, 5, input);
  FillPicture(input, &samples);
  const starfocus_matte matte = {samples.values.get(), samples.stride, step, width, height};
  starfocus_region region = {input->Int(0, config.width - 1), input->Int(0, config.height - 1), 1,
                             1};
  region.width = input->Int(1, config.width - region.x);
  region.height = input->Int(1, config.height - region.y);
  Rows<float> field(static_cast<size_t>(region.width), region.height, 5, input);
  Rows<uint8_t> coverage(static_cast<size_t>(region.width), region.height, 5, input);
  starfocus_disparity_output out = OutputOf(&field, &coverage);
  const starfocus_depth_map depth = DepthOf(config, map);
  const starfocus_matte_depth surfaces = {config.disparity_max, config.disparity_min,
                                          input->Real(0, 0.5), input->Real(0.6, 1)};
  starfocus_matte_stats stats;
  const int32_t columns = config.width, rows = config.height;
  Must(starfocus_measure_matte(&matte, &stats, nullptr) == STARFOCUS_OK);
  Must(starfocus_matte_coverage(&matte, &depth, columns, rows, &region, &out, nullptr) ==
       STARFOCUS_OK);
  Must(starfocus_matte_field(&matte, &surfaces, columns, rows, &region, &out, nullptr) ==
       STARFOCUS_OK);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  Input input(data, size);
  const test::Config config = MakeConfig(&input);
  const starfocus_callbacks callbacks = DrawCallbacks(20, &input);
  const bool repairs = input.Int(0, 1) == 1;
  size_t bytes = 0;
  if (starfocus_map_workspace_size(&config, repairs ? 1 : 0, &bytes, nullptr) != STARFOCUS_OK) {
    return 0;
  }
  const auto workspace = TakeWorkspace(config, bytes);
  if (!workspace) return 0;
  starfocus_light_field field = starfocus::NewLightField();
  std::vector<Rows<uint8_t>> pictures;
  const auto width = static_cast<size_t>(config.width);
  for (int view = 0; view < config.views; ++view) {
    pictures.emplace_back(3 * width, config.height, 5, &input);
    FillPicture(&input, &pictures.back());
    field.views[view] = starfocus_image_rgb(pictures.back().values.get(), pictures.back().stride);
  }
  Rows<float> given(width, config.height, 5, &input), map(width, config.height, 5, &input);
  Rows<uint8_t> sure(width, config.height, 5, &input), coverage(width, config.height, 5, &input);
  FillMap(config, &input, &given);
  if (config.views == 1 && input.Int(0, 1) == 1) {
    FillHair(config, &input, &pictures[0], &given);
  }
  field.depth = DepthOf(config, given);
  const auto make = repairs ? starfocus_repair_disparity : starfocus_estimate_disparity;
  starfocus_disparity_output out = OutputOf(&map, &coverage);
  out.confidence = input.Rarely() ? nullptr : sure.values.get();
  out.confidence_stride = sure.stride;
  out.has_coverage = -1;
  if (input.Rarely()) out.coverage = nullptr;
  const starfocus_status status =
      make(&config, &callbacks, &field, &out, workspace.get(), bytes, nullptr);
  if (status == STARFOCUS_OK) {
    CheckMap(config, map);
    UseMatte(config, map, &input);
    const bool may_cover = repairs && config.views == 1 && out.coverage != nullptr;
    Must(out.has_coverage == 0 || (out.has_coverage == 1 && may_cover));
    return 0;
  }
  // All arguments except the map are valid, so only the map may cause an error.
  const bool cancelled = callbacks.progress != nullptr && status == STARFOCUS_ERROR_CANCELLED;
  Must(cancelled ||
       (repairs && (status == STARFOCUS_ERROR_DISPARITY || status == STARFOCUS_ERROR_ALL_INVALID)));
  return 0;
}
