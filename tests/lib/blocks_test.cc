// SPDX-License-Identifier: Apache-2.0
// Tests the blocks that the engine reports to a visitor, and the work that the engine omits because
// its result is known: blocks in which no view moves a pixel are copied, and layers that no block
// reads are not computed.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "lib/optics/rules.h"
#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/inside.h"
#include "tests/support/refocused.h"
#include "tests/support/rounds.h"
#include "tests/support/scenes.h"
#include "tests/support/test_scene.h"

namespace blocks_test {
namespace {

constexpr int kBlocks[] = {32, 64, 128, 256};
constexpr starfocus_mode kModes[] = {STARFOCUS_MODE_FRAME, STARFOCUS_MODE_BENCHMARK,
                                     STARFOCUS_MODE_BLOCK};

// Returns noise in every view. The disparity map has areas in focus, flat areas, gentle and steep
// slopes, and edges.
test::Scene VariedScene(int width, int height, int views, float limit, test::Random* random) {
  test::Scene scene = test::EmptyScene(width, height, views, -limit, limit);
  for (auto& picture : scene.pictures) picture = test::RandomBytes(picture.size(), random);
  const auto rectangle = [&](const auto& put) {
    const bool large = random->Int(0, 1) == 1;
    const int x0 = large ? 0 : random->Int(0, width - 1), y0 = random->Int(0, height - 1);
    const int x1 = std::min(width, x0 + random->Int(1, width)), y1 = large ? height : y0 + 40;
    for (int y = y0; y < std::min(y1, height); ++y) {
      for (int x = x0; x < x1; ++x) put(x, y);
    }
  };
  for (int piece = random->Int(0, 5); piece >= 0; --piece) {
    constexpr double kSlopes[] = {0, 0, 0.02, 0.12, 0.13, 0.9, 1.6};
    const double base = random->Int(0, 2) == 0 ? 0 : random->Real(-limit, limit);
    const double slope = kSlopes[random->Int(0, 6)];
    const int along_x = random->Int(0, 1);
    const auto put = [&](int x, int y) {
      const double d = base + slope * (along_x == 1 ? x : y);
      scene.Disparity(x, y) = std::clamp(float(d), -limit, limit);
    };
    if (piece > 0) {
      rectangle(put);
      continue;
    }
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) put(x, y);
    }
  }
  return scene;
}

// Refocuses a scene. Checks that each block of the last stripe has unchanged bytes if the block is
// rendered instead of copied. Returns the number of copied pixels.
uint64_t CheckRendered(const test::Scene& scene, const test::Config& config,
                       const starfocus::Params& params) {
  test::Engine engine(config);
  test::Output out(scene.width, scene.height);
  test::Report report;
  REQUIRE(test::Refocus(&engine, params, scene, &out, nullptr, nullptr, &report) == STARFOCUS_OK);
  for (const starfocus::Block& block : test::PlanOf(engine.get()).blocks) {
    const bool same =
        test::RenderOne(block, engine.get()) == test::RenderUncopied(block, engine.get());
    CHECK(same);
  }
  return report.copied_pixels;
}

TEST_CASE("blocks: in every mode, a copied block has the bytes of a rendered block") {
  test::Random random(51);
  uint64_t copied = 0;
  for (int round = 0; round < test::Rounds(400); ++round) {
    const float limit = float(random.Int(1, 6));
    const int width = random.Int(1, 200), height = random.Int(1, 120);
    const int views = test::kStars[random.Int(0, 3)];
    const test::Scene scene = VariedScene(width, height, views, limit, &random);
    test::Config config = test::ConfigFor(scene, 20);
    config.superblock = kBlocks[random.Int(0, 3)];
    config.tuning.max_layer = random.Int(0, 3) == 0 ? random.Int(0, 1) : 2;
    if (random.Int(0, 3) == 0) config.tuning.n_scale = random.Real(0.5, 2);
    config.tuning.gather = random.Int(0, 1);
    const starfocus_mode mode = kModes[round % 3 == 0 ? round / 3 % 2 : 2];
    const double focus = random.Int(0, 1) == 0 ? 0 : random.Real(-2 * limit, 2 * limit);
    double aperture = random.Int(0, 1) == 0 ? 1 : random.Real(0.02, 1);
    if (mode == STARFOCUS_MODE_BENCHMARK) aperture /= limit;
    starfocus::Params params = test::Params(focus, aperture, mode);
    params.study.renderer = random.Int(0, 2);
    CAPTURES(round, mode);
    copied += CheckRendered(scene, config, params);
  }
  constexpr uint64_t kSome = STARFOCUS_EMULATED ? 20 : 100;
  CHECK(copied > kSome * 256);
}

// Returns noise at disparity 0, except for column x, which has the disparity `other`.
test::Scene ColumnScene(int width, int height, int x, float other) {
  test::Random random(7);
  test::Scene scene = test::EmptyScene(width, height, 5, -8, 8);
  for (auto& picture : scene.pictures) picture = test::RandomBytes(picture.size(), &random);
  for (int y = 0; y < height; ++y) {
    for (int k = 0; k < width; ++k) scene.Disparity(k, y) = k == x ? other : 0;
  }
  return scene;
}

TEST_CASE("blocks: in frame modes, blocks in focus are copied unless other pixels blur into them") {
  for (const starfocus_mode mode : {STARFOCUS_MODE_FRAME, STARFOCUS_MODE_BENCHMARK}) {
    test::Scene scene = ColumnScene(256, 64, 250, 8);
    starfocus::Params params = test::Params(0, 1, mode);
    params.study.renderer = STARFOCUS_RENDERER_LINE_SCAN;
    const test::Config config = test::ConfigFor(scene, 8);
    const test::Refocused picture = test::RefocusScene(scene, config, params);
    CHECK(picture.report.copied_pixels == 3 * 64 * 64);
    CHECK(picture.report.layers[0].views == 3 + uint64_t(picture.report.rendered_views));
    // The defocused column is within 8 pixels of the third block.
    scene = ColumnScene(256, 64, 192 + 7, 8);
    CHECK(test::RefocusScene(scene, config, params).report.copied_pixels == 2 * 64 * 64);
  }
}

TEST_CASE("blocks: the line scan copies blocks with a blur radius below a third of a pixel") {
  for (const double radius : {0.1, 0.32, 0.36, 0.4}) {
    const test::Scene scene = test::RandomScene(64, 64, 5, 1, 1, 3);
    const starfocus::Params params =
        test::Params(1 - radius, 1, STARFOCUS_MODE_BLOCK, STARFOCUS_RENDERER_LINE_SCAN);
    CAPTURE(radius);
    CHECK(CheckRendered(scene, test::ConfigFor(scene, 8), params) ==
          (radius < 1.0 / 3 ? 64u * 64u : 0u));
  }
}

// Returns noise at disparity 2.
test::Scene FlatScene() {
  test::Random random(8);
  test::Scene scene = test::EmptyScene(192, 64, 5, -8, 8);
  for (auto& picture : scene.pictures) picture = test::RandomBytes(picture.size(), &random);
  std::fill(scene.disparity.begin(), scene.disparity.end(), 2.0F);
  return scene;
}

TEST_CASE("blocks: layers that no block reads are not computed") {
  const test::Scene scene = FlatScene();
  test::Config config = test::ConfigFor(scene, 40);
  const auto columns = [&](double focus) {
    test::Engine engine(config);
    test::Output out(scene.width, scene.height);
    REQUIRE(test::Refocus(&engine, test::Params(focus, 1, STARFOCUS_MODE_BLOCK), scene, &out) ==
            STARFOCUS_OK);
    return test::LayerColumns(engine.get());
  };
  CHECK(columns(2.25) == 0);  // At blur radius 0.25, all blocks are at layer 0.
  // At blur radius 25, all blocks are at layer 2, and no block reads layer 1.
  CHECK(columns(27) == 3);
  config.tuning.max_layer = 1;
  CHECK(columns(27) == 3);
}

// Returns the number of views that are rendered for N.
uint64_t ViewsFor(int n, bool subapertures) {
  const int most = subapertures ? starfocus::MostOfSubapertures(n) : n * n;
  uint64_t views = 0;
  for (int i = -n; i <= n; ++i) {
    for (int j = -n; j <= n; ++j) views += i * i + j * j <= most;
  }
  return views;
}

struct Told {
  int width = 0, height = 0;
  std::vector<int> covered;
  uint64_t blocks = 0, views = 0;
  int largest_n = 0;
  bool subapertures = false;  // true if blocks are rendered by subapertures
};

TEST_CASE("blocks: the visited blocks cover the picture once and agree with the report") {
  test::Random random(36);
  for (int round = 0; round < 20; ++round) {
    const test::Scene scene =
        test::LayeredScene(random.Int(1, 200), random.Int(1, 150), 5, 8, uint64_t(round) + 400);
    test::Config config = test::ConfigFor(scene, 40);
    config.superblock = kBlocks[random.Int(0, 3)];
    config.tuning.max_layer = random.Int(0, 3) == 0 ? random.Int(0, 1) : 2;
    const double aperture = random.Int(0, 1) == 0 ? 1 : random.Real(0.2, 1);
    const starfocus::Params params =
        test::Params(random.Real(-10, 10), aperture, STARFOCUS_MODE_BLOCK, random.Int(0, 2));
    test::Engine engine(config);
    REQUIRE(engine.status() == STARFOCUS_OK);
    Told told;
    told.width = scene.width;
    told.height = scene.height;
    told.subapertures = params.study.renderer != STARFOCUS_RENDERER_LINE_SCAN;
    told.covered.assign(size_t(scene.width) * size_t(scene.height), 0);
    const auto visitor = [](void* data, const starfocus_block* block) {
      Told& to = *static_cast<Told*>(data);
      for (int y = block->y; y < block->y + block->height; ++y) {
        for (int x = block->x; x < block->x + block->width; ++x) {
          if (x < to.width && y < to.height) ++to.covered[size_t(y) * size_t(to.width) + size_t(x)];
        }
      }
      ++to.blocks;
      to.largest_n = std::max(to.largest_n, block->n);
      to.views += ViewsFor(block->n, to.subapertures);
    };
    const starfocus_observer observer = test::Visitor(visitor, &told);
    test::Output out(scene.width, scene.height);
    test::Report report;
    REQUIRE(test::Refocus(&engine, params, scene, &out, test::ObservedBy(&observer), &report) ==
            STARFOCUS_OK);
    CAPTURE(round);
    CHECK(std::all_of(told.covered.begin(), told.covered.end(), [](int n) { return n == 1; }));
    CHECK(told.blocks ==
          report.layers[0].blocks + report.layers[1].blocks + report.layers[2].blocks);
    CHECK(told.largest_n == report.n);
    const uint64_t views = report.layers[0].views + report.layers[1].views + report.layers[2].views;
    CHECK(told.views >= views);  // the report does not count views of copied blocks
    if (report.copied_pixels == 0) CHECK(told.views == views);
    CHECK(report.layers[0].pixels + report.layers[1].pixels + report.layers[2].pixels ==
          uint64_t(scene.width) * uint64_t(scene.height));
    // A block visitor must not change the picture.
    CHECK((test::OutputOf(config, params, scene).bytes == out.bytes));
  }
}

TEST_CASE("blocks: the scale multiplies N of both renderers, but not N of the benchmark") {
  const test::Scene scene = test::RandomScene(40, 36, 5, 0, 0, 1);
  for (const double radius : {0.0, 0.25, 0.9, 3.5, 9.0, 17.0, 25.0}) {
    for (const double scale : {0.5, 0.7, 1.0, 1.4, 2.0}) {
      for (const starfocus_renderer renderer : test::kRenderers) {
        test::Config config = test::ConfigFor(scene);
        config.tuning.n_scale = scale;
        config.tuning.max_layer = 0;
        config.tuning.gather = 0;  // All cells are rendered from views.
        const auto views = [&](starfocus_mode mode) {
          starfocus_report report = starfocus::NewReport();
          test::OutputOf(config, test::Params(radius, 1, mode, renderer), scene, &report);
          const bool slices = renderer != STARFOCUS_RENDERER_LINE_SCAN;
          CHECK(report.r_max == doctest::Approx(radius));
          CHECK(uint64_t(report.rendered_views) == ViewsFor(report.n, slices));
          return report.n;
        };
        const int n = renderer == STARFOCUS_RENDERER_LINE_SCAN
                          ? starfocus::ViewsByPaper(radius)
                          : starfocus::ViewsBySubaperture(radius);
        const int scaled = int(std::ceil(n * scale - 1e-9));
        CAPTURES(radius, scale, renderer);
        CHECK(views(STARFOCUS_MODE_FRAME) == scaled);
        CHECK(views(STARFOCUS_MODE_BLOCK) == scaled);
        if (radius < 10) {
          CHECK(views(STARFOCUS_MODE_BENCHMARK) == starfocus::ViewsOfBenchmark(radius));
        }
      }
    }
  }
}

}  // namespace
}  // namespace blocks_test
