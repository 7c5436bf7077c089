// SPDX-License-Identifier: Apache-2.0
// Tests the measurement of mattes, and maps and coverage of two surfaces.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/depth/matte_planes.h"

namespace matte_field_bytes_test {
namespace {

using test::Matte;
using test::Planes;

Planes Field(const starfocus_matte& matte, const starfocus_matte_depth& depth, int width,
             int height) {
  Planes planes(width, height);
  starfocus_disparity_output out = planes.Out();
  REQUIRE(starfocus_matte_field(&matte, &depth, width, height, nullptr, &out, nullptr) ==
          STARFOCUS_OK);
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

// Returns the part of the B-spline where `samples` values become `pixels` pixels.
double SmoothPart(int pixels, int samples) {
  return std::clamp((double(pixels) / samples - 2) / 6, 0.0, 1.0);
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
  const double smooth = SmoothPart(pixels, samples), at = (begin + end) / 2 - 0.5;
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
  REQUIRE(starfocus_measure_matte(&given, &stats, nullptr) == STARFOCUS_OK);
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
  REQUIRE(starfocus_measure_matte(&given, &stats, nullptr) == STARFOCUS_OK);
  CHECK(stats.horizon == doctest::Approx(0.3));
}

TEST_CASE("matte: a wrong sample does not move the proposed floor") {
  Matte matte(64, 80);
  std::fill(matte.bytes.begin(), matte.bytes.end(), uint8_t{0});
  for (int y = 16; y < 48; ++y) {
    for (int x = 16; x < 48; ++x) matte.At(x, y) = 255;
  }
  for (const int specks : {0, 1, 2}) {
    if (specks > 0) matte.At(3, specks == 1 ? 79 : 0) = 255;
    const starfocus_matte given = matte.Get();
    starfocus_matte_stats stats;
    REQUIRE(starfocus_measure_matte(&given, &stats, nullptr) == STARFOCUS_OK);
    CHECK(stats.ground == 0.6);
    CHECK(stats.horizon == doctest::Approx(0.4));
    CHECK(stats.bottom == (specks == 0 ? 0.6 : 1));
  }
}

TEST_CASE("matte: without a subject, the box and the floor are 0") {
  Matte matte(7, 5);
  std::fill(matte.bytes.begin(), matte.bytes.end(), uint8_t{127});
  const starfocus_matte given = matte.Get();
  starfocus_matte_stats stats;
  REQUIRE(starfocus_measure_matte(&given, &stats, nullptr) == STARFOCUS_OK);
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
    Matte matte = test::RandomMatte(sizes.width, sizes.height);
    const Planes made = Field(matte.Get(), test::kFlatSurfaces, sizes.wide, sizes.high);
    const double smooth =
        (SmoothPart(sizes.wide, sizes.width) + SmoothPart(sizes.high, sizes.height)) / 2;
    const double contrast = 1 + 0.3 * smooth;
    int wrong = 0;
    for (int y = 0; y < sizes.high; ++y) {
      for (int x = 0; x < sizes.wide; ++x) {
        const double mean = Resampled(y, sizes.high, sizes.height, [&](int row) {
          return Resampled(x, sizes.wide, sizes.width, [&](int k) { return matte.At(k, row); });
        });
        const double alpha = 127.5 + (mean - 127.5) * contrast;
        const int coverage = made.Coverage(x, y);
        wrong += std::fabs(std::clamp(alpha, 0.0, 255.0) - coverage) > 0.8 ? 1 : 0;
        wrong += made.Map(x, y) != (coverage >= 128 ? 9.5F : -2.0F) ? 1 : 0;
      }
    }
    CHECK(wrong == 0);
  }
}

TEST_CASE("matte: a matte of the picture's size is the coverage, byte for byte") {
  Matte matte = test::RandomMatte(300, 50, 4, 9);
  const Planes made = Field(matte.Get(), test::kFlatSurfaces, 300, 50);
  int wrong = 0;
  for (int y = 0; y < 50; ++y) {
    for (int x = 0; x < 300; ++x) wrong += made.Coverage(x, y) != matte.At(x, y) ? 1 : 0;
  }
  CHECK(wrong == 0);
}

TEST_CASE("matte: an empty or full matte stays empty or full at every size") {
  for (const int value : {0, 255}) {
    for (const int samples : {1, 3, 200, STARFOCUS_MAX_SIZE}) {
      for (const int pixels : {1, 7, 199, STARFOCUS_MAX_SIZE}) {
        Matte matte(samples, 1);
        std::fill(matte.bytes.begin(), matte.bytes.end(), uint8_t(value));
        const Planes made = Field(matte.Get(), test::kFlatSurfaces, pixels, 1);
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
  // The ground may be immediately below the horizon.
  for (const double horizon : {0.0, 0.5 - 1e-9}) {
    const starfocus_matte_depth cliff = {20, -3.5, horizon, horizon + 1e-9};
    const Planes steep = Field(matte.Get(), cliff, 2, kHeight);
    CHECK(steep.Map(0, 0) == (horizon == 0 ? 20 : -3.5F));
    CHECK(steep.Map(0, kHeight - 1) == 20);
  }
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
  REQUIRE(starfocus_matte_field(&given, &depth, 1, 1, nullptr, &out, nullptr) == STARFOCUS_OK);
  CHECK(map == 1 + 1 / 64.0F);
  CHECK(out.has_coverage == 0);
}

}  // namespace
}  // namespace matte_field_bytes_test
