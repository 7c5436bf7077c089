// SPDX-License-Identifier: Apache-2.0
// Compares pictures of the engine with the double-precision reference, which gets the engine's own
// partition. Samples must differ by at most one grey level.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/conformance/conformance.h"
#include "tests/support/config.h"
#include "tests/support/error_line.h"
#include "tests/support/rounds.h"
#include "tests/support/sanitizers.h"
#include "tests/support/test_scene.h"
#ifdef STARFOCUS_PROGRAM
#include "examples/scene/render.h"
#include "platform/light_field.h"
#endif

namespace conformance_slow_test {
namespace {

using namespace conformance;

// Checks that trials had pixels at all layers, and pixels that are blurred without rendering views.
void ReportAllLayers(const char* name, const Distance& all) {
  all.Report(name);
  for (const int64_t pixels : all.at_layer) CHECK(pixels > 0);
  CHECK(all.gathered > 0);
}

TEST_CASE("conformance: random light fields and lenses match the reference") {
  const uint64_t last = 60;  // 30 would leave layers without pixels
  ReportAllLayers("random stars", CheckRandom(1, last, Kind::kStar));
  ReportAllLayers("random positions", CheckRandom(1, last, Kind::kAnywhere));
  ReportAllLayers("larger light fields", CheckRandom(1, last, Kind::kLarge));
}

TEST_CASE("conformance: whole pictures rendered by line scans match the reference") {
  CheckRandom(1, test::kSanitized ? 20 : test::kSlow ? 50 : 150, Kind::kPaper).Report("line scans");
}

// The largest subapertures, and the smallest and largest blocks, which the cost of a block decides.
TEST_CASE("conformance: subapertures and blocks of all sizes match the reference") {
  test::Random random(52);
  Distance all;
  for (const uint32_t block_cost : {0u, 1000u, STARFOCUS_MAX_TIMING}) {
    for (const Depth depth : {Depth::kConstant, Depth::kSlanted}) {
      const test::Scene scene = MakeScene(64, 48, 5, {0, 4}, depth, &random, Colours::kRandom);
      for (const double focus : {-25.0, -7.0, -2.0}) {
        for (int max_layer = 0; max_layer < STARFOCUS_LAYERS; ++max_layer) {
          Trial trial = MakeTrial(scene, focus, STARFOCUS_MODE_BLOCK, STARFOCUS_RENDERER_SLICES,
                                  max_layer, 32);
          trial.config.tuning.timing.block = block_cost;
          all.Add(Check(trial));
        }
      }
    }
  }
  ReportAllLayers("subapertures and partitions", all);
}

TEST_CASE("conformance: scenes at the limits of slices and subaperture width match the reference") {
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
  for (const Lens& lens : kLenses) {
    for (const Depth depth : {Depth::kPiecewise, Depth::kNoisy}) {
      for (const int views : {1, 17}) {
        const test::Scene scene =
            MakeScene(64, 48, views, {lens.low, lens.high}, depth, &random, Colours::kRandom);
        for (int max_layer = 0; max_layer < STARFOCUS_LAYERS; ++max_layer) {
          all.Add(Check(MakeTrial(scene, lens.focus, STARFOCUS_MODE_BLOCK,
                                  STARFOCUS_RENDERER_SLICES, max_layer, lens.max_blur)));
        }
      }
    }
  }
  all.Report("many slices and wide subapertures");
}

// The block has three tiles across and two tiles down; the last column of tiles is 72 pixels wide.
// The first range of disparities requires few slices, and the second range requires many slices.
TEST_CASE("conformance: each tile of a large block has its own slices") {
  test::Random random(55);
  Distance all;
  for (const float range : {4.0F, 24.0F}) {
    for (const Depth depth : {Depth::kSlanted, Depth::kNoisy}) {
      const test::Scene scene =
          MakeScene(200, 90, 5, {-range / 2, range / 2}, depth, &random, Colours::kRandom);
      Trial trial =
          MakeTrial(scene, random.Real(-1, 1), STARFOCUS_MODE_FRAME, STARFOCUS_RENDERER_SLICES, 0);
      trial.config.superblock = 256;
      all.Add(Check(trial));
    }
  }
  all.Report("tiles of large blocks");
}

#ifdef STARFOCUS_PROGRAM
// Returns the part of a light field at (x0, y0).
test::Scene Crop(const starfocus::LightField& field, int x0, int y0) {
  constexpr int kWidth = 64, kHeight = 48;
  float low = field.disparity.at(x0, y0), high = low;
  test::Scene scene = test::EmptyScene(kWidth, kHeight, int(field.views.size()), low, high);
  for (int y = 0; y < kHeight; ++y) {
    for (int view = 0; view < scene.views(); ++view) {
      const starfocus::Image& picture = field.views[size_t(view)];
      std::copy_n(picture.pixels.data() + size_t(y0 + y) * picture.stride() + size_t(3 * x0),
                  3 * kWidth, scene.Pixel(view, 0, y));
    }
    for (int x = 0; x < kWidth; ++x) {
      const float disparity = field.disparity.at(x0 + x, y0 + y);
      scene.Disparity(x, y) = disparity;
      low = std::min(low, disparity);
      high = std::max(high, disparity);
    }
  }
  scene.disparity_min = low;
  scene.disparity_max = high;
  return scene;
}

// Checks a part of a light field with both renderers, all maximum layers and both transfer
// functions. The second focus lies far outside the disparities of the part.
Distance CheckPart(const test::Scene& scene) {
  Distance all;
  const double middle = 0.5 * double(scene.disparity_min + scene.disparity_max);
  for (const double focus : {middle, scene.disparity_min - 6.5}) {
    const double reach = std::max(scene.disparity_max - focus, focus - scene.disparity_min);
    for (const starfocus_renderer renderer : test::kRenderers) {
      for (int max_layer = 0; max_layer < STARFOCUS_LAYERS; ++max_layer) {
        for (const starfocus_transfer transfer :
             {STARFOCUS_TRANSFER_NONE, STARFOCUS_TRANSFER_SRGB}) {
          Trial trial = MakeTrial(scene, focus, STARFOCUS_MODE_BLOCK, renderer, max_layer);
          trial.params.aperture = std::min(1.0, 16 / reach);
          trial.config.transfer = transfer;
          all.Add(Check(trial));
        }
      }
    }
  }
  return all;
}

TEST_CASE("conformance: parts of the demo's scenes match the reference") {
  constexpr int kWidth = 192, kHeight = kWidth * 3 / 4;
  starfocus::ThreadRunner runner(1);
  Distance all;
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
    all.Add(CheckPart(Crop(field, kWidth / 3, kHeight / 3)));
  }
  ReportAllLayers("demo scenes", all);
}

TEST_CASE("conformance: parts of the data sets match the reference" *
          doctest::test_suite("data_sets")) {
  Distance all;
  for (const char* name : {"wires", "stilllife", "microcity", "chess", "dino"}) {
    const std::string folder = test::DataSet(name);
    if (folder.empty()) continue;
    CAPTURE(name);
    const starfocus::LightField field = starfocus::ValueOf(starfocus::LoadLightField(folder, {}));
    for (const int x : {200, 330}) all.Add(CheckPart(Crop(field, x, 180)));
  }
  if (all.samples > 0) ReportAllLayers("data sets", all);
}
#endif

}  // namespace
}  // namespace conformance_slow_test
