// SPDX-License-Identifier: Apache-2.0
// Tests STARFOCUS_MODE_BLOCK through the public ABI. Streamed rows must equal the rows of whole
// pictures, constant pictures must not change, and blocks in focus must be copied. Pictures of
// block mode must be close to pictures of the benchmark mode.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/lib/deblock_reference.h"
#include "tests/support/config.h"
#include "tests/support/inside.h"
#include "tests/support/layered_scene.h"
#include "tests/support/psnr.h"
#include "tests/support/symmetry.h"
#include "tests/support/test_scene.h"
#include "tests/support/ways.h"

namespace block_mode_slow_test {
namespace {

constexpr int kBlocks[] = {32, 64, 128, 256};

// Parameters and configuration of a refocused picture.
struct Setup {
  double focus = 0, aperture = 1;
  int block = 64, max_layer = 2, deblocking = 35;
  double max_blur = 40;
  starfocus_mode mode = STARFOCUS_MODE_BLOCK;
  starfocus_renderer renderer = STARFOCUS_RENDERER_AUTO;

  starfocus::Params Params() const {
    starfocus::Params params = test::Params(focus, aperture, mode, renderer);
    return params;
  }
};

std::string Text(const Setup& s, const test::Scene& scene) {
  char text[200];
  std::snprintf(
      text, sizeof(text),
      "%dx%d views %d focus %.3f aperture %.3f block %d max_layer %d deblocking %d rule %d",
      scene.width, scene.height, scene.views(), s.focus, s.aperture, s.block, s.max_layer,
      s.deblocking, s.renderer);
  return text;
}

test::Config Config(const Setup& s, const test::Scene& scene) {
  test::Config config = test::ConfigFor(scene, s.max_blur);
  config.superblock = s.block;
  config.tuning.max_layer = s.max_layer;
  config.tuning.deblocking = s.deblocking;
  return config;
}

std::vector<uint8_t> Whole(const test::Scene& scene, const Setup& s,
                           starfocus_report* report = nullptr) {
  test::Engine engine(Config(s, scene));
  test::Output out(scene.width, scene.height, 5);
  REQUIRE(test::Refocus(&engine, s.Params(), scene, &out, nullptr, nullptr, report) ==
          STARFOCUS_OK);
  CHECK(out.PaddingUntouched());
  return out.Tight();
}

Setup RandomSetup(test::Random* random, float limit) {
  Setup s;
  s.focus = random->Real(-1.3 * limit, 1.3 * limit);
  s.aperture = random->Int(0, 1) == 0 ? 1 : random->Real(0.2, 1);
  s.block = kBlocks[random->Int(0, 3)];
  s.max_layer = random->Int(0, 3) == 0 ? random->Int(0, 1) : 2;
  s.deblocking = random->Int(0, 3) == 0 ? random->Int(0, 255) : 35;
  s.renderer = starfocus_renderer(random->Int(0, 2));
  return s;
}

void CheckStreamed(const test::Scene& scene, const Setup& s) {
  CAPTURE(Text(s, scene));
  test::CheckStreamed(scene, Config(s, scene), s.Params());
}

TEST_CASE("block: streamed rows equal the rows of the whole picture for pictures of many sizes") {
  test::Random random(31);
  constexpr int kSizes[][2] = {{1, 1},   {1, 40},  {40, 1},   {1, 150},  {150, 1},  {2, 3},
                               {15, 17}, {16, 16}, {17, 15},  {31, 33},  {32, 32},  {33, 70},
                               {64, 64}, {65, 63}, {100, 37}, {30, 131}, {130, 97}, {67, 260}};
  uint64_t seed = 1;
  for (const auto& size : kSizes) {
    for (const int views : test::kStars) {
      if (size[0] * size[1] > 8000 && views != 17 && views != 1) continue;
      const test::Scene scene = test::LayeredScene(size[0], size[1], views, 7, ++seed);
      Setup s = RandomSetup(&random, 7);
      s.block = size[1] > 64 ? 32 << random.Int(0, 1) : s.block;
      CheckStreamed(scene, s);
    }
  }
}

TEST_CASE(
    "block: streamed rows equal the rows of the whole picture in blur mode and with noisy "
    "disparities") {
  test::Random random(32);
  for (int round = 0; round < 12; ++round) {
    test::Scene scene =
        test::RandomScene(random.Int(1, 90), random.Int(30, 120), test::kStars[random.Int(0, 3)],
                          -4, 4, uint64_t(round) + 60);
    if (round % 2 == 0) test::NoisyDisparity(&scene, &random);
    Setup s = RandomSetup(&random, 4);
    s.mode = round % 3 == 0 ? STARFOCUS_MODE_BLUR : STARFOCUS_MODE_BLOCK;
    s.block = 32;
    CheckStreamed(scene, s);
  }
}

TEST_CASE("block: refocusing changes no bit of constant pictures") {
  test::Random random(35);
  for (int round = 0; round < 256; ++round) {
    const float limit = random.Int(0, 2) == 0 ? 16.0f : 6.0f;
    test::Scene scene = test::LayeredScene(random.Int(1, 100), random.Int(1, 80),
                                           test::kStars[round % 4], limit, uint64_t(round) + 300);
    if (round % 5 == 0) test::NoisyDisparity(&scene, &random);
    for (auto& picture : scene.pictures) {
      std::fill(picture.begin(), picture.end(), uint8_t(round));
    }
    Setup s = RandomSetup(&random, limit);
    s.mode = round % 4 == 3 ? STARFOCUS_MODE_BLUR : STARFOCUS_MODE_BLOCK;
    const std::vector<uint8_t> out = Whole(scene, s);
    const bool same = std::all_of(out.begin(), out.end(), [&](uint8_t b) { return b == round; });
    CHECK_MESSAGE(same, Text(s, scene));
  }
}

TEST_CASE(
    "block: in every configuration, a scene in focus is refocused to a copy of the centre view") {
  for (const int block : kBlocks) {
    for (int max_layer = 0; max_layer <= 2; ++max_layer) {
      for (const auto& size :
           {std::pair<int, int>{1, 1}, {130, 1}, {1, 130}, {77, 50}, {256, 64}}) {
        test::Scene scene = test::RandomScene(size.first, size.second, 9, 3.25f, 3.25f, 5);
        Setup s;
        s.focus = 3.25;
        s.block = block;
        s.max_layer = max_layer;
        test::Report report;
        const bool same = Whole(scene, s, &report) == scene.pictures[0];
        CHECK_MESSAGE(same, Text(s, scene));
        CHECK(report.layers[0].pixels == uint64_t(size.first) * uint64_t(size.second));
        CHECK(report.layers[1].blocks + report.layers[2].blocks == 0);
        CHECK(report.n == 0);  // N = 0: blocks are copies of the centre view
        CHECK(report.layers[0].views == report.layers[0].blocks);
      }
    }
  }
}

TEST_CASE("block: a scene far out of focus is rendered at the largest allowed layer") {
  for (const auto& size : {std::pair<int, int>{1, 1}, {90, 1}, {1, 90}, {100, 61}, {256, 128}}) {
    for (int max_layer = 0; max_layer <= 2; ++max_layer) {
      const test::Scene scene = test::LayeredScene(size.first, size.second, 5, 2, 44);
      Setup s;
      s.focus = 20;
      // The renderer slices uses no layer 2 at silhouettes, so the test uses the line scan.
      s.renderer = STARFOCUS_RENDERER_LINE_SCAN;
      s.max_layer = max_layer;
      s.block = 128;
      test::Report report;
      Whole(scene, s, &report);
      CAPTURE(Text(s, scene));
      for (int layer = 0; layer < STARFOCUS_LAYERS; ++layer) {
        const uint64_t all = uint64_t(size.first) * uint64_t(size.second);
        CHECK(report.layers[layer].pixels == (layer == max_layer ? all : 0));
      }
    }
  }
}

struct Told {
  int width, height;
  std::vector<int> covered;
  uint64_t blocks = 0, views = 0;
  int largest_n = 0;
  bool subapertures = false;  // true if blocks are rendered by subapertures
};

TEST_CASE("block: the visited blocks cover the picture once and agree with the report") {
  test::Random random(36);
  for (int round = 0; round < 20; ++round) {
    const test::Scene scene =
        test::LayeredScene(random.Int(1, 200), random.Int(1, 150), 5, 8, uint64_t(round) + 400);
    Setup s = RandomSetup(&random, 8);
    test::Engine engine(Config(s, scene));
    REQUIRE(engine.status() == STARFOCUS_OK);
    Told told = {
        scene.width, scene.height, {}, 0, 0, 0, s.renderer != STARFOCUS_RENDERER_LINE_SCAN};
    told.covered.assign(size_t(scene.width) * size_t(scene.height), 0);
    const starfocus::Params params = s.Params();
    const auto visitor = [](void* data, const starfocus_block* block) {
      Told& to = *static_cast<Told*>(data);
      for (int y = block->y; y < block->y + block->height; ++y) {
        for (int x = block->x; x < block->x + block->width; ++x) {
          if (x < to.width && y < to.height) ++to.covered[size_t(y) * size_t(to.width) + size_t(x)];
        }
      }
      ++to.blocks;
      to.largest_n = std::max(to.largest_n, block->n);
      for (int i = -block->n; i <= block->n; ++i) {
        for (int j = -block->n; j <= block->n; ++j) {
          const int most =
              to.subapertures ? starfocus::MostOfSubapertures(block->n) : block->n * block->n;
          to.views += i * i + j * j <= most;
        }
      }
    };
    const starfocus_observer observer = test::Visitor(visitor, &told);
    test::Output out(scene.width, scene.height);
    test::Report report;
    REQUIRE(test::Refocus(&engine, params, scene, &out, test::ObservedBy(&observer), &report) ==
            STARFOCUS_OK);
    CAPTURE(Text(s, scene));
    CHECK(std::all_of(told.covered.begin(), told.covered.end(), [](int n) { return n == 1; }));
    CHECK(told.blocks == test::BlocksOf(report));
    CHECK(told.largest_n == report.n);
    const uint64_t views = report.layers[0].views + report.layers[1].views + report.layers[2].views;
    CHECK(told.views >= views);  // the report does not count views of copied blocks
    if (report.copied_pixels == 0) CHECK(told.views == views);
    CHECK(report.layers[0].pixels + report.layers[1].pixels + report.layers[2].pixels ==
          uint64_t(scene.width) * uint64_t(scene.height));
    // A block visitor must not change the picture.
    CHECK((Whole(scene, s) == out.Tight()));
  }
}

// Returns a textured slanted plane whose views are rendered exactly. Pixel (x, y) of view (u, v)
// shows the point (x + u d, y + v d) of the plane.
test::Scene SmoothScene(int width, int height, int views) {
  test::Scene scene = test::EmptyScene(width, height, views, -6, 6);
  const auto disparity = [&](double x) { return 12 * x / (width - 1) - 6; };
  test::SetDisparity(&scene,
                     [&](int x, int) { return float(std::clamp(disparity(x), -6.0, 6.0)); });
  for (int view = 0; view < views; ++view) {
    double u = 0, v = 0;
    starfocus_view_position(view, &u, &v, nullptr);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        // px is the solution of px - u d(px) = x for the linear disparity d.
        const double px = (x - 6 * u) / (1 - 12 * u / (width - 1)), py = y + v * disparity(px);
        for (int c = 0; c < 3; ++c) {
          const double value = std::sin(0.15 * px + 0.1 * py + c) * std::cos(0.06 * px - 0.2 * py) +
                               0.4 * std::sin(0.9 * px - 0.7 * py + 2 * c);
          scene.Pixel(view, x, y)[c] = uint8_t(std::clamp(128 + 80 * value, 0.0, 255.0));
        }
      }
    }
  }
  return scene;
}

TEST_CASE("block: for a slanted plane, pictures of block and benchmark mode agree to 45 dB PSNR") {
  const test::Scene scene = SmoothScene(320, 160, 17);
  for (const double focus : {-6.0, -2.0, 0.0, 3.5, 6.0}) {
    Setup s;
    s.focus = focus;
    s.mode = STARFOCUS_MODE_BENCHMARK;
    const std::vector<uint8_t> benchmark = Whole(scene, s);
    s.mode = STARFOCUS_MODE_BLOCK;
    std::string line = "focus " + std::to_string(focus) + ":";
    for (int max_layer = 0; max_layer <= 2; ++max_layer) {
      s.max_layer = max_layer;
      const double psnr = test::Psnr(Whole(scene, s), benchmark);
      line += " L<=" + std::to_string(max_layer) + " " + std::to_string(psnr) + " dB";
      CAPTURES(focus, max_layer);
      CHECK(psnr > 45);
    }
    MESSAGE(line);
  }
}

TEST_CASE("block: deblocking of a whole picture equals deblocking of stripes") {
  test::Random random(39);
  int changed = 0;
  for (int round = 0; round < 40; ++round) {
    const test::Scene scene = test::LayeredScene(random.Int(20, 200), random.Int(40, 200),
                                                 test::kStars[round % 4], 8, uint64_t(round) + 600);
    Setup s = RandomSetup(&random, 8);
    s.block = 32 << random.Int(0, 1);
    s.max_layer = random.Int(0, 4) == 0 ? 1 : 2;
    s.deblocking = 0;
    const test::Config config = Config(s, scene);
    test::Engine engine(config);
    test::LayeredPicture picture(scene.width, scene.height);
    const starfocus::Params params = s.Params();
    const auto visitor = [](void* data, const starfocus_block* block) {
      auto* to = static_cast<test::LayeredPicture*>(data);
      for (int y = block->y; y < block->y + block->height; y += test::kUnit) {
        for (int x = block->x; x < block->x + block->width; x += test::kUnit) {
          to->Layer(x / test::kUnit, y / test::kUnit) = uint8_t(block->layer);
        }
      }
    };
    const starfocus_observer observer = test::Visitor(visitor, &picture);
    test::Output out(scene.width, scene.height);
    REQUIRE(test::Refocus(&engine, params, scene, &out, test::ObservedBy(&observer)) ==
            STARFOCUS_OK);
    for (const int beta : {35, 255}) {
      picture.rgb = out.bytes;
      test::DeblockPicture(&picture, beta, config.transfer);
      changed += picture.rgb != out.bytes;
      s.deblocking = beta;
      CAPTURE(Text(s, scene));
      CHECK((Whole(scene, s) == picture.rgb));
    }
  }
  CHECK(changed > 20);
}

TEST_CASE(
    "block: at layer 0, a mirrored light field of whole blocks results in the mirrored picture") {
  test::Random random(38);
  for (int round = 0; round < 24; ++round) {
    const int block = kBlocks[random.Int(0, 1)];
    const int width = block * random.Int(1, 3), height = block * random.Int(1, 2);
    test::Scene scene =
        round % 2 == 0
            ? test::LayeredScene(width, height, test::kStars[round % 4], 6, uint64_t(round) + 500)
            : test::RandomScene(width, height, test::kStars[round % 4], -3, 3, uint64_t(round));
    Setup s = RandomSetup(&random, scene.disparity_max);
    s.block = block;
    s.max_layer = 0;
    const std::vector<uint8_t> plain = Whole(scene, s);
    for (const bool along_x : {true, false}) {
      const test::Symmetry mirror = {false, along_x, !along_x};
      const std::vector<uint8_t> moved = Whole(test::Move(mirror, scene), s);
      const test::Distance distance =
          test::Compare(mirror, width, height, plain.data(), moved.data());
      CAPTURE(along_x);
      CHECK_MESSAGE(distance.samples == 0, Text(s, scene));
    }
  }
}

}  // namespace
}  // namespace block_mode_slow_test
