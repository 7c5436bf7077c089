// SPDX-License-Identifier: Apache-2.0
// Lists operations that estimate or repair disparity maps, from star sets of every size, from other
// sets of views, or from one view.
#ifndef STARFOCUS_TESTS_OPERATIONS_MAP_OPERATIONS_H_
#define STARFOCUS_TESTS_OPERATIONS_MAP_OPERATIONS_H_

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "lib/depth/colour_repair.h"
#include "lib/depth/maps.h"
#include "lib/matting/hair_coverage.h"
#include "starfocus/depth.h"
#include "starfocus/starfocus.hpp"
#include "tests/depth/depth_scene.h"
#include "tests/depth/disc_photo.h"
#include "tests/operations/operations.h"
#include "tests/support/config.h"
#include "tests/support/hair.h"

namespace properties {

struct MapInput {
  test::PlaneField field;
  std::vector<float> given;  // map to repair; if empty, the map is estimated
  float low, high;
  bool covers = false;  // true if the repair must find coverage
};

// Returns views of two planes; the pictures are larger than one tile of an estimate. With
// `repairs`, the input has a noisy map whose near plane is too wide.
inline MapInput Planes(int width, int height, int views, bool repairs) {
  test::PlaneScene scene;
  scene.width = width;
  scene.height = height;
  scene.views = views;
  MapInput input = {test::RenderPlanes(scene), {}, -4, 7};
  if (!repairs) return input;
  input.given = test::MapOf(scene, 3);
  test::Random random(7);
  for (float& disparity : input.given) disparity += float(random.Real(-0.7, 0.7));
  return input;
}

// Returns views of two planes at any positions.
inline MapInput Positioned(int width, int height,
                           const std::vector<starfocus_position>& positions) {
  test::PlaneScene scene;
  scene.width = width;
  scene.height = height;
  scene.positions = positions;
  return {test::RenderPlanes(scene), {}, -3.7F, 6.2F};
}

// Returns a picture of a disc. In the map, the disc is too wide, and some values are unknown or
// wrong.
inline MapInput Disc(bool noisy) {
  test::Photo photo = test::MakeDisc(3);
  for (int x = 40; x < 90; ++x) photo.Map(x, 60 + x % 3) = std::numeric_limits<float>::quiet_NaN();
  for (int x = 100; x < 112; ++x) photo.Map(x, 100) += float(x % 5);
  if (noisy) test::AddNoise(&photo);
  return {{photo.width, photo.height, {photo.rgb}}, photo.map, -500, 500};
}

// Returns a portrait with a map in which the outline of the hair is closed, so that a repair finds
// coverage. The size is a multiple of the blocks that vote on hair, so that the mirrored picture
// has the same blocks.
inline MapInput Hair() {
  constexpr int kBlock = 32, kWidth = test::ClosedHair::kWidth / kBlock * kBlock,
                kHeight = test::ClosedHair::kHeight / kBlock * kBlock;
  const test::ClosedHair portrait = test::MakeClosedHair();
  std::vector<uint8_t> rgb;
  std::vector<float> map;
  for (int y = 0; y < kHeight; ++y) {
    const auto row = ptrdiff_t(portrait.At(0, y));
    rgb.insert(rgb.end(), portrait.rgb.begin() + 3 * row,
               portrait.rgb.begin() + 3 * (row + kWidth));
    map.insert(map.end(), portrait.map.begin() + row, portrait.map.begin() + row + kWidth);
  }
  map[80 * kWidth + 100] = std::numeric_limits<float>::quiet_NaN();
  return {{kWidth, kHeight, {rgb}}, map, -12, 12, true};
}

// Estimates or repairs the map of an input, with the kernels, memory and symmetry of a Setup.
struct Maps {
  Maps(MapInput of, const Setup& how) : input(std::move(of)), setup(how) {
    const test::Symmetry& mirror = setup.mirror;
    if (mirror.mirror_x || mirror.mirror_y) {
      input.field = test::MirroredField(input.field, mirror);
      if (!input.given.empty()) input.given = Mirrored(input.given);
    }
    config = test::ConfigOf(input.field, input.low, input.high);
    config.max_workers = setup.workers;
    size_t bytes = 0;
    REQUIRE(starfocus_map_workspace_size(&config, input.given.empty() ? 0 : 1, &bytes, nullptr) ==
            STARFOCUS_OK);
    memory = std::make_unique<test::Memory>(bytes);
    if (setup.used) std::memset(memory->data, 0x11, bytes);
  }

  template <class T>
  std::vector<T> Mirrored(const std::vector<T>& plane) const {
    std::vector<T> mirrored(plane.size());
    for (int y = 0; y < input.field.height; ++y) {
      for (int x = 0; x < input.field.width; ++x) {
        const auto to = test::Move(setup.mirror, input.field.width, input.field.height, x, y);
        mirrored[size_t(to.second * input.field.width + to.first)] =
            plane[size_t(y * input.field.width + x)];
      }
    }
    return mirrored;
  }

  starfocus_status Make(const starfocus_callbacks& callbacks, Bytes* out) {
    const auto width = size_t(config.width), pixels = width * size_t(config.height);
    std::vector<float> disparity(pixels, NAN);
    std::vector<uint8_t> confidence(pixels, 77);
    starfocus_light_field field = input.field.Get();
    if (!input.given.empty()) {
      field.depth = starfocus_depth_float(input.given.data(), sizeof(float) * width, config.width,
                                          config.height);
    }
    std::vector<uint8_t> coverage(pixels, 0);
    starfocus_disparity_output map = {
        disparity.data(), sizeof(float) * width, confidence.data(), width, nullptr, width, -1};
    if (input.covers) map.coverage = coverage.data();
    starfocus_status status = STARFOCUS_OK;
    if (setup.depth_kernels != nullptr) {
      status = MakeBy(*setup.depth_kernels, field,
                      {{disparity.data(), width},
                       input.low,
                       input.high,
                       {confidence.data(), width},
                       {map.coverage, width}});
    } else {
      const auto make =
          input.given.empty() ? starfocus_estimate_disparity : starfocus_repair_disparity;
      status = make(&config, &callbacks, &field, &map, memory->data, memory->bytes, nullptr);
      CHECK(map.has_coverage == int(status == STARFOCUS_OK && input.covers));
    }
    // Combines confidence and coverage into one plane, so that a comparison covers both.
    for (size_t n = 0; n < pixels; ++n) confidence[n] = uint8_t(confidence[n] ^ coverage[n]);
    disparity = Mirrored(disparity);
    *out = Mirrored(confidence);
    out->resize(pixels * (1 + sizeof(float)));
    std::memcpy(out->data() + pixels, disparity.data(), pixels * sizeof(float));
    return status;
  }

  // Makes the map by functions inside the library, with the given SIMD kernels.
  starfocus_status MakeBy(const starfocus::simd::DepthKernels& kernels,
                          const starfocus_light_field& field, const starfocus::MapOutput& output) {
    const starfocus::SweepSetup sweep = starfocus::MakeSetup(config, !input.given.empty());
    starfocus::Arena arena(memory->data);
    if (config.views == 1) {
      const starfocus::ColourMemory of_colour = TakeColourRepair(sweep, 1, &arena);
      bool has_coverage = false;
      return starfocus::RepairByColour(sweep, field, kernels, output, of_colour, &has_coverage);
    }
    const starfocus::EstimateMemory taken = TakeEstimate(sweep, 1, &arena);
    return (sweep.repairs ? starfocus::Repair : starfocus::Estimate)(sweep, field, kernels, output,
                                                                     taken);
  }

  MapInput input;
  Setup setup;
  test::Config config;
  std::unique_ptr<test::Memory> memory;
};

inline std::vector<Operation> MapOperations() {
  std::vector<Operation> all;
  const auto add = [&all](const std::string& name, int questions, const MapInput& input) {
    all.push_back({name, input.field.height, questions, [input](const Setup& setup) -> Run {
                     const auto of = std::make_shared<Maps>(input, setup);
                     return [of](const starfocus_callbacks& callbacks, Bytes* out) {
                       return of->Make(callbacks, out);
                     };
                   }});
  };
  for (const bool repairs : {false, true}) {
    const std::string what = repairs ? "repair by views: " : "estimate by views: ";
    const int questions = repairs ? 7 : 4;
    add(what + "5", questions, Planes(400, 40, 5, repairs));
    add(what + "9", questions, Planes(401, 61, 9, repairs));
    add(what + "17", questions, Planes(70, 20, 17, repairs));
    add(what + "5, two tiles high", questions, Planes(150, 140, 5, repairs));
  }
  add("estimate by views: a pair", 5, Positioned(400, 40, {{0, 0}, {1, 0}}));
  add("estimate by views: an upright pair", 5, Positioned(40, 50, {{0, 0}, {0.1, -0.77}}));
  add("estimate by views: three views on one side", 6,
      Positioned(50, 30, {{0, 0}, {0.3, 0.4}, {0.9, -0.2}}));
  add("estimate by views: four views around the centre", 4,
      Positioned(50, 30, {{0, 0}, {1, 0.1}, {-0.6, 0.2}, {0.1, -1}, {-0.3, 0.5}}));
  add("repair by colours", 6, Disc(false));
  add("repair by colours: noise", 6, Disc(true));
  add("repair by colours: hair", starfocus::kHairPhases, Hair());
  return all;
}

}  // namespace properties

#endif  // STARFOCUS_TESTS_OPERATIONS_MAP_OPERATIONS_H_
