// SPDX-License-Identifier: Apache-2.0
// Tests coverage from a matte and a map, and arguments and regions of all calls with mattes.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "lib/matting/coverage.h"
#include "tests/depth/matte_planes.h"
#include "tests/support/simd_targets.h"

namespace matte_coverage_bytes_test {
namespace {

using test::kUnset;
using test::Matte;
using test::Planes;

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
    REQUIRE(starfocus_matte_coverage(&given, &depth, kWidth, kHeight, nullptr, &out, nullptr) ==
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

TEST_CASE("matte and map: a narrow strip of the map along an outline does not count") {
  Portrait portrait(0);
  for (int y = 0; y < Portrait::kHeight; ++y) {
    float* const row = portrait.map.data() + y * Portrait::kWidth;
    std::fill(row + Portrait::kOutline - 3, row + Portrait::kOutline, 5.5F);
  }
  const Planes made = portrait.Coverage();
  for (int x = Portrait::kOutline - 20; x < Portrait::kOutline + 20; ++x) {
    CHECK(made.Coverage(x, 60) == portrait.matte.At(x, 60));
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
                                   &first, nullptr) == STARFOCUS_OK);
  REQUIRE(starfocus_matte_coverage(&matte, &floats, Portrait::kWidth, Portrait::kHeight, nullptr,
                                   &second, nullptr) == STARFOCUS_OK);
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
    Call call = {portrait.matte.Get(), test::kFlatSurfaces, portrait.Depth(), kWidth, kHeight, {},
                 planes.Out()};
    change(&call);
    if (use != kCoverage) {
      CHECK(starfocus_matte_field(&call.matte, &call.depth, call.width, call.height, &call.region,
                                  &call.out, nullptr) == status);
    }
    if (use != kField) {
      CHECK(starfocus_matte_coverage(&call.matte, &call.map, call.width, call.height, &call.region,
                                     &call.out, nullptr) == status);
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

  const Call call = {
      portrait.matte.Get(), test::kFlatSurfaces, portrait.Depth(), kWidth, kHeight, {}, {}};
  starfocus_disparity_output out = planes.Out();
  starfocus_matte_stats stats;
  const S null = STARFOCUS_ERROR_NULL;
  CHECK(starfocus_measure_matte(nullptr, &stats, nullptr) == null);
  CHECK(starfocus_measure_matte(&call.matte, nullptr, nullptr) == null);
  CHECK(starfocus_matte_field(nullptr, &call.depth, kWidth, kHeight, nullptr, &out, nullptr) ==
        null);
  CHECK(starfocus_matte_field(&call.matte, nullptr, kWidth, kHeight, nullptr, &out, nullptr) ==
        null);
  CHECK(starfocus_matte_field(&call.matte, &call.depth, kWidth, kHeight, nullptr, nullptr,
                              nullptr) == null);
  CHECK(starfocus_matte_coverage(nullptr, &call.map, kWidth, kHeight, nullptr, &out, nullptr) ==
        null);
  CHECK(starfocus_matte_coverage(&call.matte, nullptr, kWidth, kHeight, nullptr, &out, nullptr) ==
        null);
  CHECK(starfocus_matte_coverage(&call.matte, &call.map, kWidth, kHeight, nullptr, nullptr,
                                 nullptr) == null);
}

TEST_CASE("matte: regions have the bytes of the whole picture") {
  constexpr int kWidth = Portrait::kWidth, kHeight = Portrait::kHeight;
  const Portrait portrait(3);
  const starfocus_matte own = portrait.matte.Get();
  const Matte small = test::RandomMatte(30, 20, 4, 7), large = test::RandomMatte(500, 430);
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
}  // namespace matte_coverage_bytes_test
