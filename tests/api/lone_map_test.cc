// SPDX-License-Identifier: Apache-2.0
// Tests the functions that take a depth map without an engine: starfocus_measure_disparity,
// starfocus_fill_disparity and starfocus_focus_at. Bad input is rejected, and the results match
// simple searches.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/images.h"
#include "tests/support/test_scene.h"

namespace lone_map_test {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kPadding = 77;

struct Map {
  // If there is padding, the map has `padding` more columns than known values.
  Map(int w, int h, float value, int padding = 0)
      : width(w), height(h), row(size_t(w + padding)), values(row * size_t(h), kPadding) {
    for (int y = 0; y < h; ++y) std::fill_n(&At(0, y), w, value);
  }
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
  starfocus_disparity_stats Measure() const {
    starfocus_disparity_stats stats;
    const starfocus_depth_map depth = Depth();
    REQUIRE(starfocus_measure_disparity(&depth, &stats, nullptr) == STARFOCUS_OK);
    return stats;
  }
  starfocus_status Fill() {
    return starfocus_fill_disparity(values.data(), row * 4, width, height, nullptr);
  }

  int width, height;
  size_t row;
  std::vector<float> values;
};

TEST_CASE("maps: illegal maps and pixels are rejected and named") {
  constexpr starfocus_status kNull = STARFOCUS_ERROR_NULL, kRange = STARFOCUS_ERROR_RANGE,
                             kStride = STARFOCUS_ERROR_STRIDE;
  Map map(5, 4, 1, 2);
  const Map before = map;
  float* const data = map.values.data();
  starfocus_disparity_stats stats;
  std::memset(&stats, test::kPoison, sizeof stats);
  const starfocus_disparity_stats poison = stats;
  double focus = -77;
  starfocus_problem problem;
  // `filled` is the name of the field for starfocus_fill_disparity.
  const auto check = [&](starfocus_status status, const std::string& field,
                         const std::string& filled, void* at, size_t stride, int width,
                         int height) {
    CAPTURES(field, stride, width, height);
    auto* const values = static_cast<float*>(at);
    const starfocus_depth_map depth = starfocus_depth_float(values, stride, width, height);
    CHECK(starfocus_measure_disparity(&depth, &stats, &problem) == status);
    CHECK(problem.field == field);
    CHECK(starfocus_focus_at(&depth, 5, 4, 0, 0, &focus, &problem) == status);
    CHECK(problem.field == field);
    CHECK(starfocus_fill_disparity(values, stride, width, height, &problem) == status);
    CHECK(problem.field == filled);
  };
  check(kNull, "depth.data", "disparity", nullptr, 28, 5, 4);
  check(kStride, "depth.data", "disparity", reinterpret_cast<char*>(data) + 1, 28, 5, 4);
  for (const size_t stride : {size_t{0}, size_t{16}, size_t{21}, size_t{22}, SIZE_MAX - 3}) {
    check(kStride, "depth.stride", "stride", data, stride, 5, 4);
  }
  for (const int size : {0, -1, STARFOCUS_MAX_SIZE + 1, INT32_MAX, INT32_MIN}) {
    check(kRange, "depth.width", "width", data, size_t{1} << 30, size, 4);
    check(kRange, "depth.height", "height", data, 28, 5, size);
  }
  const starfocus_depth_map depth = map.Depth();
  const auto check_pixel = [&](const std::string& field, int width, int height, int x, int y) {
    CAPTURES(field, x, y);
    CHECK(starfocus_focus_at(&depth, width, height, x, y, &focus, &problem) == kRange);
    CHECK(problem.field == field);
  };
  // The map must not be larger than the picture.
  check_pixel("depth.width", 4, 4, 0, 0);
  check_pixel("depth.height", 5, 3, 0, 0);
  check_pixel("width", STARFOCUS_MAX_SIZE + 1, 4, 0, 0);
  for (const int outside : {-1, 5, INT32_MIN, INT32_MAX}) {
    check_pixel("x", 5, 4, outside, 0);
    check_pixel("y", 5, 4, 0, outside == 5 ? 4 : outside);
  }
  starfocus_depth_map flat = depth;
  flat.scale = 0;
  CHECK(starfocus_measure_disparity(&flat, &stats, nullptr) == kRange);
  CHECK(starfocus_measure_disparity(nullptr, &stats, nullptr) == kNull);
  CHECK(starfocus_measure_disparity(&depth, nullptr, nullptr) == kNull);
  CHECK(starfocus_focus_at(nullptr, 5, 4, 0, 0, &focus, nullptr) == kNull);
  CHECK(starfocus_focus_at(&depth, 5, 4, 0, 0, nullptr, nullptr) == kNull);
  CHECK(std::memcmp(&stats, &poison, sizeof stats) == 0);
  CHECK(focus == -77);
  CHECK(map.values == before.values);
}

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

TEST_CASE("fill: a map without finite values cannot be filled, and empty rows are copied") {
  Map map(3, 2, kNan);
  map.values = {kNan, kInf, -kInf, kNan, kNan, kNan};
  CHECK(map.Fill() == STARFOCUS_ERROR_ALL_INVALID);
  const starfocus_disparity_stats stats = map.Measure();
  CHECK(stats.min == 0);
  CHECK(stats.max == 0);
  CHECK(stats.invalid == 6);
  Map rows(2, 5, kNan);
  rows.values = {kNan, kNan, 4, 1, kNan, kNan, kNan, kNan, 2, 3};
  REQUIRE(rows.Fill() == STARFOCUS_OK);
  CHECK(rows.values == std::vector<float>{4, 1, 4, 1, 2, 1, 2, 1, 2, 3});
}

TEST_CASE("measure, fill: the range and the holes of random maps match a search, without padding") {
  test::Random random(9);
  for (int round = 0; round < 200; ++round) {
    // Maps are measured in pieces of 256 values.
    const int most = round % 20 == 0 ? 600 : 40;
    Map map(random.Int(1, most), random.Int(1, 12), 1, random.Int(0, 3));
    int invalid = 0;
    float low = 1, high = 1;
    for (int y = 0; y < map.height; ++y) {
      for (int x = y == 0 ? 1 : 0; x < map.width; ++x) {
        const int kind = random.Int(0, 9);
        const float value = float(random.Int(-50, 50));
        map.At(x, y) = kind < 7 ? value : kind == 7 ? kNan : kind == 8 ? kInf : -kInf;
        invalid += kind >= 7;
        if (kind < 7) low = std::min(low, value), high = std::max(high, value);
      }
    }
    const starfocus_disparity_stats stats = map.Measure();
    CHECK(stats.min == low);
    CHECK(stats.max == high);
    CHECK(stats.invalid == invalid);
    const Map before = map;
    REQUIRE(map.Fill() == STARFOCUS_OK);
    CheckRows(before, map);
    for (int y = 0; y < map.height; ++y) {
      for (size_t x = size_t(map.width); x < map.row; ++x)
        CHECK(map.values[size_t(y) * map.row + x] == kPadding);
    }
  }
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
  const test::Engine engine(config);
  const size_t row = 3 * size_t(map.width);
  const std::vector<uint8_t> view(row * size_t(map.height), 90);
  std::vector<uint8_t> out(view.size());
  starfocus_light_field field = starfocus::NewLightField();
  field.views[0] = starfocus_image_rgb(view.data(), row);
  field.depth = map;
  const starfocus_image picture = starfocus_image_rgb(out.data(), row);
  starfocus::Params params;
  params.aperture = 0;
  return starfocus_refocus(engine.get(), &params, &field, &picture, nullptr);
}

TEST_CASE("maps: special values mean the same in maps of every type") {
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
          double focus = -77;
          const starfocus_status tapped =
              starfocus_focus_at(&memory.map, kValues, 1, 9, 0, &focus, nullptr);
          CHECK(tapped == (known ? STARFOCUS_OK : STARFOCUS_ERROR_NOT_FINITE));
          CHECK(focus == (known ? doctest::Approx(disparity).epsilon(1e-6) : doctest::Approx(-77)));
          CHECK(RefocusWith(memory.map) == (known ? STARFOCUS_OK : STARFOCUS_ERROR_NOT_FINITE));
        }
      }
    }
  }
}

TEST_CASE("focus at: if all values near the pixel are unknown, the focus is not written") {
  for (const float bad : {kNan, kInf, -kInf}) {
    Map map(30, 20, 2, 3);
    for (int y = 6; y <= 12; ++y) std::fill_n(&map.At(9, y), 7, bad);
    const starfocus_depth_map depth = map.Depth();
    double focus = -77;
    CHECK(starfocus_focus_at(&depth, 30, 20, 12, 9, &focus, nullptr) == STARFOCUS_ERROR_NOT_FINITE);
    CHECK(focus == -77);
    map.At(9, 12) = 5;
    CHECK(map.Focus(12, 9) == 5);
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

// Returns a map of one kind: noise, an object with a wire beside it, a slanted surface, or an
// object with single wrong disparities. Disparities are multiples of 1/8, so that ties and values
// at the limit occur.
Map AnyMap(test::Random* random) {
  const int kind = random->Int(0, 3), most = kind == 0 ? 12 : 16;
  Map map(random->Int(1, most), random->Int(1, most), 0, random->Int(0, 3));
  const int steps = random->Int(1, 40), edge = map.width / 3;
  const float step = float(random->Int(1, 12)) / 8;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const float object = x < edge ? 3 : -4;
      const bool wrong = kind == 3 && random->Int(0, 19) == 0;
      map.At(x, y) = kind == 0   ? float(random->Int(0, steps)) / 8
                     : kind == 1 ? (x == 2 * edge ? 8 : object)
                     : kind == 2 ? step * float(x - y)
                     : wrong     ? float(random->Int(-400, 400))
                                 : object;
    }
  }
  return map;
}

TEST_CASE("focus at: for random maps, the focus equals the focus computed by the definition") {
  test::Random random(6);
  constexpr float kUnknown[] = {kNan, kInf, -kInf};
  for (int round = 0; round < 250; ++round) {
    Map map = AnyMap(&random);
    for (int at = 0; round % 2 == 0 && at < map.width * map.height; ++at) {
      const int x = at % map.width, y = at / map.width;
      if ((x + y) % 3 == 0) map.At(x, y) = kUnknown[random.Int(0, 2)];
    }
    for (int y = 0; y < map.height; ++y) {
      for (int x = 0; x < map.width; ++x) {
        if (map.width * map.height > 1) CHECK(map.Focus(x, y) == Expected(map, x, y));
      }
    }
  }
  // If two surfaces around a wrong pixel are equally large, the farther surface is in focus.
  Map two(2, 3, 0);
  two.values = {4, 4, 50, 100, 1, 1};
  CHECK(two.Focus(0, 1) == 1);
  CHECK(Map(1, 1, 2.5f).Focus(0, 0) == 2.5);
}

}  // namespace
}  // namespace lone_map_test
