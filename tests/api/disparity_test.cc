// SPDX-License-Identifier: Apache-2.0
// Tests starfocus_measure_disparity and starfocus_fill_disparity: bad input is rejected, and filled
// values match a simple search.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/image_scene.h"
#include "tests/support/test_scene.h"

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
