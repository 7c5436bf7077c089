// SPDX-License-Identifier: Apache-2.0
// Tests the outlines of repaired maps: wrong outlines move to the edges of the picture, ramps
// become steps, right maps are left alone, and results do not depend on tiles.
#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "lib/base/fixed.h"
#include "lib/depth/outlines.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"

namespace repaired_edges_test {
namespace {

constexpr int kWidth = 96, kHeight = 64;
constexpr int16_t kNear = 12 << starfocus::kDisparityBits, kFar = 0;

// A picture with a dark near half and a bright far half, and a map of it.
struct Scene {
  std::vector<uint8_t> rgb = std::vector<uint8_t>(3 * kWidth * kHeight);
  std::vector<int16_t> map = std::vector<int16_t>(kWidth * kHeight);

  // Fills the map with map_at(x, y). The edge of the picture is at column kWidth / 2.
  template <class Map>
  explicit Scene(const Map& map_at) {
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const size_t at = size_t(y) * kWidth + size_t(x);
        const int code = (x < kWidth / 2 ? 40 : 200) + (x * 5 + y * 3) % 7;
        for (size_t c = 0; c < 3; ++c) rgb[3 * at + c] = uint8_t(code);
        map[at] = int16_t(map_at(x, y));
      }
    }
  }

  // Returns the repaired map, from columns x rows tiles; both numbers are odd.
  std::vector<int16_t> Repaired(int columns = 1, int rows = 1) {
    starfocus::SweepSetup setup = {};
    setup.width = kWidth, setup.height = kHeight;
    setup.columns = columns, setup.rows = rows;
    const size_t tiles = size_t(columns * rows);
    starfocus::OutlineMemory outlines;
    starfocus::ThinPatches thin;
    const auto take = [&](starfocus::Arena* arena) {
      outlines = starfocus::TakeOutlines(setup, 1, arena);
      thin = starfocus::TakeThinPatches(setup, arena);
    };
    starfocus::Arena count(nullptr);
    take(&count);
    const test::Memory memory(count.Bytes());
    starfocus::Arena arena(memory.data);
    take(&arena);
    std::copy(map.begin(), map.end(), outlines.given);
    std::fill_n(thin.thin, thin.columns * thin.rows, uint8_t{0});
    const std::vector<float> known(map.begin(), map.end());
    starfocus_light_field field = starfocus::NewLightField();
    field.views[0] = starfocus_image_rgb(rgb.data(), 3 * kWidth);
    field.depth = starfocus_depth_float(known.data(), kWidth * sizeof(float), kWidth, kHeight);
    std::vector<std::atomic<uint32_t>> progress(starfocus::ProgressWords(tiles));
    starfocus::Jobs jobs;
    jobs.progress = progress.data();
    starfocus::Sequence run(&jobs, starfocus::kOutlinePhases, int32_t(tiles));
    const int16_t* repaired = starfocus::FollowOutlines(
        field, starfocus::simd::ReferenceDepthKernels(), thin, nullptr, outlines, &run);
    CHECK(run.status() == STARFOCUS_OK);
    return {repaired, repaired + map.size()};
  }
};

// Returns the number of pixels whose disparity is not that of their surface.
int Wrong(const std::vector<int16_t>& map) {
  int wrong = 0;
  for (size_t at = 0; at < map.size(); ++at) {
    const int right = at % kWidth < kWidth / 2 ? kNear : kFar;
    wrong += std::abs(map[at] - right) > 16;
  }
  return wrong;
}

TEST_CASE("repaired edges: outlines that are off by three pixels move to the edge of the picture") {
  for (const int off : {-3, 3}) {
    Scene scene([&](int x, int) { return x < kWidth / 2 + off ? kNear : kFar; });
    CHECK(Wrong(scene.map) == 3 * kHeight);
    CHECK(Wrong(scene.Repaired()) == 0);
  }
}

TEST_CASE("repaired edges: displaced rows move back") {
  Scene scene([](int x, int y) { return x < kWidth / 2 + (y * 7 + y / 3) % 5 - 2 ? kNear : kFar; });
  CHECK(Wrong(scene.map) > 60);
  CHECK(Wrong(scene.Repaired()) <= 2);
}

TEST_CASE("repaired edges: a ramp becomes a step at the edge of the picture") {
  Scene scene([](int x, int) {
    const double share = std::clamp((x + 0.5 - (kWidth / 2 - 2)) / 8, 0.0, 1.0);
    return int(std::lround(kNear * (1 - share)));
  });
  CHECK(Wrong(scene.map) > 5 * kHeight);
  CHECK(Wrong(scene.Repaired()) == 0);
}

TEST_CASE("repaired edges: a thin structure of a soft map has one disparity") {
  // A bar of three pixels, whose map has no flat pixel; no pixel keeps a rest of the ramp.
  constexpr int kMiddle = kWidth / 4;
  Scene scene([](int x, int) { return std::max(0, kNear - std::abs(x - kMiddle) * kNear / 4); });
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const uint8_t code = std::abs(x - kMiddle) <= 1 ? 40 : 200;
      std::fill_n(&scene.rgb[3 * size_t(y * kWidth + x)], 3, code);
    }
  }
  const std::vector<int16_t> repaired = scene.Repaired();
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const int16_t right = std::abs(x - kMiddle) <= 1 ? kNear : kFar;
      CHECK(repaired[size_t(y * kWidth + x)] == right);
    }
  }
}

TEST_CASE("repaired edges: a right map is left alone") {
  Scene scene([](int x, int) { return x < kWidth / 2 ? kNear : kFar; });
  CHECK(scene.Repaired() == scene.map);
}

TEST_CASE("repaired edges: a displaced part of a right map moves, and the rest is left alone") {
  Scene scene([](int x, int y) { return x < kWidth / 2 + (y < 20 ? 3 : 0) ? kNear : kFar; });
  // A second outline with the same colours on both sides, which colours neither confirm nor deny.
  for (size_t at = 0; at < scene.map.size(); ++at) {
    if (at % kWidth < 8) scene.map[at] = 2 * kNear;
  }
  const std::vector<int16_t> repaired = scene.Repaired();
  int wrong = 0;
  for (size_t at = 0; at < repaired.size(); ++at) {
    const size_t x = at % kWidth;
    if (x > 16) wrong += std::abs(repaired[at] - (x < kWidth / 2 ? kNear : kFar)) > 16;
  }
  CHECK(wrong <= 6);
}

TEST_CASE("repaired edges: a pixel of a hard map does not keep the rest of a ramp") {
  // The map is off by three pixels, and its last near pixel is a pixel of disparity farther.
  Scene scene([](int x, int) {
    return x < kWidth / 2 - 4 ? kNear : x < kWidth / 2 - 3 ? kNear - kNear / 12 : kFar;
  });
  CHECK(Wrong(scene.Repaired()) == 0);
}

TEST_CASE("repaired edges: results do not depend on tiles") {
  Scene scene([](int x, int y) {
    const double middle = kWidth / 2 + 3 * std::sin(y * 0.3);
    return int(std::lround(kNear * std::clamp((middle + 3 - x) / 6, 0.0, 1.0)));
  });
  const std::vector<int16_t> whole = scene.Repaired();
  CHECK(scene.Repaired(7, 5) == whole);
  CHECK(scene.Repaired(3, 3) == whole);
  CHECK(scene.Repaired(1, 3) == whole);
}

}  // namespace
}  // namespace repaired_edges_test
