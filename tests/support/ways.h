// SPDX-License-Identifier: Apache-2.0
// Compares the pictures of different calls that must return equal pictures.
#ifndef STARFOCUS_TESTS_SUPPORT_WAYS_H_
#define STARFOCUS_TESTS_SUPPORT_WAYS_H_

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <vector>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/prepared_memory.h"
#include "tests/support/test_scene.h"

namespace test {

inline uint64_t BlocksOf(const test::Report& report) {
  return report.layers[0].blocks + report.layers[1].blocks + report.layers[2].blocks;
}

inline starfocus_region RandomRegion(int width, int height, Random* random) {
  starfocus_region region = {random->Int(0, width - 1), random->Int(0, height - 1), 1, 1};
  region.width = random->Int(1, width - region.x);
  region.height = random->Int(1, height - region.y);
  return region;
}

// Returns regions of many kinds: the whole picture, corners, edges, the middle, both sides of block
// boundaries, and random regions.
inline std::vector<starfocus_region> RegionsOf(int width, int height) {
  std::vector<starfocus_region> regions = {
      {0, 0, width, height},         {0, 0, 1, 1},
      {width - 1, height - 1, 1, 1}, {0, height - 1, width, 1},
      {width - 1, 0, 1, height},     {width / 2, height / 2, 1, 1}};
  for (const int at : {32, 64, 80}) {
    if (at + 2 >= width || at >= height) continue;
    regions.push_back({at, at, 1, 1});
    regions.push_back({at - 1, at - 3, 1, 1});
    // The engine finishes the last row of this region only with the next stripe.
    regions.push_back({0, at - 8, width, 5});
    regions.push_back({at + 2, at - 1, width - at - 2, 1});
  }
  Random random(uint64_t(width) * 977 + uint64_t(height));
  for (int k = 0; k < 6; ++k) {
    starfocus_region region = RandomRegion(width, height, &random);
    if (k % 2 == 0) {
      region.width = std::min(region.width, 20);
      region.height = std::min(region.height, 20);
    }
    regions.push_back(region);
  }
  return regions;
}

// Checks that all ways to refocus a scene return the bytes of the whole picture. The tested calls
// use streams, prepared light fields, the next frame of a video, views with gaps between pixels,
// and regions. Returns the whole picture.
inline Output CheckWays(const Scene& scene, test::Config config, starfocus::Params params,
                        bool many_regions = false) {
  config.features |= STARFOCUS_FEATURE_STREAMING | STARFOCUS_FEATURE_IMAGES;
  Engine engine(config);
  const int width = scene.width, height = scene.height;
  test::Report report, other_report;
  Output whole(width, height, 5), streamed = whole, again = whole, before_out = whole,
                                  after = whole, converted = whole;
  REQUIRE(Refocus(&engine, params, scene, &whole, nullptr, nullptr, &report) == STARFOCUS_OK);
  CHECK(whole.PaddingUntouched());
  REQUIRE(Stream(&engine, params, scene, &streamed, 7, 11, nullptr, nullptr, &other_report) ==
          STARFOCUS_OK);
  CHECK((streamed.bytes == whole.bytes));
  CHECK(other_report.unknown_pixels == report.unknown_pixels);
  PreparedMemory memory(engine);
  const starfocus_prepared* prepared = memory.Prepare(engine.get(), scene.Field());
  REQUIRE(RefocusPreparedRgb(engine.get(), &params, prepared, again.bytes.data(), again.stride,
                             &other_report) == STARFOCUS_OK);
  CHECK((again.bytes == whole.bytes));
  CHECK(other_report.unknown_pixels == 0);  // starfocus_prepare fills unknown disparities
  other_report.unknown_pixels = report.unknown_pixels;
  CHECK(report.IsLike(other_report));

  Scene before = scene;
  for (int view = 0; view < scene.views(); ++view) before.Pixel(view, width / 2, 0)[1] ^= 9;
  before.Disparity(0, height - 1) = scene.disparity_min;
  REQUIRE(Refocus(&engine, params, before, &before_out) == STARFOCUS_OK);
  starfocus_light_field field = scene.Field();
  const starfocus_light_field before_field = before.Field();
  const starfocus_image before_image =
      starfocus_image_rgb(before_out.bytes.data(), before_out.stride);
  const starfocus_previous previous = {sizeof previous, &before_field, &before_image};
  REQUIRE(RefocusAfterRgb(engine.get(), &params, &field, &previous, after.bytes.data(),
                          after.stride, nullptr) == STARFOCUS_OK);
  CHECK((after.bytes == whole.bytes));

  std::vector<uint8_t> gapped(4 * size_t(width) * size_t(height));
  for (int k = 0; k < width * height; ++k) {
    std::copy_n(scene.Pixel(0, k % width, k / width), 3, gapped.begin() + 4 * k);
  }
  field.views[0] = starfocus_image_rgb(gapped.data(), 4 * size_t(width));
  field.views[0].pixel_stride = 4;
  const starfocus_image image = starfocus_image_rgb(converted.bytes.data(), converted.stride);
  REQUIRE(starfocus_refocus(engine.get(), &params, &field, &image, nullptr) == STARFOCUS_OK);
  CHECK((converted.bytes == whole.bytes));

  const int x = std::min(3, width - 1), y = height * 7 / 16;
  const std::vector<starfocus_region> few = {
      {width / 3, height / 4, width - width / 3, (height + 3) / 4},
      {0, height - 1, width, 1},
      {width / 2, 0, 1, height},
      {x, y, std::max(1, std::min(width / 2, width - x)), std::min(3, height - y)}};
  for (const starfocus_region& region : many_regions ? RegionsOf(width, height) : few) {
    CAPTURE(region.x);
    CAPTURE(region.y);
    CAPTURE(region.width);
    CAPTURE(region.height);
    params.region = region;
    Output part(region.width, region.height, 5);
    test::Report part_report;
    REQUIRE(Refocus(&engine, params, scene, &part, nullptr, nullptr, &part_report) == STARFOCUS_OK);
    CHECK(IsPartOf(part, whole, region));
    CHECK(part.PaddingUntouched());
    CHECK(part_report.r_max == report.r_max);
    CHECK(part_report.rendered_samples <= report.rendered_samples);
    CHECK(BlocksOf(part_report) <= BlocksOf(report));
    CHECK(BlocksOf(part_report) > 0);
  }
  return whole;
}

// Checks that streams, pushed and pulled in portions of any size, return the bytes and the report
// of the whole picture.
inline void CheckStreamed(const Scene& scene, test::Config config,
                          const starfocus::Params& params) {
  Engine whole_engine(config);
  Output whole(scene.width, scene.height, 7);
  test::Report expected;
  REQUIRE(Refocus(&whole_engine, params, scene, &whole, nullptr, nullptr, &expected) ==
          STARFOCUS_OK);
  CHECK(whole.PaddingUntouched());
  config.features |= STARFOCUS_FEATURE_STREAMING;
  Engine engine(config);
  Random random(uint64_t(scene.width) * 977 + uint64_t(scene.height));
  constexpr int kAll = 1 << 20;
  const int chunks[][2] = {
      {1, 1},    {3, 3},    {64, 64},    {random.Int(1, 70), random.Int(1, 70)},
      {1, kAll}, {kAll, 1}, {kAll, kAll}};
  for (const auto& chunk : chunks) {
    CAPTURE(chunk[0]);
    CAPTURE(chunk[1]);
    Output out(scene.width, scene.height, 7);
    test::Report report;
    REQUIRE(Stream(&engine, params, scene, &out, chunk[0], chunk[1], nullptr, nullptr, &report) ==
            STARFOCUS_OK);
    CHECK((out.bytes == whole.bytes));
    CHECK(report.n == expected.n);
    CHECK(report.r_max == expected.r_max);
    CHECK(report.rendered_views == expected.rendered_views);
    CHECK(report.rendered_samples == expected.rendered_samples);
    CHECK(report.copied_pixels == expected.copied_pixels);
    for (int layer = 0; layer < STARFOCUS_LAYERS; ++layer) {
      CHECK(report.layers[layer].blocks == expected.layers[layer].blocks);
      CHECK(report.layers[layer].pixels == expected.layers[layer].pixels);
      CHECK(report.layers[layer].predicted_ps == expected.layers[layer].predicted_ps);
    }
  }
}

}  // namespace test

#endif  // STARFOCUS_TESTS_SUPPORT_WAYS_H_
