// SPDX-License-Identifier: Apache-2.0
// Tests the blur of a small white patch for openings of every shape. The blurred patch must have
// the shape of the opening, rotated by half a turn if the patch is nearer than the focus.
#include "tests/support/shapes.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/refocused.h"
#include "tests/support/test_scene.h"

namespace shapes_test {
namespace {

constexpr int kSide = 96;

struct Place {
  int x = kSide / 2, y = kSide / 2;  // centre of the white patch
};

// Levels of a refocused picture that shows 3x3 white pixels at disparity 0.
struct Patch {
  std::vector<int> levels;
  Place place;

  Patch(const test::NamedShape& shape, double focus, starfocus_mode mode,
        starfocus_renderer renderer, Place at)
      : place(at) {
    test::Scene scene = test::EmptyScene(kSide, kSide, 1, 0, 0);
    std::fill(scene.pictures[0].begin(), scene.pictures[0].end(), uint8_t{0});
    for (int y = -1; y <= 1; ++y) {
      for (int x = -1; x <= 1; ++x) std::fill_n(scene.Pixel(0, at.x + x, at.y + y), 3, 255);
    }
    test::Config config = test::ConfigFor(scene, std::abs(focus) + 1);
    config.superblock = 32;
    config.tuning.max_layer = 0;                // Layers 1 and 2 would smooth the picture.
    config.transfer = STARFOCUS_TRANSFER_NONE;  // Levels are proportional to light.
    starfocus::Params params = test::Params(focus, 1, mode, renderer);
    shape.Set(&params);
    test::ReserveFor(params, &config);
    const test::Output out = test::OutputOf(config, params, scene);
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) levels.push_back(*out.Pixel(x, y));
    }
  }

  // Returns the level at the position (x, y) relative to the centre of the patch.
  int At(int x, int y) const {
    x += place.x;
    y += place.y;
    return x < 0 || y < 0 || x >= kSide || y >= kSide ? 0 : levels[size_t(y * kSide + x)];
  }
  template <class Weight>
  double Sum(const Weight& weight) const {
    double sum = 0;
    for (int y = -kSide; y < kSide; ++y) {
      for (int x = -kSide; x < kSide; ++x) sum += At(x, y) * weight(x, y);
    }
    return sum;
  }
  double Light() const {
    return Sum([](int, int) { return 1.0; });
  }
  // Returns the sum of differences between the picture and image(x, y), divided by the light of the
  // picture.
  template <class Image>
  double Unlike(const Image& image) const {
    double sum = 0;
    for (int y = -40; y <= 40; ++y) {
      for (int x = -40; x <= 40; ++x) sum += std::abs(At(x, y) - image(x, y));
    }
    return sum / Light();
  }
};

const test::NamedShape kRing = {"ring", STARFOCUS_SHAPE_RING, 5, 0, 0, 0.6F, 0};
const test::NamedShape kPentagon = {"pentagon", STARFOCUS_SHAPE_POLYGON, 5, 0, 0, 0.5F, 0};
const test::NamedShape kCatsEye = {"cat's eye", STARFOCUS_SHAPE_DISC, 5, 0, 0, 0.5F, 1};

TEST_CASE("shapes: for every opening, a blurred patch keeps its total light") {
  for (const test::NamedShape& shape : test::kShapes) {
    for (const starfocus_mode mode : test::kModes) {
      CAPTURES(shape.name, mode);
      const starfocus_renderer renderer =
          mode == STARFOCUS_MODE_FRAME ? STARFOCUS_RENDERER_LINE_SCAN : STARFOCUS_RENDERER_AUTO;
      const Patch patch(shape, 9, mode, renderer, {});
      CHECK(patch.Light() == doctest::Approx(9 * 255).epsilon(0.03));
    }
  }
}

TEST_CASE(
    "shapes: with a steep fall-off, dark areas beyond the reach of bright areas do not change") {
  constexpr int kWidth = 40, kHeight = 12, kEdge = 28;
  test::Scene scene = test::EmptyScene(kWidth, kHeight, 1, 0, 0);
  const test::Config config = test::ConfigFor(scene, 4);
  for (const starfocus_mode mode : test::kModes) {
    for (int code = 1; code < 40; ++code) {
      for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x)
          std::fill_n(scene.Pixel(0, x, y), 3, x < kEdge ? code : 249);
      }
      starfocus::Params params = test::Params(2.4, 1, mode);
      params.theta = 1.41;
      const test::Output out = test::OutputOf(config, params, scene);
      CAPTURES(mode, code);
      CHECK(int{*out.Pixel(10, 6)} == code);
    }
  }
}

TEST_CASE("shapes: the blur of a ring opening is dark in the middle") {
  for (const starfocus_mode mode : test::kModes) {
    CAPTURE(mode);
    const Patch patch(kRing, -10, mode, STARFOCUS_RENDERER_AUTO, {});
    for (int y = -2; y <= 2; ++y) {
      for (int x = -2; x <= 2; ++x) CHECK(patch.At(x, y) == 0);
    }
    CHECK(patch.At(8, 0) > 8);
    CHECK(patch.At(0, -8) > 8);
    CHECK(patch.At(-6, 6) > 8);
  }
}

TEST_CASE(
    "shapes: the blur of a pentagon has one axis of symmetry, and is upside down in front of the "
    "focus") {
  for (const starfocus_mode mode : test::kModes) {
    for (const starfocus_renderer renderer : test::kRenderers) {
      CAPTURES(mode, renderer);
      const Patch far(kPentagon, 10, mode, renderer, {}), near(kPentagon, -10, mode, renderer, {});
      CHECK(far.Unlike([&](int x, int y) { return far.At(-x, y); }) < 0.03);
      CHECK(far.Unlike([&](int x, int y) { return far.At(x, -y); }) > 0.1);
      CHECK(far.Unlike([&](int x, int y) { return far.At(y, x); }) > 0.1);
      CHECK(far.Unlike([&](int x, int y) { return near.At(-x, -y); }) < 0.03);
      // One corner of the pentagon is at the top, and the lowest edge is cos(36 degrees) radii
      // below the centre.
      CHECK(far.Sum([](int, int y) { return y < -8 ? 1 : 0; }) > 10);
      CHECK(far.Sum([](int, int y) { return y > 9 ? 1 : 0; }) <= 10);
      CHECK(far.Sum([](int x, int) { return x; }) / far.Light() == doctest::Approx(0).epsilon(0.1));
    }
  }
}

TEST_CASE("shapes: in all modes, the blur of a patch is close to the blur of blur mode") {
  for (const test::NamedShape& shape : test::kShapes) {
    if (shape.cats_eye > 0) continue;
    for (const double focus : {6.0, -11.0}) {
      const Patch ideal(shape, focus, STARFOCUS_MODE_BLUR, STARFOCUS_RENDERER_AUTO, {});
      for (const starfocus_mode mode :
           {STARFOCUS_MODE_FRAME, STARFOCUS_MODE_BENCHMARK, STARFOCUS_MODE_BLOCK}) {
        for (const starfocus_renderer renderer : test::kRenderers) {
          CAPTURES(shape.name, focus, mode, renderer);
          const Patch patch(shape, focus, mode, renderer, {});
          CHECK(patch.Unlike([&](int x, int y) { return ideal.At(x, y); }) < 0.12);
        }
      }
    }
  }
}

TEST_CASE("shapes: cat's eyes are cut on the side away from the middle of the picture") {
  for (const starfocus_mode mode :
       {STARFOCUS_MODE_FRAME, STARFOCUS_MODE_BENCHMARK, STARFOCUS_MODE_BLOCK}) {
    for (const starfocus_renderer renderer : test::kRenderers) {
      CAPTURES(mode, renderer);
      for (const int side : {-1, 1}) {
        const Place corner = {kSide / 2 + 32 * side, kSide / 2 - 32 * side};
        const Patch far(kCatsEye, 10, mode, renderer, corner),
            near(kCatsEye, -10, mode, renderer, corner);
        // Surfaces nearer than the focus show the opening rotated by half a turn.
        CHECK(far.Sum([&](int x, int) { return x * side; }) / far.Light() < -1.5);
        CHECK(far.Sum([&](int, int y) { return -y * side; }) / far.Light() < -1.5);
        CHECK(near.Sum([&](int x, int) { return x * side; }) / near.Light() > 1.5);
        CHECK(near.Sum([&](int, int y) { return -y * side; }) / near.Light() > 1.5);
      }
      const Patch middle(kCatsEye, 10, mode, renderer, {});
      CHECK(std::fabs(middle.Sum([](int x, int) { return x; })) < 1.5 * middle.Light());
    }
  }
}

}  // namespace
}  // namespace shapes_test
