// Mirroring, transposing or turning the light field does the same to the refocused picture, when
// the picture is whole blocks: exactly, but for turns with wide aperture cells.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <utility>

#include "starfocus/starfocus.h"
#include "tests/test_scene.h"

namespace {

// One of the eight symmetries of the square: transposes first, then mirrors.
struct Symmetry {
  std::string name;
  bool transpose, mirror_x, mirror_y;
};

const Symmetry kMirrors[] = {{"mirror x", false, true, false},
                             {"mirror y", false, false, true},
                             {"turn 180", false, true, true}};
const Symmetry kTurns[] = {{"transpose", true, false, false},
                           {"turn 90", true, true, false},
                           {"turn 270", true, false, true},
                           {"anti-transpose", true, true, true}};

// Where pixel (x, y) of a width x height picture goes.
std::pair<int, int> Move(const Symmetry& s, int width, int height, int x, int y) {
  if (s.transpose) {
    std::swap(x, y);
    std::swap(width, height);
  }
  return {s.mirror_x ? width - 1 - x : x, s.mirror_y ? height - 1 - y : y};
}

// Index of the view that captured view `index` becomes.
int MoveView(const Symmetry& s, int index) {
  double u = 0, v = 0;
  REQUIRE(sf_view_position(index, &u, &v) != 0);
  if (s.transpose) std::swap(u, v);
  if (s.mirror_x) u = -u;
  if (s.mirror_y) v = -v;
  for (int i = 0; i < SF_MAX_VIEWS; ++i) {
    double other_u = 0, other_v = 0;
    sf_view_position(i, &other_u, &other_v);
    if (other_u == u && other_v == v) return i;
  }
  FAIL("no such view");
  return 0;
}

test::Scene Move(const Symmetry& s, const test::Scene& scene) {
  const int width = s.transpose ? scene.height : scene.width;
  const int height = s.transpose ? scene.width : scene.height;
  test::Scene moved =
      test::EmptyScene(width, height, scene.views(), scene.disparity_min, scene.disparity_max);
  for (int y = 0; y < scene.height; ++y) {
    for (int x = 0; x < scene.width; ++x) {
      const auto [mx, my] = Move(s, scene.width, scene.height, x, y);
      moved.Disparity(mx, my) = scene.Disparity(x, y);
    }
  }
  for (int view = 0; view < scene.views(); ++view) {
    const int to = MoveView(s, view);
    for (int y = 0; y < scene.height; ++y) {
      for (int x = 0; x < scene.width; ++x) {
        const auto [mx, my] = Move(s, scene.width, scene.height, x, y);
        std::copy_n(scene.Pixel(view, x, y), 3, moved.Pixel(to, mx, my));
      }
    }
  }
  return moved;
}

test::Output Refocused(const test::Scene& scene, const sf_params& params) {
  sf_config config = test::ConfigFor(scene);
  config.largest_block = 32;
  config.max_layer = 0;  // layers keep every second pixel, from the left and the top
  test::Engine engine(config);
  REQUIRE(engine.status() == SF_OK);
  test::Output out(scene.width, scene.height);
  REQUIRE(test::Refocus(&engine, params, scene, &out) == SF_OK);
  return out;
}

// Between the moved picture of one and another.
struct Distance {
  int samples = 0;  // that differ
  int largest = 0;
  double mean = 0;
};

Distance Compare(const Symmetry& s, const test::Output& plain, const test::Output& moved) {
  Distance distance;
  for (int y = 0; y < plain.height; ++y) {
    for (int x = 0; x < plain.width; ++x) {
      const auto [mx, my] = Move(s, plain.width, plain.height, x, y);
      for (int c = 0; c < 3; ++c) {
        const int difference = std::abs(plain.Pixel(x, y)[c] - moved.Pixel(mx, my)[c]);
        distance.samples += difference != 0;
        distance.largest = std::max(distance.largest, difference);
        distance.mean += difference / (3.0 * plain.width * plain.height);
      }
    }
  }
  return distance;
}

Distance Measure(const Symmetry& s, const test::Scene& scene, const sf_params& params) {
  const test::Output plain = Refocused(scene, params);
  CHECK(plain.bytes != scene.pictures[0]);
  return Compare(s, plain, Refocused(Move(s, scene), params));
}

void Check(const Symmetry& s, const test::Scene& scene, const sf_params& params) {
  CAPTURE(s.name);
  CAPTURE(scene.width);
  CAPTURE(scene.height);
  CAPTURE(scene.views());
  CAPTURE(params.focus);
  CHECK(Measure(s, scene, params).samples == 0);
}

constexpr int kSizes[][2] = {{32, 32}, {64, 64}, {96, 32}, {64, 128}};

TEST_CASE("symmetry: mirrored light fields give mirrored pictures") {
  for (const auto& size : kSizes) {
    for (int views : {17, 9, 5, 1}) {
      const test::Scene scene = test::RandomScene(size[0], size[1], views, -4, 4, 31);
      for (const Symmetry& s : kMirrors) {
        Check(s, scene, test::Params(0));
        Check(s, scene, test::Params(-3.3, 0.7));
      }
    }
  }
}

TEST_CASE("symmetry: transposed and turned light fields give transposed and turned pictures") {
  for (const auto& size : kSizes) {
    for (int views : {17, 9, 5, 1}) {
      const test::Scene scene = test::RandomScene(size[0], size[1], views, -4, 4, 32);
      for (const Symmetry& s : kTurns) {
        Check(s, scene, test::Params(0));
        Check(s, scene, test::Params(2.6, 0.9));
      }
    }
  }
}

TEST_CASE("symmetry: also in benchmark mode and on noisy disparity") {
  test::Scene scene = test::RandomScene(64, 32, 17, -2, 3, 33);
  test::Random random(34);
  test::NoisyDisparity(&scene, &random);
  for (const Symmetry& s : kMirrors) Check(s, scene, test::Params(0.4, 1, SF_MODE_BENCHMARK));
  for (const Symmetry& s : kTurns) Check(s, scene, test::Params(0.4, 1, SF_MODE_BENCHMARK));
}

// Cells up to several pixels wide, over flat, slanted and noisy surfaces.
TEST_CASE("symmetry: mirrors with wide aperture cells") {
  for (const int views : {17, 5, 1}) {
    test::Scene scene = test::RandomScene(64, 32, views, -3, 8, 35);
    test::Random random(36);
    for (const bool noisy : {false, true}) {
      if (noisy) test::NoisyDisparity(&scene, &random);
      for (const sf_mode mode : {SF_MODE_BLOCK, SF_MODE_FRAME}) {
        sf_params params = test::Params(-12.6, 1, mode);
        params.rule = SF_RULE_CELLS;
        for (const Symmetry& s : kMirrors) Check(s, scene, params);
      }
    }
  }
}

// All views of wide cells are rendered along rows first. Over one surface the order only rounds
// differently; which surface shows beside a depth edge depends on it.
TEST_CASE("symmetry: turns with wide aperture cells, up to the order of rows and columns") {
  for (const int views : {17, 5, 1}) {
    for (const sf_mode mode : {SF_MODE_BLOCK, SF_MODE_FRAME}) {
      for (const double focus : {-12.6, 1.3}) {
        sf_params params = test::Params(focus, 1, mode);
        params.rule = SF_RULE_CELLS;
        for (const Symmetry& s : kTurns) {
          CAPTURE(s.name);
          CAPTURE(views);
          CAPTURE(mode);
          CAPTURE(focus);
          test::Scene flat = test::RandomScene(64, 32, views, 3, 3, 37);
          const Distance one = Measure(s, flat, params);
          CHECK(one.largest <= 1);
          CHECK(one.mean < 0.06);
          const Distance many = Measure(s, test::RandomScene(64, 32, views, -3, 8, 35), params);
          CHECK(many.mean < 2);
        }
      }
    }
  }
}

}  // namespace
