// SPDX-License-Identifier: Apache-2.0
// Repairs maps of known scenes, and checks which arguments starfocus_repair_disparity rejects.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "starfocus/depth.h"
#include "tests/depth/depth_scene.h"

namespace repair_bytes_test {
namespace {

using namespace test;

constexpr float kLow = -6, kHigh = 8;

TEST_CASE("repair: displaced edges of the map move to the edges of the picture") {
  for (const int views : {5, 9, 17}) {
    PlaneScene scene;
    scene.views = views;
    const PlaneField field = RenderPlanes(scene);
    for (const int grown : {-3, 3}) {
      const std::vector<float> given = MapOf(scene, grown);
      CAPTURE(views);
      CAPTURE(grown);
      CHECK(ShareOff(scene, given, 0.5) > 0.06);
      // Two edges of the near plane with an error of one pixel each give wrong disparities in 2 of
      // 96 columns.
      const MadeMap repaired = MakeMap(field, ConfigOf(field, kLow, kHigh), given);
      CHECK(ShareOff(scene, repaired.disparity, 0.1) < 0.012);
    }
  }
}

TEST_CASE("repair: a blurred edge of the map becomes a sharp edge") {
  PlaneScene scene;
  const PlaneField field = RenderPlanes(scene);
  const std::vector<float> exact = MapOf(scene, 0);
  std::vector<float> given = exact;
  for (int y = 0; y < scene.height; ++y) {
    for (int x = 5; x < scene.width - 5; ++x) {
      float sum = 0;
      for (int k = -5; k <= 5; ++k) sum += exact[size_t(y * scene.width + x + k)];
      given[size_t(y * scene.width + x)] = sum / 11;
    }
  }
  CHECK(ShareOff(scene, given, 0.5) > 0.15);
  const MadeMap repaired = MakeMap(field, ConfigOf(field, kLow, kHigh), given);
  CHECK(ShareOff(scene, repaired.disparity, 0.28) < 0.03);
}

TEST_CASE("repair: noise is removed") {
  PlaneScene scene;
  const PlaneField field = RenderPlanes(scene);
  std::vector<float> given = MapOf(scene, 0);
  test::Random random(5);
  for (float& value : given) value += float(random.Int(-100, 100)) * 0.01F;
  CHECK(ShareOff(scene, given, 0.28) > 0.6);
  const MadeMap repaired = MakeMap(field, ConfigOf(field, kLow, kHigh), given);
  CHECK(ShareOff(scene, repaired.disparity, 0.28) < 0.03);
}

TEST_CASE("repair: a correct map changes in less than 0.5 % of the pixels, and a plane in no bit") {
  PlaneScene scene;
  scene.near = 5.013;
  scene.far = -3.27;
  scene.lean = 0.02;
  const PlaneField field = RenderPlanes(scene);
  const std::vector<float> given = MapOf(scene, 0);
  const MadeMap repaired = MakeMap(field, ConfigOf(field, kLow, kHigh), given);
  int changed = 0;
  for (size_t i = 0; i < given.size(); ++i) changed += repaired.disparity[i] != given[i];
  CHECK(changed < int(given.size()) / 200);
  // A repair must not change any value of a map of one plane.
  scene.near_left = scene.near_right = 0;
  const std::vector<float> plane = MapOf(scene, 0);
  CHECK(MakeMap(RenderPlanes(scene), ConfigOf(field, kLow, kHigh), plane).disparity == plane);
}

// The scene has two sets of strands in front of a wall. Strands are approximately 1.25 pixels wide,
// and the sets cross each other.
struct StrandScene {
  static constexpr int kWidth = 96, kHeight = 80;
  static constexpr double kNear = 7, kFar = -5;

  static bool IsStrand(double x, double y) {
    const auto within = [](double at, double period) {
      return std::abs(at - period * std::round(at / period)) < 0.62;
    };
    return x > 16 && x < 80 && (within(x + 0.4 * y, 4.3) || within(x - 0.3 * y, 7.1));
  }
  // Returns the mean of 16 samples within the pixel.
  static uint8_t Pixel(double u, double v, int x, int y, int c) {
    double sum = 0;
    for (int k = 0; k < 16; ++k) {
      const double across = x + (k % 4 - 1.5) / 4, down = y + (k / 4 - 1.5) / 4;
      const bool strand = IsStrand(across + u * kNear, down + v * kNear);
      sum += strand ? 40 + 20 * c : PlaneScene::Texture(across + u * kFar, down + v * kFar, 2, c);
    }
    return uint8_t(sum / 16 + 0.5);
  }
  static PlaneField Render(int views) { return RenderViews(kWidth, kHeight, views, Pixel); }
  static std::vector<float> Map() {
    std::vector<float> map;
    for (int at = 0; at < kWidth * kHeight; ++at) {
      map.push_back(float(IsStrand(at % kWidth, at / kWidth) ? kNear : kFar));
    }
    return map;
  }
};

TEST_CASE("repair: an exact map keeps at least 98 % of its strand pixels") {
  const std::vector<float> given = StrandScene::Map();
  for (const int views : {1, 5, 17}) {
    CAPTURE(views);
    const PlaneField field = StrandScene::Render(views);
    const MadeMap repaired = MakeMap(field, ConfigOf(field, kLow, kHigh), given);
    int lost = 0, strands = 0;
    for (size_t i = 0; i < given.size(); ++i) {
      strands += given[i] > 0;
      lost += given[i] > 0 && repaired.disparity[i] < 0;
    }
    CHECK(strands > 1000);
    CHECK(lost < strands / 50);
  }
}

TEST_CASE(
    "repair: if the map closes the gaps between strands, the gaps open and the strands stay") {
  const std::vector<float> exact = StrandScene::Map();
  std::vector<float> given = exact;
  for (size_t i = 0; i < given.size(); ++i) {
    const size_t x = i % StrandScene::kWidth;
    if (x > 16 && x < 80) given[i] = StrandScene::kNear;
  }
  const PlaneField field = StrandScene::Render(5);
  const MadeMap repaired = MakeMap(field, ConfigOf(field, kLow, kHigh), given);
  int lost = 0, strands = 0, opened = 0;
  for (size_t i = 0; i < given.size(); ++i) {
    strands += exact[i] > 0;
    lost += exact[i] > 0 && repaired.disparity[i] < 0;
    opened += exact[i] < 0 && given[i] > 0 && repaired.disparity[i] < 0;
  }
  CHECK(lost < strands / 20);
  CHECK(opened > 100);
}

TEST_CASE("repair: if all views have one colour, the map does not change") {
  const PlaneScene scene;
  PlaneField field = RenderPlanes(scene);
  for (auto& view : field.views) std::fill(view.begin(), view.end(), uint8_t{90});
  const std::vector<float> given = MapOf(scene, 2);
  CHECK(MakeMap(field, ConfigOf(field, kLow, kHigh), given).disparity == given);
}

TEST_CASE("repair: if all views agree, confidence is the colour difference of adjacent pixels") {
  const PlaneScene scene;
  PlaneField field = RenderPlanes(scene);
  // Adjacent pixels of a row differ by 7 levels in each channel, and adjacent pixels of a column by
  // 4 levels.
  for (auto& view : field.views) {
    for (int at = 0; at < int(view.size()); ++at) {
      const int x = at / 3 % field.width, y = at / 3 / field.width;
      view[size_t(at)] = uint8_t(100 + 7 * (x % 2) + 4 * (y % 2));
    }
  }
  const std::vector<float> still(size_t(scene.width * scene.height), 0.0F);
  const MadeMap repaired = MakeMap(field, ConfigOf(field, kLow, kHigh), still);
  CHECK(repaired.disparity == still);
  for (const uint8_t sure : repaired.confidence) REQUIRE(int(sure) == 4 * (3 * 7 + 3 * 4) / 2);
}

TEST_CASE("repair: unknown values get the disparity that the views show") {
  PlaneScene scene;
  const PlaneField field = RenderPlanes(scene);
  std::vector<float> given = MapOf(scene, 0);
  for (int y = 10; y < 50; ++y) {
    for (int x = 20; x < 45; ++x) {
      given[size_t(y * scene.width + x)] =
          x % 2 == 0 ? NAN : std::numeric_limits<float>::infinity();
    }
  }
  const MadeMap repaired = MakeMap(field, ConfigOf(field, kLow, kHigh), given);
  CHECK(ShareOff(scene, repaired.disparity, 0.28) < 0.022);
}

TEST_CASE("repair: disparities are within the configured range for pictures of any size") {
  for (const PlaneScene& scene : ScenesOfAnySize()) {
    const PlaneField field = RenderPlanes(scene);
    CheckWithin(MakeMap(field, ConfigOf(field, -500, 500), MapOf(scene, 1)).disparity, -500, 500);
  }
}

TEST_CASE(
    "repair: with one view, the disparities of a noisy map stay within the configured range") {
  constexpr int kSide = 64;
  const PlaneField field = {kSide, kSide, {std::vector<uint8_t>(3 * kSide * kSide, 90)}};
  std::vector<float> given;
  test::Random random(11);
  const float low = 1.003F, high = 7;  // 1.003 is not a multiple of 1/64
  for (int at = 0; at < kSide * kSide; ++at) {
    given.push_back(at % kSide < 16 ? low : float(random.Real(4, high)));
  }
  const std::vector<float> found = MakeMap(field, ConfigOf(field, low, high), given).disparity;
  CHECK(found != given);
  CheckWithin(found, low, high);
}

}  // namespace
}  // namespace repair_bytes_test
