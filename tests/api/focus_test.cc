// SPDX-License-Identifier: Apache-2.0
// Tests the functions that return the focus at a pixel, the largest aperture of an engine and the
// aperture of an f-stop.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/image_scene.h"
#include "tests/support/test_scene.h"

namespace photographer_test {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

struct Map {
  Map(int w, int h, float value, int padding = 0)
      : width(w), height(h), row(size_t(w + padding)), values(row * size_t(h), value) {}
  float& At(int x, int y) { return values[size_t(y) * row + size_t(x)]; }
  starfocus_depth_map Depth() const {
    return starfocus_depth_float(values.data(), 4 * row, width, height);
  }
  double Focus(int x, int y) const {
    double focus = -77;
    const starfocus_depth_map depth = Depth();
    REQUIRE(starfocus_focus_at(&depth, width, height, x, y, &focus, nullptr) == STARFOCUS_OK);
    return focus;
  }

  int width, height;
  size_t row;
  std::vector<float> values;
};

TEST_CASE("focus at: illegal arguments are rejected") {
  Map map(5, 4, 1, 2);
  double focus = -77;
  const auto at = [&](const float* d, size_t stride, int w, int h, int x, int y) {
    const starfocus_depth_map depth = starfocus_depth_float(d, stride, w, h);
    return starfocus_focus_at(&depth, 5, 4, x, y, &focus, nullptr);
  };
  const float* const d = map.values.data();
  CHECK(at(nullptr, 28, 5, 4, 0, 0) == STARFOCUS_ERROR_NULL);
  const starfocus_depth_map depth = map.Depth();
  CHECK(starfocus_focus_at(&depth, 5, 4, 0, 0, nullptr, nullptr) == STARFOCUS_ERROR_NULL);
  CHECK(starfocus_focus_at(nullptr, 5, 4, 0, 0, &focus, nullptr) == STARFOCUS_ERROR_NULL);
  // The map must not be larger than the picture.
  CHECK(starfocus_focus_at(&depth, 4, 4, 0, 0, &focus, nullptr) == STARFOCUS_ERROR_RANGE);
  CHECK(starfocus_focus_at(&depth, 5, 3, 0, 0, &focus, nullptr) == STARFOCUS_ERROR_RANGE);
  CHECK(starfocus_focus_at(&depth, STARFOCUS_MAX_SIZE + 1, 4, 0, 0, &focus, nullptr) ==
        STARFOCUS_ERROR_RANGE);
  CHECK(at(d, 28, 0, 4, 0, 0) == STARFOCUS_ERROR_RANGE);
  CHECK(at(d, 28, 5, STARFOCUS_MAX_SIZE + 1, 0, 0) == STARFOCUS_ERROR_RANGE);
  for (const size_t stride : {size_t{0}, size_t{16}, size_t{22}}) {
    CHECK(at(d, stride, 5, 4, 0, 0) == STARFOCUS_ERROR_STRIDE);
  }
  for (const int outside : {-1, 5, INT32_MIN, INT32_MAX}) {
    CHECK(at(d, 28, 5, 4, outside, 0) == STARFOCUS_ERROR_RANGE);
    CHECK(at(d, 28, 5, 4, 0, outside) == STARFOCUS_ERROR_RANGE);
  }
  CHECK(at(d, 28, 5, 4, 0, 4) == STARFOCUS_ERROR_RANGE);
  CHECK(focus == -77);
}

TEST_CASE("focus at: unknown values are ignored, unless all values near the pixel are unknown") {
  for (const float bad : {kNan, float(kInf), float(-kInf)}) {
    Map map(30, 20, 2, 3);
    for (int y = 0; y < 20; ++y) std::fill_n(&map.At(0, y) + 30, 3, bad);  // padding
    map.At(12, 9) = bad;
    for (int y = 0; y < 20; ++y) {
      for (int x = 0; x < 30; ++x) CHECK(map.Focus(x, y) == 2);
    }
    for (int y = 6; y <= 12; ++y) std::fill_n(&map.At(9, y), 7, bad);
    const starfocus_depth_map depth = map.Depth();
    double focus = -77;
    CHECK(starfocus_focus_at(&depth, 30, 20, 12, 9, &focus, nullptr) == STARFOCUS_ERROR_NOT_FINITE);
    CHECK(focus == -77);
    map.At(9, 12) = 5;
    CHECK(map.Focus(12, 9) == 5);
  }
}

TEST_CASE("focus at: distances of 16 bits with unknown values are read") {
  // Map of 4 x 2 distances for a picture of 18 x 5 pixels.
  const uint16_t distances[2][4] = {{100, 200, 400, 0}, {50, 0, 25, 10}};
  starfocus_depth_map depth = {};
  depth.data = distances;
  depth.stride = sizeof distances[0];
  depth.width = 4;
  depth.height = 2;
  depth.type = STARFOCUS_DEPTH_U16;
  depth.meaning = STARFOCUS_DEPTH_RECIPROCAL;
  depth.scale = 800;
  depth.has_invalid = 1;
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 18; ++x) {
      // All surfaces consist of one value, so the focus is the smallest disparity, 800 / 400.
      double focus = -77;
      REQUIRE(starfocus_focus_at(&depth, 18, 5, x, y, &focus, nullptr) == STARFOCUS_OK);
      CHECK(focus == 2);
    }
  }
}

TEST_CASE("focus at: the focus of a small map is the focus of the value at the pixel") {
  Map small(20, 15, 0);
  for (int y = 0; y < 15; ++y) {
    for (int x = 0; x < 20; ++x) small.At(x, y) = x < 10 ? float(y) / 4 : 9 - float(x) / 8;
  }
  const starfocus_depth_map depth = small.Depth();
  for (int y = 0; y < 61; ++y) {
    for (int x = 0; x < 79; ++x) {
      double focus = -77;
      REQUIRE(starfocus_focus_at(&depth, 79, 61, x, y, &focus, nullptr) == STARFOCUS_OK);
      CHECK(focus == small.Focus((2 * x + 1) * 20 / 158, (2 * y + 1) * 15 / 122));
    }
  }
}

TEST_CASE("largest aperture: the engine accepts it, and no larger aperture") {
  test::Config config;
  config.width = config.height = 16;
  config.views = 1;
  config.disparity_min = -3;
  config.disparity_max = 10;
  config.max_blur = 7;
  starfocus_engine* engine = nullptr;
  REQUIRE(starfocus_create(&config, nullptr, &engine, nullptr) == STARFOCUS_OK);
  const std::vector<uint8_t> view(16 * 48, 100);
  std::vector<uint8_t> out(view.size());
  const std::vector<float> map(16 * 16, 1);
  starfocus_light_field field = starfocus::NewLightField();
  field.views[0] = starfocus_image_rgb(view.data(), 48);
  field.depth = starfocus_depth_float(map.data(), 64, 16, 16);
  const starfocus_image picture = starfocus_image_rgb(out.data(), 48);
  starfocus::Params params;
  for (double focus = -20; focus <= 20; focus += 0.37) {
    params.focus = focus;
    REQUIRE(starfocus_largest_aperture(engine, &params, &params.aperture) == STARFOCUS_OK);
    const double farthest = std::max(10 - focus, focus + 3);
    CHECK(params.aperture == doctest::Approx(std::min(1.0, 7 / farthest)).epsilon(1e-14));
    CHECK(starfocus_refocus(engine, &params, &field, &picture, nullptr) == STARFOCUS_OK);
    if (params.aperture == 1) continue;
    params.aperture *= 1 + 1e-14;
    CHECK(starfocus_refocus(engine, &params, &field, &picture, nullptr) == STARFOCUS_ERROR_BLUR);
  }
  double aperture = -77;
  params.focus = 2 * STARFOCUS_MAX_FOCUS;
  CHECK(starfocus_largest_aperture(engine, &params, &aperture) == STARFOCUS_ERROR_RANGE);
  CHECK(std::strcmp(starfocus_engine_problem(engine)->field, "focus") == 0);
  CHECK(starfocus_largest_aperture(engine, nullptr, &aperture) == STARFOCUS_ERROR_NULL);
  CHECK(starfocus_largest_aperture(engine, &params, nullptr) == STARFOCUS_ERROR_NULL);
  CHECK(starfocus_largest_aperture(nullptr, &params, &aperture) == STARFOCUS_ERROR_NULL);
  CHECK(aperture == -77);
  starfocus_destroy(engine);
}

TEST_CASE("photographer: the largest aperture is right for every max_blur, however small") {
  for (const double max_blur :
       {5e-324, 1e-310, 2.2250738585072014e-308, 1e-300, 1e-9, 0.3, 128.0}) {
    for (const double focus : {-STARFOCUS_MAX_FOCUS, -1.0, 0.0, 0.7, 3.0, STARFOCUS_MAX_FOCUS}) {
      CAPTURE(max_blur);
      CAPTURE(focus);
      test::Config config;
      config.width = config.height = 8;
      config.views = 1;
      config.disparity_min = -1.5;
      config.disparity_max = 1.5;
      config.max_blur = max_blur;
      starfocus_engine* engine = nullptr;
      REQUIRE(starfocus_create(&config, nullptr, &engine, nullptr) == STARFOCUS_OK);
      starfocus::Params lens = test::Params(focus);
      double aperture = -77;
      REQUIRE(starfocus_largest_aperture(engine, &lens, &aperture) == STARFOCUS_OK);
      const double distance = std::max(1.5 - focus, focus + 1.5);
      CHECK(aperture * distance <= max_blur);
      CHECK((aperture == 1 || std::nextafter(aperture, 1) * distance > max_blur ||
             std::nextafter(aperture, 1) > max_blur / distance));
      starfocus_destroy(engine);
    }
  }
}

TEST_CASE(
    "focus at: the focus is the surface at the pixel, even if the surface is small or ends "
    "nearby") {
  Map map(24, 24, -4);
  for (int y = 0; y < 24; ++y) {
    for (int x = 0; x < 9; ++x) map.At(x, y) = 3;  // An object.
    map.At(16, y) = 8;                             // A wire.
  }
  for (int y = 0; y < 24; ++y) {
    for (int x = 0; x < 24; ++x) CHECK(map.Focus(x, y) == (x < 9 ? 3 : x == 16 ? 8 : -4));
  }
  Map one(1, 1, 2.5f);
  CHECK(one.Focus(0, 0) == 2.5);
}

TEST_CASE(
    "focus at: at a single wrong disparity, the focus is the surface of most pixels around it") {
  Map map(20, 20, 1);
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 6; ++x) map.At(x, y) = 5;
  }
  for (const float wrong : {-400.0f, 9.0f, 3.0f}) {
    for (const int x : {2, 4, 7, 12}) {
      Map spoilt = map;
      spoilt.At(x, 10) = wrong;
      // For x <= 4, most pixels within 3 pixels of the wrong pixel belong to the object. For x >=
      // 7, most pixels within 3 pixels of the wrong pixel are behind the object.
      CHECK(spoilt.Focus(x, 10) == (x < 6 ? 5 : 1));
      CHECK(spoilt.Focus(x, 9) == (x < 6 ? 5 : 1));  // next to it
    }
  }
  // If two surfaces around the wrong pixel are equally large, the farther surface is in focus.
  Map two(2, 3, 0);
  two.values = {4, 4, 50, 100, 1, 1};
  CHECK(two.Focus(0, 1) == 1);
}

TEST_CASE("focus at: a slanted surface is in focus at the given pixel") {
  for (const float slope : {0.0625f, 0.25f, 0.5f, 1.0f}) {
    Map map(40, 30, 0);
    for (int y = 0; y < 30; ++y) {
      for (int x = 0; x < 40; ++x) map.At(x, y) = slope * float(x - y);
    }
    for (int y = 3; y < 27; ++y) {
      for (int x = 3; x < 37; ++x) CHECK(map.Focus(x, y) == slope * float(x - y));
    }
  }
}

TEST_CASE("focus at: the focus is a median, which reduces noise") {
  test::Random random(5);
  Map map(60, 60, 0);
  for (float& value : map.values) {
    double sum = 0;  // noise, approximately normally distributed with variance 1
    for (int k = 0; k < 12; ++k) sum += random.Unit();
    value = 2 + 0.3f * float(sum - 6);
  }
  for (int x = 0; x < 60; ++x) map.At(x, 59) += 8;  // another surface
  double squares = 0, worst = 0;
  for (int y = 0; y < 59; ++y) {
    for (int x = 0; x < 60; ++x) {
      const double error = map.Focus(x, y) - 2;
      squares += error * error;
      worst = std::max(worst, std::fabs(error));
    }
  }
  CHECK(std::sqrt(squares / (59 * 60)) < 0.08);  // the noise of a single pixel has an RMS of 0.3
  CHECK(worst < 0.5);
}

// Returns the focus as starfocus.h defines the focus, computed from sorted lists of the neighbours.
double Expected(Map map, int x0, int y0) {
  std::vector<double> around;
  bool alone = true;  // also if the disparity of the pixel is unknown
  const double tapped = map.At(x0, y0);
  const auto near = [&](double surface) {
    std::vector<double> part;
    for (const double d : around) {
      if (std::fabs(d - surface) <= 0.75) part.push_back(d);
    }
    return part;
  };
  for (int y = std::max(0, y0 - 3); y <= std::min(map.height - 1, y0 + 3); ++y) {
    for (int x = std::max(0, x0 - 3); x <= std::min(map.width - 1, x0 + 3); ++x) {
      if (!std::isfinite(map.At(x, y))) continue;
      around.push_back(map.At(x, y));
      const bool beside = std::max(std::abs(x - x0), std::abs(y - y0)) == 1;
      alone = alone && !(beside && std::fabs(map.At(x, y) - tapped) <= 0.75);
    }
  }
  std::sort(around.begin(), around.end());
  double surface = tapped;
  for (size_t k = 0, most = 0; alone && k < around.size(); ++k) {
    if (near(around[k]).size() > most) most = near(around[k]).size(), surface = around[k];
  }
  for (int round = 0; round < 2; ++round) {
    const std::vector<double> part = near(surface);
    surface = (part[(part.size() - 1) / 2] + part[part.size() / 2]) / 2;
  }
  return surface;
}

TEST_CASE("focus at: for random maps, the focus equals the focus computed by the definition") {
  test::Random random(6);
  for (int round = 0; round < 300; ++round) {
    Map map(random.Int(1, 12), random.Int(1, 12), 0, random.Int(0, 3));
    // The disparities are multiples of 1/8, so that ties and values at the limit occur.
    const int steps = random.Int(1, 40);
    for (float& value : map.values) value = float(random.Int(0, steps)) / 8;
    for (int at = 0; round % 2 == 0 && at < map.width * map.height; ++at) {
      const int x = at % map.width, y = at / map.width;
      if ((x + y) % 3 == 0) map.At(x, y) = kNan;
    }
    for (int y = 0; y < map.height; ++y) {
      for (int x = 0; x < map.width; ++x) {
        if (map.width * map.height > 1) CHECK(map.Focus(x, y) == Expected(map, x, y));
      }
    }
  }
}

}  // namespace
}  // namespace photographer_test

// Tests starfocus_measure_disparity and starfocus_fill_disparity: bad input is rejected, and filled
// values match a simple search.

namespace disparity_test {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

struct Map {
  Map(int w, int h, int padding = 0)
      : width(w), height(h), row(size_t(w + padding)), values(row * size_t(h), 0.f) {}
  float& At(int x, int y) { return values[size_t(y) * row + size_t(x)]; }
  starfocus_status Fill() {
    return starfocus_fill_disparity(values.data(), row * 4, width, height, nullptr);
  }

  int width, height;
  size_t row;
  std::vector<float> values;
};

// Checks the rows of a filled map that had at least one finite disparity before filling. Finite
// values must not change, and a hole must get the disparity of the farther surface next to the
// hole.
void CheckRows(Map before, Map after) {
  for (int y = 0; y < before.height; ++y) {
    for (int x = 0; x < before.width; ++x) {
      const float value = after.At(x, y);
      REQUIRE(std::isfinite(value));
      if (std::isfinite(before.At(x, y))) {
        CHECK(value == before.At(x, y));
        continue;
      }
      int l = x, r = x;
      while (l >= 0 && !std::isfinite(before.At(l, y))) --l;
      while (r < before.width && !std::isfinite(before.At(r, y))) ++r;
      if (l < 0 && r == before.width) continue;
      const float left = l >= 0 ? before.At(l, y) : before.At(r, y);
      const float right = r < before.width ? before.At(r, y) : left;
      CHECK(value == std::min(left, right));
    }
  }
}

TEST_CASE("disparity: illegal arguments are rejected") {
  Map map(5, 4);
  starfocus_disparity_stats stats;
  std::memset(&stats, test::kPoison, sizeof stats);
  const starfocus_disparity_stats poison = stats;
  const auto measure = [&](const float* d, size_t stride, int w, int h) {
    const starfocus_depth_map depth = starfocus_depth_float(d, stride, w, h);
    return starfocus_measure_disparity(&depth, &stats, nullptr);
  };
  const auto fill = [&](float* d, size_t stride, int w, int h) {
    return starfocus_fill_disparity(d, stride, w, h, nullptr);
  };
  CHECK(measure(nullptr, 20, 5, 4) == STARFOCUS_ERROR_NULL);
  const starfocus_depth_map good = starfocus_depth_float(map.values.data(), 20, 5, 4);
  CHECK(starfocus_measure_disparity(&good, nullptr, nullptr) == STARFOCUS_ERROR_NULL);
  CHECK(starfocus_measure_disparity(nullptr, &stats, nullptr) == STARFOCUS_ERROR_NULL);
  starfocus_depth_map flat = good;
  flat.scale = 0;
  CHECK(starfocus_measure_disparity(&flat, &stats, nullptr) == STARFOCUS_ERROR_RANGE);
  CHECK(fill(nullptr, 20, 5, 4) == STARFOCUS_ERROR_NULL);
  for (int size : {0, -1, STARFOCUS_MAX_SIZE + 1, INT32_MAX, INT32_MIN}) {
    CHECK(measure(map.values.data(), size_t{1} << 30, size, 4) == STARFOCUS_ERROR_RANGE);
    CHECK(measure(map.values.data(), 20, 5, size) == STARFOCUS_ERROR_RANGE);
    CHECK(fill(map.values.data(), size_t{1} << 30, size, 4) == STARFOCUS_ERROR_RANGE);
    CHECK(fill(map.values.data(), 20, 5, size) == STARFOCUS_ERROR_RANGE);
  }
  for (size_t stride :
       {size_t{0}, size_t{16}, size_t{21}, size_t{22}, std::numeric_limits<size_t>::max() - 3}) {
    CHECK(measure(map.values.data(), stride, 5, 4) == STARFOCUS_ERROR_STRIDE);
    CHECK(fill(map.values.data(), stride, 5, 4) == STARFOCUS_ERROR_STRIDE);
  }
  CHECK(std::memcmp(&stats, &poison, sizeof stats) == 0);
}

TEST_CASE("disparity: smallest, largest and non-finite values are measured") {
  Map map(5, 3, 2);
  for (float& value : map.values) value = 999;  // padding, which must be ignored
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 5; ++x) map.At(x, y) = float(x - y);
  }
  starfocus_disparity_stats stats;
  const starfocus_depth_map depth = starfocus_depth_float(map.values.data(), 28, 5, 3);
  REQUIRE(starfocus_measure_disparity(&depth, &stats, nullptr) == STARFOCUS_OK);
  CHECK(stats.min == -2);
  CHECK(stats.max == 4);
  CHECK(stats.invalid == 0);
  map.At(0, 2) = kNan;
  map.At(4, 0) = kInf;
  map.At(2, 1) = -kInf;
  REQUIRE(starfocus_measure_disparity(&depth, &stats, nullptr) == STARFOCUS_OK);
  CHECK(stats.min == -1);
  CHECK(stats.max == 3);
  CHECK(stats.invalid == 3);
  Map none(2, 2);
  none.values.assign(4, kNan);
  const starfocus_depth_map unknown = starfocus_depth_float(none.values.data(), 8, 2, 2);
  REQUIRE(starfocus_measure_disparity(&unknown, &stats, nullptr) == STARFOCUS_OK);
  CHECK(stats.min == 0);
  CHECK(stats.max == 0);
  CHECK(stats.invalid == 4);
}

TEST_CASE("disparity: distances of 16 bits are measured as disparities") {
  const uint16_t millimetres[2][300] = {{0, 500, 4000}, {1000}};
  starfocus_depth_map depth = {};
  depth.data = millimetres;
  depth.stride = sizeof millimetres[0];
  depth.width = 3;
  depth.height = 2;
  depth.type = STARFOCUS_DEPTH_U16;
  depth.meaning = STARFOCUS_DEPTH_RECIPROCAL;
  depth.scale = 8000;
  depth.offset = -1;
  starfocus_disparity_stats stats;
  REQUIRE(starfocus_measure_disparity(&depth, &stats, nullptr) == STARFOCUS_OK);
  CHECK(stats.min == 1);
  CHECK(stats.max == 15);
  CHECK(stats.invalid == 3);  // 8000 / 0 is infinite
  depth.has_invalid = 1;
  depth.invalid = 500;
  depth.width = 300;  // more values than are converted at once
  REQUIRE(starfocus_measure_disparity(&depth, &stats, nullptr) == STARFOCUS_OK);
  CHECK(stats.max == 7);
  CHECK(stats.invalid == 598);
}

// Refocuses a picture whose depth map is `map`. Returns the status.
starfocus_status RefocusWith(const starfocus_depth_map& map) {
  test::Config config;
  config.width = map.width;
  config.height = map.height;
  config.views = 1;
  config.disparity_min = -STARFOCUS_MAX_DISPARITY;
  config.disparity_max = STARFOCUS_MAX_DISPARITY;
  config.features |= STARFOCUS_FEATURE_IMAGES;
  starfocus_engine* engine = nullptr;
  REQUIRE(starfocus_create(&config, nullptr, &engine, nullptr) == STARFOCUS_OK);
  const size_t row = 3 * size_t(map.width);
  const std::vector<uint8_t> view(row * size_t(map.height), 90);
  std::vector<uint8_t> out(view.size());
  starfocus_light_field field = starfocus::NewLightField();
  field.views[0] = starfocus_image_rgb(view.data(), row);
  field.depth = map;
  const starfocus_image picture = starfocus_image_rgb(out.data(), row);
  starfocus::Params params;
  params.aperture = 0;
  const starfocus_status status = starfocus_refocus(engine, &params, &field, &picture, nullptr);
  starfocus_destroy(engine);
  return status;
}

TEST_CASE("disparity: special values mean the same in maps of every type") {
  constexpr double kSpecial[] = {0, -0.0, 1, 255, -1, 4096, 6.103515625e-05, kInf, -kInf, kNan};
  constexpr int kValues = 19;  // more than a vector, and a remainder
  for (const int type :
       {STARFOCUS_DEPTH_FLOAT, STARFOCUS_DEPTH_HALF, STARFOCUS_DEPTH_U16, STARFOCUS_DEPTH_U8}) {
    for (const int meaning : {STARFOCUS_DEPTH_LINEAR, STARFOCUS_DEPTH_RECIPROCAL}) {
      for (const double z : kSpecial) {
        for (const int has_invalid : {0, 1}) {
          test::DepthMemory memory;
          memory.map.width = kValues;
          memory.map.height = 1;
          memory.map.type = type;
          memory.map.meaning = meaning;
          memory.map.stride = sizeof(float) * kValues;
          memory.words.resize(kValues);
          memory.map.data = memory.words.data();
          memory.map.scale = 1.0 / 64;
          memory.map.offset = 3;
          memory.map.has_invalid = has_invalid;
          memory.map.invalid = z;
          for (int x = 0; x < kValues; ++x) memory.Put(x, 0, z);
          if (!(double(memory.Get(0, 0)) == z) && z == z) continue;  // The type lacks this value.
          if (std::isnan(z) && type != STARFOCUS_DEPTH_FLOAT && type != STARFOCUS_DEPTH_HALF) {
            continue;
          }
          CAPTURE(type);
          CAPTURE(meaning);
          CAPTURE(z);
          CAPTURE(has_invalid);
          const double disparity = (meaning == STARFOCUS_DEPTH_LINEAR ? z / 64 : 1.0 / 64 / z) + 3;
          const bool known = std::isfinite(disparity) && has_invalid == 0;
          starfocus_disparity_stats stats;
          REQUIRE(starfocus_measure_disparity(&memory.map, &stats, nullptr) == STARFOCUS_OK);
          CHECK(stats.invalid == (known ? 0 : kValues));
          if (known) CHECK(double(stats.max) == doctest::Approx(disparity).epsilon(1e-6));
          CHECK(RefocusWith(memory.map) == (known ? STARFOCUS_OK : STARFOCUS_ERROR_NOT_FINITE));
        }
      }
    }
  }
}

TEST_CASE("disparity: a map without finite values cannot be filled") {
  Map map(3, 2);
  map.values = {kNan, kInf, -kInf, kNan, kNan, kNan};
  CHECK(map.Fill() == STARFOCUS_ERROR_ALL_INVALID);
}

TEST_CASE("disparity: a hole between two surfaces gets the disparity of the farther surface") {
  Map map(6, 1);
  map.values = {5, kNan, kInf, kNan, kNan, 1};
  REQUIRE(map.Fill() == STARFOCUS_OK);
  CHECK(map.values == std::vector<float>{5, 1, 1, 1, 1, 1});
  map.values = {kNan, kNan, 3, kNan, 7, -kInf};
  REQUIRE(map.Fill() == STARFOCUS_OK);
  CHECK(map.values == std::vector<float>{3, 3, 3, 3, 7, 7});
}

TEST_CASE("disparity: empty rows are filled from the rows above and below") {
  Map map(2, 5);
  map.values = {kNan, kNan, 4, 1, kNan, kNan, kNan, kNan, 2, 3};
  REQUIRE(map.Fill() == STARFOCUS_OK);
  CHECK(map.values == std::vector<float>{4, 1, 4, 1, 2, 1, 2, 1, 2, 3});
}

TEST_CASE("disparity: holes in random maps get the farther disparity, and padding is untouched") {
  test::Random random(9);
  for (int round = 0; round < 200; ++round) {
    Map map(random.Int(1, 40), random.Int(1, 12), random.Int(0, 3));
    for (float& value : map.values) {
      value = random.Int(0, 2) ? float(random.Int(-50, 50)) : (random.Int(0, 1) ? kNan : -kInf);
    }
    map.At(0, 0) = 1;
    for (int y = 0; y < map.height; ++y) {
      for (size_t x = size_t(map.width); x < map.row; ++x) map.values[size_t(y) * map.row + x] = 77;
    }
    const Map before = map;
    REQUIRE(map.Fill() == STARFOCUS_OK);
    CheckRows(before, map);
    for (int y = 0; y < map.height; ++y) {
      for (size_t x = size_t(map.width); x < map.row; ++x) {
        CHECK(map.values[size_t(y) * map.row + x] == 77);
      }
    }
  }
}

}  // namespace
}  // namespace disparity_test
