// SPDX-License-Identifier: Apache-2.0
// Estimates and repairs the maps of several views of scenes whose disparities are known. Each row
// of a table names a scene, the damage of the given map, and the largest share of wrong pixels.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "tests/depth/depth_scene.h"
#include "tests/support/config.h"

namespace sweeps_test {
namespace {

using namespace test;

constexpr float kLow = -6, kHigh = 8;

PlaneScene Star(int views) {
  PlaneScene scene;
  scene.views = views;
  return scene;
}

PlaneScene At(const std::vector<starfocus_position>& positions) {
  PlaneScene scene;
  scene.positions = positions;
  return scene;
}

// One plane whose disparity changes by `lean` per pixel of x.
PlaneScene OnePlane(double lean) {
  PlaneScene scene;
  scene.near_left = scene.near_right = 0;
  scene.lean = lean;
  return scene;
}

// Returns the map of an estimate, or of a repair if `given` is not empty.
MadeMap Swept(const PlaneScene& scene, const std::vector<float>& given = {}) {
  const PlaneField field = RenderPlanes(scene);
  return MakeMap(field, ConfigOf(field, kLow, kHigh), given);
}

// A bound on the share of pixels whose disparity differs by more than `by` pixels.
struct Bound {
  double by, share;
};

struct Estimated {
  PlaneScene scene;
  Bound fine, coarse;
};

TEST_CASE("sweeps: estimates have small errors where a side view shows the pixel") {
  // Two edges of the near plane with an error of one pixel each give wrong disparities in 2 of 96
  // columns.
  const Bound edges = {0.28, 0.022}, off = {1, 0.022};
  const Bound quarter = {0.28, 0.16}, one = {1, 0.035};
  const Estimated estimates[] = {
      {Star(5), edges, off},
      {Star(9), edges, off},
      {Star(17), edges, off},
      {At({{0, 0}, {1, 0}}), quarter, one},
      {At({{0, 0}, {-0.9, 0.3}}), quarter, one},
      {At({{0, 0}, {0, 1}}), quarter, one},
      {At({{0, 0}, {1, 0}, {-1, 0}}), quarter, one},
      {At({{0, 0}, {1, 0}, {0, 1}}), quarter, one},
      {At({{0, 0}, {0.4, 0.3}, {-0.8, 0.5}, {0.1, -0.7}}), quarter, one},
      {At({{0, 0}, {1, 0}, {-1, 0}, {0.5, 0}, {-0.5, 0}, {0.25, 0}, {-0.25, 0}}), quarter, one},
      {OnePlane(0.04), {0.1, 0.1}, {0.2, 0.01}},  // Disparities are interpolated between labels.
  };
  for (const Estimated& row : estimates) {
    CAPTURE(&row - estimates);
    const std::vector<float> found = Swept(row.scene).disparity;
    CHECK(ShareOff(row.scene, found, row.fine.by) < row.fine.share);
    CHECK(ShareOff(row.scene, found, row.coarse.by) < row.coarse.share);
  }
}

// Changes a correct map of the scene.
using Damage = void (*)(const PlaneScene& scene, std::vector<float>* map);

template <int kGrown>
void Grow(const PlaneScene& scene, std::vector<float>* map) {
  *map = MapOf(scene, kGrown);
}

void Blur(const PlaneScene& scene, std::vector<float>* map) {
  const std::vector<float> exact = *map;
  for (int y = 0; y < scene.height; ++y) {
    for (int x = 5; x < scene.width - 5; ++x) {
      float sum = 0;
      for (int k = -5; k <= 5; ++k) sum += exact[size_t(y * scene.width + x + k)];
      (*map)[size_t(y * scene.width + x)] = sum / 11;
    }
  }
}

void AddNoise(const PlaneScene&, std::vector<float>* map) {
  test::Random random(5);
  for (float& value : *map) value += float(random.Int(-100, 100)) * 0.01F;
}

void Lift(const PlaneScene& scene, std::vector<float>* map) {
  for (size_t at = 0; at < map->size(); ++at) {
    const size_t x = at % size_t(scene.width);
    if (x >= 40 && x < 80) (*map)[at] += 2.5F;
  }
}

void Forget(const PlaneScene& scene, std::vector<float>* map) {
  for (int y = 10; y < 50; ++y) {
    for (int x = 20; x < 45; ++x) {
      (*map)[size_t(y * scene.width + x)] =
          x % 2 == 0 ? NAN : std::numeric_limits<float>::infinity();
    }
  }
}

struct Repaired {
  const char* name;
  PlaneScene scene;
  Damage damage;
  Bound before, after;  // `before` is a lower bound.
};

TEST_CASE("sweeps: repairs of damaged maps give the disparities that the views show") {
  const Bound edges = {0.5, 0.06}, sharp = {0.1, 0.012}, two_columns = {0.28, 0.03};
  const Repaired repairs[] = {
      {"an edge too far out", Star(5), Grow<3>, edges, sharp},
      {"an edge too far out", Star(9), Grow<3>, edges, sharp},
      {"an edge too far out", Star(17), Grow<3>, edges, sharp},
      {"an edge too far in", Star(5), Grow<-3>, edges, sharp},
      {"an edge too far in", Star(9), Grow<-3>, edges, sharp},
      {"an edge too far in", Star(17), Grow<-3>, edges, sharp},
      {"a blurred edge", Star(17), Blur, {0.5, 0.15}, two_columns},
      {"noise", Star(17), AddNoise, {0.28, 0.6}, two_columns},
      {"unknown values", Star(17), Forget, {0.5, 0.1}, {0.28, 0.022}},
      {"a smooth part that contradicts the views", OnePlane(0), Lift, {1, 0.4}, two_columns},
  };
  for (const Repaired& row : repairs) {
    CAPTURES(row.name, row.scene.views);
    std::vector<float> given = MapOf(row.scene);
    row.damage(row.scene, &given);
    CHECK(ShareOff(row.scene, given, row.before.by) > row.before.share);
    const std::vector<float> found = Swept(row.scene, given).disparity;
    CHECK(ShareOff(row.scene, found, row.after.by) < row.after.share);
  }
}

TEST_CASE("sweeps: in a pair, pixels hidden in the side view get the far disparity") {
  for (const double u : {1.0, -1.0}) {
    const PlaneScene scene = At({{0, 0}, {u, 0}});
    const MadeMap found = Swept(scene);
    // The near plane moves by 8 pixels relative to the far plane, and hides as many pixels of the
    // far plane next to its left or right edge. Three columns at an end of the picture move out of
    // the side view. The first and the last hidden column may be wrong by a pixel.
    const int hidden = u > 0 ? 30 - 8 : 62, outside = u > 0 ? scene.width - 2 : 0;
    int pixels = 0, right = 0;
    for (int at = 0; at < scene.width * scene.height; ++at) {
      const int x = at % scene.width;
      const bool is_hidden = x > hidden && x < hidden + 7;
      if (!is_hidden && (x < outside || x >= outside + 2)) continue;
      ++pixels;
      right +=
          std::fabs(found.disparity[size_t(at)] + 3) < 0.6 && found.confidence[size_t(at)] == 0;
    }
    CAPTURE(u);
    CHECK(pixels == 8 * scene.height);
    CHECK(right > 0.97 * pixels);
  }
}

TEST_CASE("sweeps: positions of the star give the same map as no positions") {
  std::vector<starfocus_position> positions(5);
  for (int k = 0; k < 5; ++k) {
    starfocus_position* at = &positions[size_t(k)];
    starfocus_view_position(k, &at->u, &at->v, nullptr);
  }
  const MadeMap without = Swept(Star(5)), with = Swept(At(positions));
  CHECK(with.disparity == without.disparity);
  CHECK(with.confidence == without.confidence);
}

TEST_CASE("sweeps: confidence is high where only one disparity fits, and 0 without texture") {
  std::vector<uint8_t> confidence = Swept(PlaneScene()).confidence;
  std::sort(confidence.begin(), confidence.end());
  CHECK(confidence[confidence.size() / 2] > 48);
  PlaneField field = RenderPlanes(PlaneScene());
  for (auto& view : field.views) std::fill(view.begin(), view.end(), uint8_t{90});
  const MadeMap found = MakeMap(field, ConfigOf(field, kLow, kHigh));
  CheckWithin(found.disparity, kLow, kHigh);
  for (const uint8_t value : found.confidence) CHECK(int(value) == 0);
  // A repair keeps the map, even if its edges are wrong.
  const std::vector<float> given = MapOf(PlaneScene(), 2);
  CHECK(MakeMap(field, ConfigOf(field, kLow, kHigh), given).disparity == given);
}

TEST_CASE("sweeps: if all views agree, confidence is the colour difference of adjacent pixels") {
  PlaneField field = RenderPlanes(PlaneScene());
  // Adjacent pixels of a row differ by 7 levels in each channel, and adjacent pixels of a column by
  // 4 levels.
  for (auto& view : field.views) {
    for (int at = 0; at < int(view.size()); ++at) {
      const int x = at / 3 % field.width, y = at / 3 / field.width;
      view[size_t(at)] = uint8_t(100 + 7 * (x % 2) + 4 * (y % 2));
    }
  }
  const std::vector<float> still(size_t(field.width * field.height), 0.0F);
  const MadeMap repaired = MakeMap(field, ConfigOf(field, kLow, kHigh), still);
  CHECK(repaired.disparity == still);
  for (const uint8_t sure : repaired.confidence) REQUIRE(int(sure) == 4 * (3 * 7 + 3 * 4) / 2);
}

TEST_CASE(
    "sweeps: a repair changes a correct map in under 0.5 % of the pixels, and a plane never") {
  PlaneScene scene;
  scene.near = 5.013;
  scene.far = -3.27;
  scene.lean = 0.02;
  const std::vector<float> given = MapOf(scene), repaired = Swept(scene, given).disparity;
  int changed = 0;
  for (size_t i = 0; i < given.size(); ++i) changed += repaired[i] != given[i];
  CHECK(changed < int(given.size()) / 200);
  scene.near_left = scene.near_right = 0;
  CHECK(Swept(scene, MapOf(scene)).disparity == MapOf(scene));
}

TEST_CASE("sweeps: disparities are within the configured range for pictures of any size") {
  for (const PlaneScene& scene : ScenesOfAnySize()) {
    const PlaneField field = RenderPlanes(scene);
    for (const auto& [low, high] :
         {std::pair<float, float>{0, 0.25F}, {-3.3F, 4.7F}, {-500, 500}}) {
      CheckWithin(MakeMap(field, ConfigOf(field, low, high)).disparity, low, high);
    }
    CheckWithin(MakeMap(field, ConfigOf(field, -500, 500), MapOf(scene, 1)).disparity, -500, 500);
  }
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
};

// Repairs of the map of strands, exact or with closed gaps.
struct Strands {
  int views;
  bool closed;
  double lost;  // Largest share of the pixels of strands that may get the far disparity.
  int opened;   // Least number of pixels of gaps that must get the far disparity.
};

TEST_CASE("sweeps: a repair keeps strands, and opens the gaps that the map has closed") {
  for (const Strands& row : {Strands{1, false, 0.02, 0},
                             {5, false, 0.02, 0},
                             {17, false, 0.02, 0},
                             {5, true, 0.05, 101}}) {
    CAPTURES(row.views, row.closed);
    constexpr int kWidth = StrandScene::kWidth, kHeight = StrandScene::kHeight;
    std::vector<bool> is_strand;
    std::vector<float> given;
    for (int at = 0; at < kWidth * kHeight; ++at) {
      const int x = at % kWidth;
      is_strand.push_back(StrandScene::IsStrand(x, at / kWidth));
      const bool near = is_strand.back() || (row.closed && x > 16 && x < 80);
      given.push_back(float(near ? StrandScene::kNear : StrandScene::kFar));
    }
    const PlaneField field = RenderViews(kWidth, kHeight, row.views, StrandScene::Pixel);
    const MadeMap repaired = MakeMap(field, ConfigOf(field, kLow, kHigh), given);
    int lost = 0, strands = 0, opened = 0;
    for (size_t i = 0; i < given.size(); ++i) {
      strands += is_strand[i];
      (is_strand[i] ? lost : opened) += given[i] > 0 && repaired.disparity[i] < 0;
    }
    CHECK(strands > 1000);
    CHECK(lost < strands * row.lost);
    CHECK(opened >= row.opened);
  }
}

}  // namespace
}  // namespace sweeps_test
