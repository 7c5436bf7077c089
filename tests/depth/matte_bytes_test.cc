// SPDX-License-Identifier: Apache-2.0
// Tests the measurement of mattes, maps and coverage of two surfaces, and coverage from a matte and
// a map.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "starfocus/matte.h"
#include "tests/support/test_scene.h"

namespace matte_bytes_test {
namespace {

using test::Random;

// Value of samples that no call has written.
constexpr uint8_t kUnset = 77;

struct Matte {
  Matte(int w, int h, int pixel_stride = 1, int padding = 0)
      : width(w),
        height(h),
        step(pixel_stride),
        row(w * step + padding),
        bytes(size_t(row) * size_t(h)) {}
  uint8_t& At(int x, int y) { return bytes[size_t(y * row + x * step + step - 1)]; }
  starfocus_matte Get() const {
    return {bytes.data() + step - 1, size_t(row), step == 1 ? 0 : step, width, height};
  }

  int width, height, step, row;
  std::vector<uint8_t> bytes;
};

Matte RandomMatte(int width, int height, int pixel_stride = 1, int padding = 0) {
  Matte matte(width, height, pixel_stride, padding);
  Random random(uint64_t(width + 1000 * height));
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

constexpr starfocus_matte_depth kFlatSurfaces = {9.5, -2, 0, 0};

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

starfocus_matte_stats Measured(const Matte& matte) {
  const starfocus_matte given = matte.Get();
  starfocus_matte_stats stats;
  REQUIRE(starfocus_measure_matte(&given, &stats, nullptr) == STARFOCUS_OK);
  return stats;
}

// Left, top, right, bottom, horizon and ground, rounded to 1e-9.
using Box = std::array<double, 6>;
Box BoxOf(const starfocus_matte_stats& stats) {
  Box box = {stats.left, stats.top, stats.right, stats.bottom, stats.horizon, stats.ground};
  for (double& value : box) value = std::round(value * 1e9) / 1e9;
  return box;
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
  const starfocus_matte_stats stats = Measured(matte);
  CHECK(stats.covered == doctest::Approx((20 * 14 * 128 + 20 * 127) / (255.0 * 800)));
  CHECK(BoxOf(stats) == Box{0.25, 0.2, 0.75, 0.9, 0.5, 0.9});
  for (int y = 8; y < 20; ++y) {
    for (int x = 0; x < 40; ++x) matte.At(x, y) = 0;
  }
  CHECK(BoxOf(Measured(matte)) == Box{0.25, 0.2, 0.75, 0.4, 0.3, 0.4});
}

TEST_CASE("matte: a wrong sample does not move the proposed floor") {
  Matte matte(64, 80);
  for (int y = 16; y < 48; ++y) {
    for (int x = 16; x < 48; ++x) matte.At(x, y) = 255;
  }
  CHECK(BoxOf(Measured(matte)) == Box{0.25, 0.2, 0.75, 0.6, 0.4, 0.6});
  matte.At(3, 79) = 255;
  CHECK(BoxOf(Measured(matte)) == Box{3 / 64.0, 0.2, 0.75, 1, 0.4, 0.6});
  matte.At(3, 0) = 255;
  CHECK(BoxOf(Measured(matte)) == Box{3 / 64.0, 0, 0.75, 1, 0.4, 0.6});
}

TEST_CASE("matte: without a subject, the box and the floor are 0") {
  Matte matte(7, 5);
  std::fill(matte.bytes.begin(), matte.bytes.end(), uint8_t{127});
  CHECK(Measured(matte).covered == doctest::Approx(127 / 255.0));
  CHECK(BoxOf(Measured(matte)) == Box{});
}

TEST_CASE("matte: the coverage is the resampled matte, and the map follows the coverage") {
  struct Sizes {
    int width, height, wide, high;  // of the matte and the picture
  };
  for (const Sizes& sizes : {Sizes{300, 50, 300, 50},
                             {9, 7, 17, 14},
                             {9, 7, 40, 29},
                             {9, 7, 108, 64},
                             {300, 211, 77, 40},
                             {50, 9, 23, 31},
                             {5, 90, 600, 89},
                             {1, 1, 3, 2},
                             {23, 1, 1, 9}}) {
    CAPTURES(sizes.width, sizes.wide);
    Matte matte = RandomMatte(sizes.width, sizes.height, 4, 9);
    const Planes made = Field(matte.Get(), kFlatSurfaces, sizes.wide, sizes.high);
    const double smooth =
        (SmoothPart(sizes.wide, sizes.width) + SmoothPart(sizes.high, sizes.height)) / 2;
    const double contrast = 1 + 0.3 * smooth;
    // A matte of the size of the picture is the coverage, byte for byte.
    const bool same = sizes.width == sizes.wide && sizes.height == sizes.high;
    int wrong = 0;
    for (int y = 0; y < sizes.high; ++y) {
      for (int x = 0; x < sizes.wide; ++x) {
        const double mean = Resampled(y, sizes.high, sizes.height, [&](int row) {
          return Resampled(x, sizes.wide, sizes.width, [&](int k) { return matte.At(k, row); });
        });
        const double alpha = 127.5 + (mean - 127.5) * contrast;
        const int coverage = made.Coverage(x, y);
        wrong += std::fabs(std::clamp(alpha, 0.0, 255.0) - coverage) > (same ? 0 : 0.8) ? 1 : 0;
        wrong += made.Map(x, y) != (coverage >= 128 ? 9.5F : -2.0F) ? 1 : 0;
      }
    }
    CHECK(wrong == 0);
  }
}

TEST_CASE("matte: an empty or full matte stays empty or full at every size") {
  for (const int value : {0, 255}) {
    for (const int samples : {1, 3, 200, STARFOCUS_MAX_SIZE}) {
      for (const int pixels : {1, 7, 199, STARFOCUS_MAX_SIZE}) {
        Matte matte(samples, 1);
        std::fill(matte.bytes.begin(), matte.bytes.end(), uint8_t(value));
        const Planes made = Field(matte.Get(), kFlatSurfaces, pixels, 1);
        const auto end = made.coverage.begin() + pixels;
        CHECK(std::all_of(made.coverage.begin(), end, [&](int c) { return c == value; }));
      }
    }
  }
}

TEST_CASE("matte: the floor rises from the horizon to the ground") {
  constexpr int kHeight = 120;
  const Matte matte(4, 4);
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
  Planes planes(1, 1);
  starfocus_disparity_output out = planes.Out();
  out.coverage = nullptr;
  REQUIRE(starfocus_matte_field(&given, &depth, 1, 1, nullptr, &out, nullptr) == STARFOCUS_OK);
  CHECK(planes.Map(0, 0) == 1 + 1 / 64.0F);
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
  Planes Coverage() const { return CoverageBy(Depth()); }
  Planes CoverageBy(const starfocus_depth_map& depth) const {
    const starfocus_matte given = matte.Get();
    Planes planes(kWidth, kHeight);
    starfocus_disparity_output out = planes.Out();
    REQUIRE(starfocus_matte_coverage(&given, &depth, kWidth, kHeight, nullptr, &out, nullptr) ==
            STARFOCUS_OK);
    CHECK(out.has_coverage == 1);
    CHECK(planes.PaddingIsUnset());
    CHECK(planes.Map(0, 0) == kUnset);
    return planes;
  }
  // Checks that the coverage around the outline is the matte.
  void CheckFollowed(const Planes& made, int reach = 20) {
    for (int x = kOutline - reach; x < kOutline + reach; ++x) {
      CHECK(made.Coverage(x, 60) == matte.At(x, 60));
    }
  }

  std::vector<float> map;
  Matte matte;
};

TEST_CASE("matte and map: at outlines of the subject, the coverage is the matte") {
  for (const int error : {-10, 0, 10}) {
    CAPTURE(error);
    Portrait portrait(error);
    portrait.CheckFollowed(portrait.Coverage());
  }
}

TEST_CASE("matte and map: a narrow strip of the map along an outline does not count") {
  Portrait portrait(0);
  for (int y = 0; y < Portrait::kHeight; ++y) {
    float* const row = portrait.map.data() + y * Portrait::kWidth;
    std::fill(row + Portrait::kOutline - 3, row + Portrait::kOutline, 5.5F);
  }
  portrait.CheckFollowed(portrait.Coverage());
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
  for (uint8_t& alpha : portrait.matte.bytes) alpha = std::min<uint8_t>(alpha, 235);
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

TEST_CASE("matte and map: a map of codes at a smaller size gives the coverage of its disparities") {
  constexpr int kWide = 85, kHigh = 50;
  std::vector<uint8_t> codes;
  std::vector<float> values;
  for (int at = 0; at < kWide * kHigh; ++at) {
    codes.push_back(at % kWide < 33 ? 40 : 2);
    values.push_back(codes.back() * 0.5F - 1);
  }
  Portrait portrait(0);
  const starfocus_depth_map small = {
      codes.data(), kWide, kWide, kHigh, STARFOCUS_DEPTH_U8, STARFOCUS_DEPTH_LINEAR, 0.5, -1, 0, 0};
  const starfocus_depth_map floats =
      starfocus_depth_float(values.data(), sizeof(float) * kWide, kWide, kHigh);
  const Planes made = portrait.CoverageBy(small);
  CHECK((made.coverage == portrait.CoverageBy(floats).coverage));
  portrait.CheckFollowed(made, 30);
}

// The arguments of calls with a matte; functions of the API take pointers to them.
struct Call {
  starfocus_matte matte;
  starfocus_matte_depth depth;
  starfocus_depth_map map;
  int width, height;
  starfocus_region region;
  starfocus_disparity_output out;
  const starfocus_matte* matte_at = &matte;
  const starfocus_matte_depth* depth_at = &depth;
  const starfocus_depth_map* map_at = &map;
  starfocus_disparity_output* out_at = &out;

  starfocus_status Field() {
    return starfocus_matte_field(matte_at, depth_at, width, height, &region, out_at, nullptr);
  }
  starfocus_status Coverage() {
    return starfocus_matte_coverage(matte_at, map_at, width, height, &region, out_at, nullptr);
  }
};

uint8_t* BytesOf(const void* data) { return static_cast<uint8_t*>(const_cast<void*>(data)); }

void SetDepth(double subject, double background, double horizon, double ground, Call* call) {
  call->depth = {subject, background, horizon, ground};
}
void SetRegion(int x, int y, int width, int height, Call* call) {
  call->region = {x, y, width, height};
}

enum Functions { kField = 1, kCoverage = 2, kBoth = 3 };

struct Refusal {
  Functions functions;
  starfocus_status status;
  void (*spoil)(Call* call);
};
constexpr int kWide = Portrait::kWidth, kMost = STARFOCUS_MAX_SIZE;
constexpr starfocus_status kNull = STARFOCUS_ERROR_NULL, kRange = STARFOCUS_ERROR_RANGE,
                           kStride = STARFOCUS_ERROR_STRIDE, kOverlap = STARFOCUS_ERROR_OVERLAP;

const Refusal kRefusals[] = {
    {kBoth, kNull, [](Call* c) { c->matte_at = nullptr; }},
    {kField, kNull, [](Call* c) { c->depth_at = nullptr; }},
    {kCoverage, kNull, [](Call* c) { c->map_at = nullptr; }},
    {kBoth, kNull, [](Call* c) { c->out_at = nullptr; }},
    {kBoth, kNull, [](Call* c) { c->matte.data = nullptr; }},
    {kField, kNull, [](Call* c) { c->out.disparity = nullptr; }},
    {kCoverage, kNull, [](Call* c) { c->out.coverage = nullptr; }},
    {kBoth, kRange, [](Call* c) { c->matte.width = 0; }},
    {kBoth, kRange, [](Call* c) { c->matte.width = -1; }},
    {kBoth, kRange, [](Call* c) { c->matte.width = kMost + 1; }},
    {kBoth, kRange, [](Call* c) { c->matte.height = 0; }},
    {kBoth, kRange, [](Call* c) { c->matte.height = kMost + 1; }},
    {kBoth, kRange, [](Call* c) { c->width = 0; }},
    {kBoth, kRange, [](Call* c) { c->width = kMost + 1; }},
    {kBoth, kRange, [](Call* c) { c->height = 0; }},
    {kBoth, kRange, [](Call* c) { c->height = kMost + 1; }},
    {kBoth, kRange, [](Call* c) { c->matte.pixel_stride = -1; }},
    {kBoth, kRange, [](Call* c) { c->matte.pixel_stride = STARFOCUS_MAX_PIXEL_STRIDE + 1; }},
    {kBoth, kStride, [](Call* c) { c->matte.stride = kWide - 1; }},
    {kBoth, kStride, [](Call* c) { c->matte.pixel_stride = 2; }},
    {kBoth, kStride, [](Call* c) { c->out.coverage_stride = kWide - 1; }},
    {kField, kStride, [](Call* c) { c->out.disparity_stride = 4 * kWide - 4; }},
    {kField, kStride, [](Call* c) { c->out.disparity_stride = 4 * kWide + 1; }},
    {kBoth, kRange, [](Call* c) { SetRegion(0, 0, kWide + 1, 1, c); }},
    {kBoth, kRange, [](Call* c) { SetRegion(-1, 0, 5, 1, c); }},
    {kField, kRange, [](Call* c) { c->depth.subject = 501; }},
    {kField, kRange, [](Call* c) { c->depth.subject = -501; }},
    {kField, kRange, [](Call* c) { c->depth.subject = NAN; }},
    {kField, kRange, [](Call* c) { c->depth.background = 501; }},
    {kField, kRange, [](Call* c) { c->depth.background = -501; }},
    {kField, kRange, [](Call* c) { c->depth.background = NAN; }},
    {kField, kRange, [](Call* c) { SetDepth(1, 1.01, 0, 0, c); }},
    {kField, kRange, [](Call* c) { SetDepth(9, 0, 0.5, 0.5, c); }},
    {kField, kRange, [](Call* c) { SetDepth(9, 0, 0.5, 0, c); }},
    {kField, kRange, [](Call* c) { SetDepth(9, 0, -0.1, 1, c); }},
    {kField, kRange, [](Call* c) { SetDepth(9, 0, 0, 1.1, c); }},
    {kField, kRange, [](Call* c) { SetDepth(9, 0, NAN, 1, c); }},
    {kField, kRange, [](Call* c) { SetDepth(9, 0, 0, NAN, c); }},
    {kField, kRange, [](Call* c) { SetDepth(9, 0, 1, 1, c); }},
    {kCoverage, kRange, [](Call* c) { c->map.width = kWide + 1; }},
    {kCoverage, kRange, [](Call* c) { c->map.scale = 0; }},
    {kCoverage, STARFOCUS_ERROR_DISPARITY, [](Call* c) { c->map.offset = 490; }},
    {kCoverage, STARFOCUS_ERROR_NOT_FINITE,
     [](Call* c) { c->map.has_invalid = 1, c->map.invalid = 20; }},
    {kBoth, kOverlap, [](Call* c) { c->matte.data = c->out.coverage; }},
    {kField, kOverlap, [](Call* c) { c->matte.data = BytesOf(c->out.disparity); }},
    {kField, kOverlap, [](Call* c) { c->out.coverage = BytesOf(c->out.disparity + kWide); }},
    {kCoverage, kOverlap, [](Call* c) { c->out.coverage = BytesOf(c->map.data); }},
};

TEST_CASE("matte: illegal arguments are rejected, and nothing is written") {
  const Portrait portrait(0);
  const std::vector<float> map = portrait.map;
  Planes planes(kWide, Portrait::kHeight);
  for (const Refusal& row : kRefusals) {
    CAPTURE(&row - kRefusals);
    Call call = {
        portrait.matte.Get(), kFlatSurfaces, portrait.Depth(), kWide, Portrait::kHeight, {},
        planes.Out()};
    row.spoil(&call);
    if (row.functions != kCoverage) CHECK(call.Field() == row.status);
    if (row.functions != kField) CHECK(call.Coverage() == row.status);
    CHECK(call.out.has_coverage == 0);
  }
  CHECK((portrait.map == map));
  const auto unset = [](auto value) { return value == kUnset; };
  CHECK(std::all_of(planes.map.begin(), planes.map.end(), unset));
  CHECK(std::all_of(planes.coverage.begin(), planes.coverage.end(), unset));
  const starfocus_matte given = portrait.matte.Get();
  starfocus_matte_stats stats;
  CHECK(starfocus_measure_matte(nullptr, &stats, nullptr) == kNull);
  CHECK(starfocus_measure_matte(&given, nullptr, nullptr) == kNull);
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
        REQUIRE((has_map ? starfocus_matte_coverage(&matte, &map, kWidth, kHeight, region, &out,
                                                    nullptr)
                         : starfocus_matte_field(&matte, &depth, kWidth, kHeight, region, &out,
                                                 nullptr)) == STARFOCUS_OK);
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
