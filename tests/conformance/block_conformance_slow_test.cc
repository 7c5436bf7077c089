// SPDX-License-Identifier: Apache-2.0
// Compares block mode with the double-precision reference, which gets the engine's own partition.
// On every SIMD target, samples of the engine and of the reference must differ by at most one grey
// level.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "simd/kernels.h"
#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/conformance/conformance.h"
#include "tests/conformance/engine_blocks.h"
#include "tests/conformance/reference.h"
#include "tests/support/config.h"
#include "tests/support/error_line.h"
#include "tests/support/rounds.h"
#include "tests/support/simd_targets.h"
#include "tests/support/test_scene.h"
#ifdef STARFOCUS_PROGRAM
#include "examples/scene/render.h"
#endif

namespace block_conformance_slow_test {
namespace {

using namespace conformance;

constexpr starfocus_renderer kRules[] = {STARFOCUS_RENDERER_LINE_SCAN, STARFOCUS_RENDERER_SLICES};

// Statistics of the blocks: pixels at each layer, pixels blurred without rendering views, and the
// longest side of a rectangle rendered from views.
struct Covered {
  int64_t pixels[STARFOCUS_LAYERS] = {};
  int64_t gathered = 0;
  int longest = 0;
};

void Count(const std::vector<reference::Block>& blocks, Covered* covered) {
  for (const reference::Block& block : blocks) {
    covered->pixels[block.layer] += block.width * block.height;
    const int side = std::max(block.rendered_width, block.rendered_height);
    covered->longest = std::max(covered->longest, side);
    for (const reference::GatheredCell& cell : block.gathered) {
      covered->gathered += cell.width * cell.height;
    }
  }
}

Distance Check(const test::Scene& scene, const starfocus::Params& params,
               const test::Config& config, Covered* covered) {
  test::Engine engine(config);
  REQUIRE(engine.status() == STARFOCUS_OK);
  const EngineResult result =
      RunEngine(scene, params, starfocus::simd::ReferenceKernels(), &engine);
  REQUIRE(result.status == STARFOCUS_OK);
  Count(result.blocks, covered);
  const Distance distance =
      Compare(result.bytes, reference::RefocusBlocks(scene, params, config, result.blocks));
  for (const starfocus::simd::Kernels* kernels : test::SimdTargets()) {
    const bool same = RunEngine(scene, params, *kernels, &engine).bytes == result.bytes;
    CHECK_MESSAGE(same, kernels->name);
  }
  CAPTURE(TextOf(scene, params, config));
  CHECK(distance.largest <= 1);
  if (distance.samples >= kEnoughSamples) CHECK(distance.mean() < kMeanLimit);
  return distance;
}

test::Config Config(const test::Scene& scene, int max_layer, double max_blur = 24) {
  test::Config config = test::ConfigFor(scene, max_blur);
  config.tuning.max_layer = max_layer;
  // The reference has no thin structures, which random disparities contain.
  // coverage_conformance_slow_test compares how their pixels are split.
  config.features &= ~STARFOCUS_FEATURE_COVERAGE;
  // The thresholds of deblocking magnify rounding errors. deblock_test tests deblocking.
  config.tuning.deblocking = 0;
  config.superblock = 32;
  while (config.superblock < scene.height) config.superblock *= 2;
  return config;
}

starfocus::Params SlicesOf(double focus, starfocus_mode mode) {
  starfocus::Params params = test::Params(focus, 1, mode);
  params.study.renderer = STARFOCUS_RENDERER_SLICES;
  return params;
}

// Checks a scene with both renderers and every maximum layer.
Distance CheckAll(const test::Scene& scene, double focus, double aperture, Covered* covered) {
  Distance all;
  for (const starfocus_renderer renderer : kRules) {
    for (int max_layer = 0; max_layer < STARFOCUS_LAYERS; ++max_layer) {
      starfocus::Params params = test::Params(focus, aperture, STARFOCUS_MODE_BLOCK);
      params.study.renderer = renderer;
      Covered here;
      // Both transfer functions are checked, except for sRGB with layer 1 as the maximum.
      for (const starfocus_transfer transfer : {STARFOCUS_TRANSFER_NONE, STARFOCUS_TRANSFER_SRGB}) {
        if (transfer == STARFOCUS_TRANSFER_SRGB && max_layer == 1) continue;
        test::Config config = Config(scene, max_layer);
        config.transfer = transfer;
        all.Add(Check(scene, params, config, &here));
      }
      for (int layer = 0; layer < STARFOCUS_LAYERS; ++layer)
        covered->pixels[layer] += here.pixels[layer];
      covered->gathered += here.gathered;
    }
  }
  return all;
}

void Tell(const char* name, const Distance& all, const Covered& covered) {
  all.Print(name);
  std::printf("  pixels at layers 0, 1, 2: %lld %lld %lld\n",
              static_cast<long long>(covered.pixels[0]), static_cast<long long>(covered.pixels[1]),
              static_cast<long long>(covered.pixels[2]));
  CHECK(all.mean() < kMeanLimit);
  for (const int64_t pixels : covered.pixels) CHECK(pixels > 0);
  std::printf("  gathered: %lld\n", static_cast<long long>(covered.gathered));
}

TEST_CASE(
    "block conformance: random scenes match the reference with both renderers at all layers") {
  test::Random random(51);
  Distance all;
  Covered covered;
  for (int round = 0; round < (test::kSlow ? 1 : 3); ++round) {
    for (const int views : kStars) {
      for (const Depth depth : kDepths) {
        const int width = random.Int(1, 96), height = random.Int(1, 64);
        const float low = float(random.Real(-6, 2));
        const Range range = {low, low + float(random.Real(0.5, 6))};
        const test::Scene scene = MakeScene(width, height, views, range, depth, &random);
        const double aperture = random.Int(0, 1) == 0 ? 1 : random.Real(0.3, 1);
        all.Add(CheckAll(scene, low - random.Real(0, 9), aperture, &covered));
      }
    }
  }
  Tell("random scenes in blocks", all, covered);
}

TEST_CASE("block conformance: slices in benchmark mode match the reference") {
  test::Random random(54);
  Distance all;
  Covered covered;
  for (const int views : kStars) {
    for (const Depth depth : kDepths) {
      const float low = float(random.Real(-3, 2));
      const Range range = {low, low + float(random.Real(0.5, 4))};
      const test::Scene scene =
          MakeScene(random.Int(40, 64), random.Int(33, 48), views, range, depth, &random);
      const starfocus::Params params = SlicesOf(low - random.Real(-1, 2), STARFOCUS_MODE_BENCHMARK);
      all.Add(Check(scene, params, Config(scene, 2), &covered));
    }
  }
  all.Print("the benchmark in slices");
  CHECK(all.mean() < kMeanLimit);
  CHECK(covered.pixels[1] + covered.pixels[2] + covered.gathered == 0);
}

TEST_CASE(
    "block conformance: the largest subapertures and the smallest blocks match the reference") {
  test::Random random(52);
  Distance all;
  Covered covered;
  for (const uint32_t block_cost : {0u, 1000u, STARFOCUS_MAX_TIMING}) {
    for (const Depth depth : {Depth::kConstant, Depth::kSlanted}) {
      const test::Scene scene = MakeScene(64, 48, 5, {0, 4}, depth, &random, Colours::kRandom);
      for (const double focus : {-25.0, -7.0, -2.0}) {
        for (int max_layer = 0; max_layer < STARFOCUS_LAYERS; ++max_layer) {
          const starfocus::Params params = SlicesOf(focus, STARFOCUS_MODE_BLOCK);
          test::Config config = Config(scene, max_layer, 32);
          config.tuning.timing.block = block_cost;
          all.Add(Check(scene, params, config, &covered));
        }
      }
    }
  }
  Tell("subapertures and partitions", all, covered);
}

TEST_CASE(
    "block conformance: scenes at the limits of slices and subaperture width match the reference") {
  struct Lens {
    float low, high;
    double focus, max_blur;
  };
  // The first two lenses blur surfaces on both sides of the focus. The first lens requires more
  // slices than the limit, and the second requires more slices than fit into the memory. The third
  // lens has subapertures that are almost as wide as the widest supported subaperture.
  constexpr Lens kLenses[] = {{-10, 10, 0, 24}, {-23, 23, 0, 24}, {0, 4, -104, 109}};
  test::Random random(53);
  Distance all;
  Covered covered;
  for (const Lens& lens : kLenses) {
    for (const Depth depth : {Depth::kPiecewise, Depth::kNoisy}) {
      for (const int views : {1, 17}) {
        const test::Scene scene =
            MakeScene(64, 48, views, {lens.low, lens.high}, depth, &random, Colours::kRandom);
        for (int max_layer = 0; max_layer < STARFOCUS_LAYERS; ++max_layer) {
          const starfocus::Params params = SlicesOf(lens.focus, STARFOCUS_MODE_BLOCK);
          all.Add(Check(scene, params, Config(scene, max_layer, lens.max_blur), &covered));
        }
      }
    }
  }
  all.Print("many slices and wide subapertures");
}

// The block has three tiles across and two tiles down; the last column of tiles is 72 pixels wide.
// The first range of disparities requires few slices, and the second range requires many slices.
TEST_CASE("block conformance: each tile of a large block has its own slices") {
  test::Random random(55);
  Distance all;
  for (const float range : {4.0F, 24.0F}) {
    for (const Depth depth : {Depth::kSlanted, Depth::kNoisy}) {
      const test::Scene scene =
          MakeScene(200, 90, 5, {-range / 2, range / 2}, depth, &random, Colours::kRandom);
      const starfocus::Params params = SlicesOf(random.Real(-1, 1), STARFOCUS_MODE_FRAME);
      test::Config config = Config(scene, 0);
      config.superblock = 256;
      Covered covered;
      all.Add(Check(scene, params, config, &covered));
      CHECK(covered.longest == 200);
    }
  }
  all.Print("tiles of large blocks");
  CHECK(all.mean() < kMeanLimit);
}

#ifdef STARFOCUS_PROGRAM
TEST_CASE("block conformance: parts of the demo's scenes match the reference") {
  constexpr int kWidth = 192, kHeight = kWidth * 3 / 4;
  starfocus::ThreadRunner runner(1);
  Distance all;
  Covered covered;
  for (const char* name : {"portrait", "wires", "ramp"}) {
    const starfocus::Scene drawn = starfocus::MakeScene(name).value();
    const starfocus::RayTracer renderer(drawn, kWidth, kHeight, STARFOCUS_TRANSFER_NONE, &runner);
    starfocus::LightField field;
    for (int i = 0; i < 5; ++i) {
      double u = 0, v = 0;
      starfocus_view_position(i, &u, &v, nullptr);
      field.views.push_back(renderer.View(u, v, nullptr));
    }
    field.disparity = renderer.Disparity();
    // Disparities in a picture of this size are only a few pixels, so the second focus lies far
    // outside their range.
    const test::Scene scene = Crop(field, kWidth / 3, kHeight / 3, 64, 48);
    for (const double focus : {double(scene.disparity_max), scene.disparity_min - 6.5}) {
      all.Add(CheckAll(scene, focus, 1, &covered));
    }
  }
  Tell("demo scenes", all, covered);
}

TEST_CASE("block conformance: parts of the data sets match the reference" *
          doctest::test_suite("data_sets")) {
  Distance all;
  Covered covered;
  bool any = false;
  for (const char* name : {"wires", "stilllife", "microcity", "chess", "dino"}) {
    const std::string folder = test::DataSet(name);
    if (folder.empty()) continue;
    any = true;
    starfocus::LightField field = starfocus::ValueOf(starfocus::LoadLightField(folder, {}));
    for (const int x : {200, 330}) {
      const test::Scene scene = Crop(field, x, 180, 64, 48);
      CAPTURE(name);
      const double middle = 0.5 * double(scene.disparity_min + scene.disparity_max);
      for (const double focus : {middle, scene.disparity_min - 6.5}) {
        const double reach = std::max(scene.disparity_max - focus, focus - scene.disparity_min);
        all.Add(CheckAll(scene, focus, std::min(1.0, 16 / reach), &covered));
      }
    }
  }
  if (any) Tell("data sets", all, covered);
}
#endif

}  // namespace
}  // namespace block_conformance_slow_test
