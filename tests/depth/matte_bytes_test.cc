// SPDX-License-Identifier: Apache-2.0
// Tests the maps and the coverage that starfocus/matte.h computes from mattes.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "lib/coverage/matte_coverage.h"
#include "starfocus/matte.h"
#include "tests/support/simd_targets.h"
#include "tests/support/test_scene.h"

namespace matte_bytes_test {
namespace {

constexpr uint8_t kUnset = 77;

struct Matte {
  Matte(int w, int h, int pixel_stride = 1, int padding = 0)
      : width(w),
        height(h),
        step(pixel_stride),
        row(w * step + padding),
        bytes(size_t(row) * size_t(h), kUnset) {}
  uint8_t& At(int x, int y) { return bytes[size_t(y * row + x * step + step - 1)]; }
  starfocus_matte Get() const {
    return {bytes.data() + step - 1, size_t(row), step == 1 ? 0 : step, width, height};
  }

  int width, height, step, row;
  std::vector<uint8_t> bytes;
};

Matte RandomMatte(int width, int height, int pixel_stride = 1, int padding = 0) {
  Matte matte(width, height, pixel_stride, padding);
  test::Random random(uint64_t(width + 1000 * height));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) matte.At(x, y) = uint8_t(random.Int(0, 255));
  }
  return matte;
}

// Planes of a result, with padding after each row.
struct Planes {
  static constexpr int kPadding = 3;
  Planes(int w, int h)
      : width(w),
        height(h),
        row(w + kPadding),
        map(size_t(row * h), kUnset),
        coverage(size_t(row * h), kUnset) {}
  starfocus_disparity_output Out() {
    starfocus_disparity_output out = {};
    out.disparity = map.data();
    out.disparity_stride = sizeof(float) * size_t(row);
    out.coverage = coverage.data();
    out.coverage_stride = size_t(row);
    return out;
  }
  float Map(int x, int y) const { return map[size_t(y * row + x)]; }
  int Coverage(int x, int y) const { return coverage[size_t(y * row + x)]; }
  bool PaddingIsUnset() const {
    for (int y = 0; y < height; ++y) {
      for (int x = width; x < row; ++x) {
        if (Map(x, y) != kUnset || Coverage(x, y) != kUnset) return false;
      }
    }
    return true;
  }

  int width, height, row;
  std::vector<float> map;
  std::vector<uint8_t> coverage;
};

constexpr starfocus_matte_depth kFlat = {9.5, -2, 0, 0};

Planes Field(const starfocus_matte& matte, const starfocus_matte_depth& depth, int width,
             int height) {
  Planes planes(width, height);
  starfocus_disparity_output out = planes.Out();
  REQUIRE(starfocus_matte_field(&matte, &depth, width, height, nullptr, &out) == STARFOCUS_OK);
  CHECK(out.has_coverage == 1);
  CHECK(planes.PaddingIsUnset());
  return planes;
}

// Weights of a cubic spline at the distance `x`: 0 is a Catmull-Rom spline, and 1 is a B-spline.
double Spline(double x, double smooth) {
  x = std::fabs(x);
  const double sharp = x < 1 ? 1 + x * x * (1.5 * x - 2.5) : 2 + x * (-4 + x * (2.5 - 0.5 * x));
  const double round = x < 1 ? 2.0 / 3 - x * x * (1 - x / 2) : (2 - x) * (2 - x) * (2 - x) / 6;
  return x >= 2 ? 0 : sharp + smooth * (round - sharp);
}

// Resamples a line of `samples` values in double precision. `value(k)` returns value k.
template <class Value>
double Resampled(int pixel, int pixels, int samples, const Value& value) {
  const double scale = double(samples) / pixels, begin = pixel * scale, end = begin + scale;
  double sum = 0;
  if (samples > pixels) {
    for (int k = int(begin); k < std::min(double(samples), end); ++k) {
      sum += value(k) * std::max(0.0, std::min(end, k + 1.0) - std::max(begin, double(k)));
    }
    return sum / scale;
  }
  const double smooth = std::clamp((1 / scale - 2) / 6, 0.0, 1.0), at = (begin + end) / 2 - 0.5;
  for (int k = int(std::floor(at)) - 1; k <= int(std::floor(at)) + 2; ++k) {
    sum += value(std::clamp(k, 0, samples - 1)) * Spline(at - k, smooth);
  }
  return sum;
}

TEST_CASE("matte: the box, the mean and the proposed floor are measured") {
  Matte matte(40, 20, 4, 5);
  std::fill(matte.bytes.begin(), matte.bytes.end(), uint8_t{255});  // colours and padding
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 40; ++x) {
      const bool inside = x >= 10 && x < 30 && y >= 4 && y < 18;
      matte.At(x, y) = uint8_t(inside ? 128 : x == 9 ? 127 : 0);
    }
  }
  const starfocus_matte given = matte.Get();
  starfocus_matte_stats stats;
  REQUIRE(starfocus_measure_matte(&given, &stats) == STARFOCUS_OK);
  CHECK(stats.covered == doctest::Approx((20 * 14 * 128 + 20 * 127) / (255.0 * 800)));
  CHECK(stats.left == 0.25);
  CHECK(stats.right == 0.75);
  CHECK(stats.top == 0.2);
  CHECK(stats.bottom == 0.9);
  CHECK(stats.ground == 0.9);
  CHECK(stats.horizon == 0.5);
  for (int y = 8; y < 20; ++y) {
    for (int x = 0; x < 40; ++x) matte.At(x, y) = 0;
  }
  REQUIRE(starfocus_measure_matte(&given, &stats) == STARFOCUS_OK);
  CHECK(stats.horizon == doctest::Approx(0.3));
}

TEST_CASE("matte: without a subject, the box and the floor are 0") {
  Matte matte(7, 5);
  std::fill(matte.bytes.begin(), matte.bytes.end(), uint8_t{127});
  const starfocus_matte given = matte.Get();
  starfocus_matte_stats stats;
  REQUIRE(starfocus_measure_matte(&given, &stats) == STARFOCUS_OK);
  CHECK(stats.covered == doctest::Approx(127 / 255.0));
  for (const double zero :
       {stats.left, stats.top, stats.right, stats.bottom, stats.horizon, stats.ground}) {
    CHECK(zero == 0);
  }
}

TEST_CASE("matte: the coverage is the resampled matte, and the map follows the coverage") {
  struct Sizes {
    int width, height, wide, high;  // of the matte and the picture
  };
  for (const Sizes& sizes : {Sizes{9, 7, 9, 7},
                             {9, 7, 17, 14},
                             {9, 7, 40, 29},
                             {9, 7, 108, 64},
                             {300, 211, 77, 40},
                             {50, 9, 23, 31},
                             {5, 90, 600, 89},
                             {1, 1, 3, 2},
                             {23, 1, 1, 9}}) {
    CAPTURE(sizes.width);
    CAPTURE(sizes.wide);
    Matte matte = RandomMatte(sizes.width, sizes.height);
    const Planes made = Field(matte.Get(), kFlat, sizes.wide, sizes.high);
    int wrong = 0;
    for (int y = 0; y < sizes.high; ++y) {
      for (int x = 0; x < sizes.wide; ++x) {
        const double alpha = Resampled(y, sizes.high, sizes.height, [&](int row) {
          return Resampled(x, sizes.wide, sizes.width, [&](int k) { return matte.At(k, row); });
        });
        const int coverage = made.Coverage(x, y);
        wrong += std::fabs(std::clamp(alpha, 0.0, 255.0) - coverage) > 0.6 ? 1 : 0;
        wrong += made.Map(x, y) != (coverage >= 128 ? 9.5F : -2.0F) ? 1 : 0;
      }
    }
    CHECK(wrong == 0);
  }
}

TEST_CASE("matte: a matte of the picture's size is the coverage, byte for byte") {
  Matte matte = RandomMatte(300, 50, 4, 9);
  const Planes made = Field(matte.Get(), kFlat, 300, 50);
  int wrong = 0;
  for (int y = 0; y < 50; ++y) {
    for (int x = 0; x < 300; ++x) wrong += made.Coverage(x, y) != matte.At(x, y) ? 1 : 0;
  }
  CHECK(wrong == 0);
}

TEST_CASE("matte: a constant matte stays constant at every size") {
  for (const int value : {0, 1, 100, 255}) {
    for (const int samples : {1, 3, 200, STARFOCUS_MAX_SIZE}) {
      for (const int pixels : {1, 7, 199, STARFOCUS_MAX_SIZE}) {
        Matte matte(samples, 1);
        std::fill(matte.bytes.begin(), matte.bytes.end(), uint8_t(value));
        const Planes made = Field(matte.Get(), kFlat, pixels, 1);
        const auto end = made.coverage.begin() + pixels;
        CHECK(std::all_of(made.coverage.begin(), end, [&](int c) { return c == value; }));
      }
    }
  }
}

TEST_CASE("matte: the floor rises from the horizon to the ground") {
  constexpr int kHeight = 120;
  Matte matte(4, 4);
  std::fill(matte.bytes.begin(), matte.bytes.end(), uint8_t{0});
  const starfocus_matte_depth depth = {20, -3.5, 0.4, 0.85};
  const Planes made = Field(matte.Get(), depth, 2, kHeight);
  for (int y = 0; y < kHeight; ++y) {
    const double way = std::clamp(((y + 0.5) / kHeight - 0.4) / 0.45, 0.0, 1.0);
    CHECK(std::fabs(made.Map(1, y) - (-3.5 + 23.5 * way)) < 0.009);
  }
  CHECK(made.Map(0, 47) == -3.5F);
  CHECK(made.Map(0, 102) == 20);
  CHECK(made.Map(0, kHeight - 1) == 20);
}

TEST_CASE("matte: the coverage is optional, and disparities are rounded to 1/64") {
  Matte matte(1, 1);
  matte.At(0, 0) = 128;
  const starfocus_matte given = matte.Get();
  const starfocus_matte_depth depth = {1 + 1 / 128.0, -500, 0, 0};
  float map = 0;
  starfocus_disparity_output out = {};
  out.disparity = &map;
  out.disparity_stride = sizeof map;
  REQUIRE(starfocus_matte_field(&given, &depth, 1, 1, nullptr, &out) == STARFOCUS_OK);
  CHECK(map == 1 + 1 / 64.0F);
  CHECK(out.has_coverage == 0);
}

// A portrait: a subject with the disparity 20 left of x = 60, and two surfaces behind the subject,
// which meet in an edge at y = 150. The map's outline of the subject is `error` pixels too wide.
struct Portrait {
  static constexpr int kWidth = 170, kHeight = 200, kOutline = 60, kHorizon = 150;

  explicit Portrait(int error, int haze = 0)
      : map(size_t(kWidth * kHeight)), matte(kWidth, kHeight) {
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const float behind = y < kHorizon ? 0.0F : 8.0F;
        map[size_t(y * kWidth + x)] = x < kOutline + error ? 20.0F : behind;
        const int alpha = 255 - 32 * std::clamp(x - kOutline + 4, 0, 8) - (x >= kOutline + 4);
        matte.At(x, y) = uint8_t(std::clamp(alpha, haze, 255));
      }
    }
  }
  starfocus_depth_map Depth() const {
    return starfocus_depth_float(map.data(), sizeof(float) * kWidth, kWidth, kHeight);
  }
  Planes Coverage() const {
    const starfocus_matte given = matte.Get();
    const starfocus_depth_map depth = Depth();
    Planes planes(kWidth, kHeight);
    starfocus_disparity_output out = planes.Out();
    REQUIRE(starfocus_matte_coverage(&given, &depth, kWidth, kHeight, nullptr, &out) ==
            STARFOCUS_OK);
    CHECK(out.has_coverage == 1);
    CHECK(planes.PaddingIsUnset());
    CHECK(planes.Map(0, 0) == kUnset);
    return planes;
  }

  std::vector<float> map;
  Matte matte;
};

TEST_CASE("matte and map: at outlines of the subject, the coverage is the matte") {
  for (const int error : {-10, 0, 10}) {
    CAPTURE(error);
    Portrait portrait(error);
    const Planes made = portrait.Coverage();
    for (int x = Portrait::kOutline - 20; x < Portrait::kOutline + 20; ++x) {
      CHECK(made.Coverage(x, 60) == portrait.matte.At(x, 60));
    }
  }
}

TEST_CASE("matte and map: at other edges, the coverage is what the map implies") {
  const Planes made = Portrait(0).Coverage();
  for (int y = Portrait::kHorizon - 32; y < Portrait::kHorizon + 32; ++y) {
    CHECK(made.Coverage(140, y) == (y < Portrait::kHorizon ? 0 : 255));
  }
  CHECK(made.Coverage(140, 60) == 255);
}

TEST_CASE("matte and map: haze beside the subject and a doubtful interior do not count") {
  Portrait portrait(0, 70);
  for (int y = 0; y < Portrait::kHeight; ++y) {
    for (int x = 0; x < 50; ++x) portrait.matte.At(x, y) = 235;
  }
  const Planes made = portrait.Coverage();
  for (int x = 0; x < 50; ++x) CHECK(made.Coverage(x, 60) == 255);
  for (int x = 66; x < 90; ++x) CHECK(made.Coverage(x, 60) == 0);
  const int middle = made.Coverage(Portrait::kOutline, 60);
  CHECK(middle > 80);
  CHECK(middle < 130);
}

TEST_CASE("matte and map: where the two contradict each other, the map decides") {
  // Without a subject, a subject in the whole picture, and a subject behind the near surface.
  for (const bool reversed : {false, true}) {
    for (const int value : {0, 200, 255}) {
      CAPTURE(value);
      Portrait portrait(0);
      for (uint8_t& alpha : portrait.matte.bytes) {
        alpha = uint8_t(reversed ? (255 - alpha) * value / 255 : value);
      }
      const Planes made = portrait.Coverage();
      for (int x = 30; x < 90; ++x) CHECK(made.Coverage(x, 60) == (x < 60 ? 255 : 0));
    }
  }
}

TEST_CASE("matte and map: the coverage does not depend on the SIMD target") {
  const Portrait portrait(7, 20);
  const Planes expected = portrait.Coverage();
  const starfocus::DepthSource source = {portrait.Depth(),
                                         starfocus::RuleOf(portrait.Depth(), -500, 500),
                                         Portrait::kWidth, Portrait::kHeight, nullptr};
  for (const auto* kernels : test::ImageTargets()) {
    CAPTURE(kernels->name);
    Planes made(Portrait::kWidth, Portrait::kHeight);
    starfocus::MatteCoverage(*kernels, portrait.matte.Get(), source,
                             {0, 0, Portrait::kWidth, Portrait::kHeight},
                             {made.coverage.data(), size_t(made.row), 0, 0});
    CHECK((made.coverage == expected.coverage));
  }
}

TEST_CASE("matte and map: a map of codes at a smaller size gives the coverage of its disparities") {
  constexpr int kWide = 85, kHigh = 50;
  std::vector<uint8_t> codes(size_t(kWide * kHigh));
  std::vector<float> values;
  for (int y = 0; y < kHigh; ++y) {
    for (int x = 0; x < kWide; ++x) codes[size_t(y * kWide + x)] = uint8_t(x < 33 ? 40 : 2);
  }
  for (const uint8_t code : codes) values.push_back(code * 0.5F - 1);
  Portrait portrait(0);
  starfocus_depth_map small = {codes.data(),           kWide, kWide, kHigh, STARFOCUS_DEPTH_U8,
                               STARFOCUS_DEPTH_LINEAR, 0.5,   -1,    0,     0};
  const starfocus_depth_map floats =
      starfocus_depth_float(values.data(), sizeof(float) * kWide, kWide, kHigh);
  const starfocus_matte matte = portrait.matte.Get();
  Planes one(Portrait::kWidth, Portrait::kHeight), other(Portrait::kWidth, Portrait::kHeight);
  starfocus_disparity_output first = one.Out(), second = other.Out();
  REQUIRE(starfocus_matte_coverage(&matte, &small, Portrait::kWidth, Portrait::kHeight, nullptr,
                                   &first) == STARFOCUS_OK);
  REQUIRE(starfocus_matte_coverage(&matte, &floats, Portrait::kWidth, Portrait::kHeight, nullptr,
                                   &second) == STARFOCUS_OK);
  CHECK((one.coverage == other.coverage));
  for (int x = 30; x < 90; ++x) CHECK(one.Coverage(x, 60) == portrait.matte.At(x, 60));
}

TEST_CASE("matte: illegal arguments are rejected, and nothing is written") {
  const Portrait portrait(0);
  constexpr int kWidth = Portrait::kWidth, kHeight = Portrait::kHeight;
  struct Call {
    starfocus_matte matte;
    starfocus_matte_depth depth;
    starfocus_depth_map map;
    int width, height;
    starfocus_region region;
    starfocus_disparity_output out;
  };
  Planes planes(kWidth, kHeight);
  enum Use { kField = 1, kCoverage = 2, kBoth = 3 };
  const auto expect = [&](starfocus_status status, int use, const auto& change) {
    CAPTURE(status);
    Call call = {portrait.matte.Get(), kFlat, portrait.Depth(), kWidth, kHeight, {}, planes.Out()};
    change(&call);
    if (use != kCoverage) {
      CHECK(starfocus_matte_field(&call.matte, &call.depth, call.width, call.height, &call.region,
                                  &call.out) == status);
    }
    if (use != kField) {
      CHECK(starfocus_matte_coverage(&call.matte, &call.map, call.width, call.height, &call.region,
                                     &call.out) == status);
    }
    CHECK(call.out.has_coverage == 0);
  };
  using S = starfocus_status;
  const S range = STARFOCUS_ERROR_RANGE, stride = STARFOCUS_ERROR_STRIDE;
  expect(STARFOCUS_ERROR_NULL, kBoth, [](Call* c) { c->matte.data = nullptr; });
  for (const int size : {0, -1, STARFOCUS_MAX_SIZE + 1}) {
    expect(range, kBoth, [=](Call* c) { c->matte.width = size; });
    expect(range, kBoth, [=](Call* c) { c->matte.height = size; });
    expect(range, kBoth, [=](Call* c) { c->width = size; });
    expect(range, kBoth, [=](Call* c) { c->height = size; });
  }
  for (const int step : {-1, STARFOCUS_MAX_PIXEL_STRIDE + 1}) {
    expect(range, kBoth, [=](Call* c) { c->matte.pixel_stride = step; });
  }
  expect(stride, kBoth, [](Call* c) { c->matte.stride = kWidth - 1; });
  expect(stride, kBoth, [](Call* c) { c->matte.pixel_stride = 2; });
  expect(stride, kBoth, [](Call* c) { c->out.coverage_stride = kWidth - 1; });
  expect(stride, kField, [](Call* c) { c->out.disparity_stride = 4 * kWidth - 4; });
  expect(stride, kField, [](Call* c) { c->out.disparity_stride = 4 * kWidth + 1; });
  expect(STARFOCUS_ERROR_NULL, kField, [](Call* c) { c->out.disparity = nullptr; });
  expect(STARFOCUS_ERROR_NULL, kCoverage, [](Call* c) { c->out.coverage = nullptr; });
  expect(range, kBoth, [](Call* c) { c->region = {0, 0, kWidth + 1, 1}; });
  expect(range, kBoth, [](Call* c) { c->region = {-1, 0, 5, 1}; });
  for (const double wrong : {501.0, -501.0, double(NAN)}) {
    expect(range, kField, [=](Call* c) { c->depth.subject = wrong; });
    expect(range, kField, [=](Call* c) { c->depth.background = wrong; });
  }
  expect(range, kField, [](Call* c) { c->depth = {1, 1.01, 0, 0}; });
  const starfocus_matte_depth floors[] = {{9, 0, 0.5, 0.5}, {9, 0, 0.5, 0}, {9, 0, -0.1, 1},
                                          {9, 0, 0, 1.1},   {9, 0, NAN, 1}, {9, 0, 0, NAN},
                                          {9, 0, 1, 1}};
  for (const starfocus_matte_depth& depth : floors) {
    expect(range, kField, [&](Call* c) { c->depth = depth; });
  }
  expect(range, kCoverage, [](Call* c) { c->map.width = kWidth + 1; });
  expect(range, kCoverage, [](Call* c) { c->map.scale = 0; });
  expect(STARFOCUS_ERROR_DISPARITY, kCoverage, [](Call* c) { c->map.offset = 490; });
  expect(STARFOCUS_ERROR_NOT_FINITE, kCoverage, [](Call* c) {
    c->map.has_invalid = 1;
    c->map.invalid = 20;
  });
  // The planes overlap the matte, each other, or the map.
  const S overlap = STARFOCUS_ERROR_OVERLAP;
  const auto bytes = [](const void* data) { return static_cast<const uint8_t*>(data); };
  expect(overlap, kBoth, [&](Call* c) { c->matte.data = c->out.coverage; });
  expect(overlap, kField, [&](Call* c) { c->matte.data = bytes(c->out.disparity); });
  expect(overlap, kField,
         [&](Call* c) { c->out.coverage = reinterpret_cast<uint8_t*>(c->out.disparity + kWidth); });
  std::vector<float> own = portrait.map;
  expect(overlap, kCoverage, [&](Call* c) {
    c->map.data = own.data();
    c->out.coverage = reinterpret_cast<uint8_t*>(own.data());
  });
  CHECK((own == portrait.map));
  const auto unset = [](auto value) { return value == kUnset; };
  CHECK(std::all_of(planes.map.begin(), planes.map.end(), unset));
  CHECK(std::all_of(planes.coverage.begin(), planes.coverage.end(), unset));

  const Call call = {portrait.matte.Get(), kFlat, portrait.Depth(), kWidth, kHeight, {}, {}};
  starfocus_disparity_output out = planes.Out();
  starfocus_matte_stats stats;
  const S null = STARFOCUS_ERROR_NULL;
  CHECK(starfocus_measure_matte(nullptr, &stats) == null);
  CHECK(starfocus_measure_matte(&call.matte, nullptr) == null);
  CHECK(starfocus_matte_field(nullptr, &call.depth, kWidth, kHeight, nullptr, &out) == null);
  CHECK(starfocus_matte_field(&call.matte, nullptr, kWidth, kHeight, nullptr, &out) == null);
  CHECK(starfocus_matte_field(&call.matte, &call.depth, kWidth, kHeight, nullptr, nullptr) == null);
  CHECK(starfocus_matte_coverage(nullptr, &call.map, kWidth, kHeight, nullptr, &out) == null);
  CHECK(starfocus_matte_coverage(&call.matte, nullptr, kWidth, kHeight, nullptr, &out) == null);
  CHECK(starfocus_matte_coverage(&call.matte, &call.map, kWidth, kHeight, nullptr, nullptr) ==
        null);
}

TEST_CASE("matte: regions have the bytes of the whole picture") {
  constexpr int kWidth = Portrait::kWidth, kHeight = Portrait::kHeight;
  const Portrait portrait(3);
  const starfocus_matte own = portrait.matte.Get();
  const Matte small = RandomMatte(30, 20, 4, 7), large = RandomMatte(500, 430);
  const starfocus_depth_map map = portrait.Depth();
  const starfocus_matte_depth depth = {20, 0, 0.2, 0.9};
  for (const starfocus_matte& matte : {own, small.Get(), large.Get()}) {
    for (const bool has_map : {false, true}) {
      const auto make = [&](const starfocus_region* region, Planes* planes) {
        starfocus_disparity_output out = planes->Out();
        REQUIRE((has_map ? starfocus_matte_coverage(&matte, &map, kWidth, kHeight, region, &out)
                         : starfocus_matte_field(&matte, &depth, kWidth, kHeight, region, &out)) ==
                STARFOCUS_OK);
      };
      Planes whole(kWidth, kHeight), again(kWidth, kHeight);
      make(nullptr, &whole);
      const starfocus_region all = {};
      make(&all, &again);
      CHECK((again.coverage == whole.coverage));
      for (const starfocus_region& region :
           {starfocus_region{0, 0, 1, 1}, {169, 199, 1, 1}, {37, 101, 70, 66}, {1, 0, 169, 200}}) {
        Planes part(region.width, region.height);
        make(&region, &part);
        int wrong = 0;
        for (int y = 0; y < region.height; ++y) {
          for (int x = 0; x < region.width; ++x) {
            const int at_x = region.x + x, at_y = region.y + y;
            wrong += part.Coverage(x, y) != whole.Coverage(at_x, at_y) ? 1 : 0;
            wrong += part.Map(x, y) != whole.Map(at_x, at_y) ? 1 : 0;
          }
        }
        CHECK(wrong == 0);
        CHECK(part.PaddingIsUnset());
      }
    }
  }
}

}  // namespace
}  // namespace matte_bytes_test
