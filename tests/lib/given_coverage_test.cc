// SPDX-License-Identifier: Apache-2.0
// Tests that given coverage takes precedence over a map that is wrong by several pixels, in all
// ways to refocus.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/image_field.h"
#include "tests/support/prepared_memory.h"
#include "tests/support/refocused.h"
#include "tests/support/test_scene.h"
#include "tests/support/ways.h"

namespace given_coverage_test {
namespace {

constexpr int kWidth = 192, kHeight = 160, kTop = 40, kBottom = 120, kLeft = 50, kRight = 140;
constexpr double kNear = 6, kFar = -6;

// Returns the coverage of a comb of bars in front of a wall. The last column of each bar is half
// covered.
double CoverageAt(int x, int y) {
  if (x < kLeft || x >= kRight || y < kTop || y >= kBottom) return 0;
  const int k = (x - kLeft) % 9;
  return k < 4 ? 1 : k == 4 ? 0.5 : 0;
}

double WallAt(int x, int y, int c) {
  return 160 + 15 * c + 20 * std::sin(x / 17.0 + c) + 20 * std::cos(y / 21.0);
}
double BarAt(int c) { return 70 - 15 * c; }

// Returns one view, and a map in which the comb is a solid block that is too small by 3 pixels.
test::Scene Comb() {
  test::Scene scene = test::EmptyScene(kWidth, kHeight, 1, float(kFar), float(kNear));
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const double coverage = CoverageAt(x, y);
      scene.coverage.push_back(uint8_t(std::lround(255 * coverage)));
      for (int c = 0; c < 3; ++c) {
        const double light = coverage * BarAt(c) + (1 - coverage) * WallAt(x, y, c);
        scene.Pixel(0, x, y)[c] = uint8_t(std::lround(light));
      }
      const bool near = x >= kLeft + 3 && x < kRight - 3 && y >= kTop + 3 && y < kBottom - 3;
      scene.Disparity(x, y) = float(near ? kNear : kFar);
    }
  }
  return scene;
}

test::Config CombConfig(const test::Scene& scene) {
  test::Config config = test::ConfigFor(scene, kNear - kFar);
  config.transfer = STARFOCUS_TRANSFER_NONE;
  config.superblock = 64;
  return config;
}

// Returns parameters for block mode with a disc as the opening.
starfocus::Params ThroughDisc(double focus) {
  starfocus::Params params = test::Params(focus, 1, STARFOCUS_MODE_BLOCK);
  params.shape = STARFOCUS_SHAPE_DISC;
  return params;
}

// Returns the PSNR in dB of a picture that is focused on the wall. The comb in front of the wall is
// blurred.
double PsnrOf(const test::Output& out) {
  constexpr int kBlur = int(kNear - kFar);
  double sum = 0, count = 0;
  for (int y = 16; y < kHeight - 16; ++y) {
    for (int x = 16; x < kWidth - 16; ++x) {
      double coverage = 0, points = 0;
      for (int dy = -kBlur; dy <= kBlur; ++dy) {
        for (int dx = -kBlur; dx <= kBlur; ++dx) {
          if (dx * dx + dy * dy > kBlur * kBlur) continue;
          coverage += CoverageAt(x + dx, y + dy);
          ++points;
        }
      }
      coverage /= points;
      for (int c = 0; c < 3; ++c, ++count) {
        const double truth = coverage * BarAt(c) + (1 - coverage) * WallAt(x, y, c);
        sum += (out.Pixel(x, y)[c] - truth) * (out.Pixel(x, y)[c] - truth);
      }
    }
  }
  return 10 * std::log10(255 * 255 * count / sum);
}

test::Scene Without(test::Scene scene) {
  scene.coverage.clear();
  return scene;
}

TEST_CASE("given coverage: coverage shows gaps of a comb that the disparity map lacks") {
  const test::Scene scene = Comb();
  const starfocus::Params params = ThroughDisc(kFar);
  const double with = PsnrOf(test::OutputOf(CombConfig(scene), params, scene));
  const double without = PsnrOf(test::OutputOf(CombConfig(scene), params, Without(scene)));
  MESSAGE("PSNR without and with coverage: ", without, " and ", with, " dB");
  CHECK(with > without + 6);
}

// Pixels in columns left of kOutline show the near surface, and half of the pixels of column
// kOutline. The wall has fine detail.
constexpr int kOutline = 96;
double OutlineAt(int x) { return x < kOutline ? 1 : x == kOutline ? 0.5 : 0; }
double FineWallAt(int x, int y, int c) {
  return WallAt(x, y, c) + 20 * std::sin(2.1 * x + 1.3 * y);
}

// Returns the error in dB of a picture that is focused on the wall, next to the outline.
double FinePsnrOf(const test::Output& out) {
  constexpr int kBlur = int(kNear - kFar);
  double sum = 0, count = 0;
  for (int y = 16; y < kHeight - 16; ++y) {
    for (int x = kOutline - kBlur; x < kOutline + kBlur; ++x) {
      double coverage = 0, points = 0;
      for (int dx = -kBlur; dx <= kBlur; ++dx) {
        const double chord = std::sqrt(double(kBlur * kBlur - dx * dx));
        coverage += chord * OutlineAt(x + dx);
        points += chord;
      }
      coverage /= points;
      for (int c = 0; c < 3; ++c, ++count) {
        const double truth = coverage * BarAt(c) + (1 - coverage) * FineWallAt(x, y, c);
        sum += (out.Pixel(x, y)[c] - truth) * (out.Pixel(x, y)[c] - truth);
      }
    }
  }
  return 10 * std::log10(255 * 255 * count / sum);
}

TEST_CASE("given coverage: with side views, detail behind an outline stays as sharp as without") {
  test::Scene scene = test::EmptyScene(kWidth, kHeight, 5, float(kFar), float(kNear));
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      for (int view = 0; view < 5; ++view) {
        const starfocus_position at = scene.PositionOf(view);
        const int u = int(at.u), v = int(at.v);
        const double coverage = OutlineAt(x + u * int(kNear));
        for (int c = 0; c < 3; ++c) {
          const double wall = FineWallAt(x + u * int(kFar), y + v * int(kFar), c);
          const double light = coverage * BarAt(c) + (1 - coverage) * wall;
          scene.Pixel(view, x, y)[c] = uint8_t(std::lround(light));
        }
      }
      scene.coverage.push_back(uint8_t(std::lround(255 * OutlineAt(x))));
      scene.Disparity(x, y) = float(x < kOutline ? kNear : kFar);
    }
  }
  const starfocus::Params params = ThroughDisc(kFar);
  const double with = FinePsnrOf(test::OutputOf(CombConfig(scene), params, scene));
  const double without = FinePsnrOf(test::OutputOf(CombConfig(scene), params, Without(scene)));
  MESSAGE("PSNR without and with coverage: ", without, " and ", with, " dB");
  CHECK(with > without - 0.05);
}

// Returns one view of a disc in front of the wall. The map is hard, and coverage is true.
test::Scene Disc() {
  constexpr int kParts = 8;
  test::Scene scene = test::EmptyScene(kWidth, kHeight, 1, float(kFar), float(kNear));
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      int parts = 0;
      for (int part = 0; part < kParts * kParts; ++part) {
        const double dx = x + (part % kParts + 0.5) / kParts - 95.8;
        const double dy = y + (part / kParts + 0.5) / kParts - 80.3;
        parts += dx * dx + dy * dy < 45 * 45 ? 1 : 0;
      }
      const double coverage = parts / double(kParts * kParts);
      scene.coverage.push_back(uint8_t(std::lround(255 * coverage)));
      for (int c = 0; c < 3; ++c) {
        const double light = coverage * BarAt(c) + (1 - coverage) * WallAt(x, y, c);
        scene.Pixel(0, x, y)[c] = uint8_t(std::lround(light));
      }
      scene.Disparity(x, y) = float(coverage >= 0.5 ? kNear : kFar);
    }
  }
  return scene;
}

// Returns the squared error of a picture of Disc() that is focused on the disc.
double ErrorBesideDisc(const test::Output& out, const test::Scene& scene) {
  constexpr int kBlur = int(kNear - kFar);
  double sum = 0;
  for (int y = 16; y < kHeight - 16; ++y) {
    for (int x = 16; x < kWidth - 16; ++x) {
      double wall[3] = {}, points = 0;
      for (int dy = -kBlur; dy <= kBlur; ++dy) {
        for (int dx = -kBlur; dx <= kBlur; ++dx) {
          if (dx * dx + dy * dy > kBlur * kBlur) continue;
          for (int c = 0; c < 3; ++c) wall[c] += WallAt(x + dx, y + dy, c);
          ++points;
        }
      }
      const double coverage = scene.coverage[size_t(y * kWidth + x)] / 255.0;
      for (int c = 0; c < 3; ++c) {
        const double truth = coverage * BarAt(c) + (1 - coverage) * wall[c] / points;
        sum += (out.Pixel(x, y)[c] - truth) * (out.Pixel(x, y)[c] - truth);
      }
    }
  }
  return sum;
}

TEST_CASE("given coverage: beside an exact map, true coverage does not cost accuracy") {
  const test::Scene scene = Disc();
  const starfocus::Params params = ThroughDisc(kNear);
  const double with = ErrorBesideDisc(test::OutputOf(CombConfig(scene), params, scene), scene);
  const double without =
      ErrorBesideDisc(test::OutputOf(CombConfig(scene), params, Without(scene)), scene);
  MESSAGE("squared error without and with coverage: ", without, " and ", with);
  CHECK(with < without);
}

TEST_CASE("given coverage: a narrow strip of another disparity along an outline does not show") {
  const test::Scene scene = Disc();
  test::Scene strip = scene;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const double radius = std::hypot(x - 95.3, y - 79.8);
      if (radius > 43 && radius < 45) strip.Disparity(x, y) = float((kNear + kFar) / 2);
    }
  }
  const starfocus::Params params = ThroughDisc(kFar);
  const test::Output one = test::OutputOf(CombConfig(scene), params, scene);
  const test::Output other = test::OutputOf(CombConfig(strip), params, strip);
  int most = 0;
  for (size_t n = 0; n < one.bytes.size(); ++n) {
    most = std::max(most, std::abs(one.bytes[n] - other.bytes[n]));
  }
  CHECK(most <= 4);
}

TEST_CASE("given coverage: coverage that repeats the map changes nothing, even beside mixtures") {
  test::Scene scene = Comb();
  // The only mixed pixel is at (kMixed, kTop + 3). In the same tile, the wall has a low step.
  constexpr int kMixed = 48, kStep = 62;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = kStep - 1; x < kWidth && y < kTop - 2; ++x) {
      if (x >= kStep) scene.Disparity(x, y) = float(kFar + 3.5);
      for (int c = 0; c < 3; ++c) scene.Pixel(0, x, y)[c] /= x < kStep ? 2 : 4;
    }
    for (int x = 0; x < kWidth; ++x) {
      scene.coverage[size_t(y * kWidth + x)] = scene.Disparity(x, y) == float(kNear) ? 255 : 0;
    }
  }
  scene.coverage[size_t((kTop + 3) * kWidth + kMixed)] = 128;
  test::Config config = CombConfig(scene);
  config.tuning.gather = 0;
  for (const double focus : {kFar, kNear}) {
    starfocus::Params params = ThroughDisc(focus);
    params.aperture = 0.5;
    const test::Output with = test::OutputOf(config, params, scene);
    const test::Output without = test::OutputOf(config, params, Without(scene));
    int most = 0;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        // The mixture changes pixels up to 3 pixels away, which a blur of 6 pixels spreads.
        if (std::max(std::abs(x - kMixed), std::abs(y - kTop - 3)) <= 3 + 6 + 2) continue;
        for (int c = 0; c < 3; ++c) {
          most = std::max(most, std::abs(with.Pixel(x, y)[c] - without.Pixel(x, y)[c]));
        }
      }
    }
    CAPTURE(focus);
    CHECK(most <= 1);
  }
}

TEST_CASE("given coverage: a change of coverage by one code changes no pixel by more than 8") {
  const test::Scene comb = Comb(), disc = Disc();
  for (const test::Scene& original : {comb, disc}) {
    test::Scene scene = original;
    test::Random random(5);
    for (uint8_t& coverage : scene.coverage) {
      coverage = uint8_t(std::clamp(coverage + random.Int(-9, 9), 1, 254));
    }
    for (const int shift : {-1, 1}) {
      test::Scene shifted = scene;
      for (uint8_t& coverage : shifted.coverage) coverage = uint8_t(coverage + shift);
      for (const double focus : {kFar, 0.0, kNear}) {
        const test::Output one = test::OutputOf(CombConfig(scene), ThroughDisc(focus), scene);
        const test::Output other = test::OutputOf(CombConfig(scene), ThroughDisc(focus), shifted);
        int most = 0;
        for (size_t n = 0; n < one.bytes.size(); ++n) {
          most = std::max(most, std::abs(one.bytes[n] - other.bytes[n]));
        }
        CAPTURES(shift, focus);
        CHECK(most <= 8);
      }
    }
  }
}

TEST_CASE("given coverage: a slanted surface that covers its pixels stays closed") {
  constexpr int kEdge = 60, kDark = 20, kBright = 240, kBlur = 20;
  test::Scene scene = test::EmptyScene(128, 96, 1, 0, 40);
  for (int y = 0; y < 96; ++y) {
    for (int x = 0; x < 128; ++x) {
      const bool near = x < kEdge;
      // The disparity changes by 0.2 every 8 rows, as in a repaired map.
      scene.Disparity(x, y) = near ? 36 + float(y / 8) * 0.2F : 0;
      std::fill_n(scene.Pixel(0, x, y), 3, uint8_t(near ? kDark : kBright));
      scene.coverage.push_back(uint8_t(near ? 255 : 0));
    }
    scene.coverage[size_t(y * 128 + kEdge - 1)] = 200;
  }
  const test::Config config = test::ConfigFor(scene, kBlur);
  for (const double focus : {34.0, 37.0}) {
    CAPTURE(focus);
    const starfocus::Params params = test::Params(focus, 0.5, STARFOCUS_MODE_BLOCK);
    const test::Output out = test::OutputOf(config, params, scene);
    int lightest = 0;
    for (int y = 8; y < 88; ++y) {
      for (int x = 8; x < kEdge - 8; ++x) lightest = std::max<int>(lightest, out.Pixel(x, y)[0]);
    }
    CHECK(lightest <= kDark + 1);
  }
}

TEST_CASE("given coverage: the wall ends where coverage ends, even deep inside a silhouette") {
  constexpr int kEdge = 88, kOff = 3, kRadius = 40, kDark = 30, kBright = 200;
  test::Scene scene = test::EmptyScene(192, 96, 1, 0, kRadius);
  for (int y = 0; y < scene.height; ++y) {
    for (int x = 0; x < scene.width; ++x) {
      scene.coverage.push_back(x < kEdge ? 255 : 0);
      std::fill_n(scene.Pixel(0, x, y), 3, uint8_t(x < kEdge ? kDark : kBright));
      // The disparities form a ramp inside the near surface, as in maps of neural networks.
      const double near = std::clamp((kEdge - kOff - x) / 8.0, 0.0, 1.0);
      scene.Disparity(x, y) = float(near * kRadius);
    }
  }
  test::Config config = CombConfig(scene);
  config.max_blur = kRadius;
  const test::Output out = test::OutputOf(config, ThroughDisc(0), scene);
  double most = 0;
  for (int x = kEdge - kRadius; x < kEdge; ++x) {
    const double to_edge = kEdge - 0.5 - x, angle = std::acos(to_edge / kRadius);
    const double wall = (angle - std::sin(angle) * std::cos(angle)) / std::acos(-1.0);
    const double truth = kDark + wall * (kBright - kDark);
    most = std::max(most, std::fabs(out.Pixel(x, scene.height / 2)[1] - truth));
  }
  CHECK(most < 2);
}

TEST_CASE("given coverage: all ways to refocus return the same bytes") {
  const test::Scene scene = Comb();
  const test::Config config = CombConfig(scene);
  for (const double focus : {kFar, 1.0, kNear}) {
    CAPTURE(focus);
    starfocus::Params params = ThroughDisc(focus);
    CHECK((test::OutputOf(config, params, Without(scene)).bytes !=
           test::OutputOf(config, params, scene).bytes));
    test::CheckWays(scene, config, params);
  }
}

// Returns the scene at twice the size, with doubled disparities. Each pixel becomes 2x2 pixels,
// which vary in coverage.
test::Scene Doubled(const test::Scene& scene) {
  test::Scene doubled = test::EmptyScene(2 * kWidth, 2 * kHeight, 1, 2 * scene.disparity_min,
                                         2 * scene.disparity_max);
  for (int y = 0; y < doubled.height; ++y) {
    for (int x = 0; x < doubled.width; ++x) {
      std::copy_n(scene.Pixel(0, x / 2, y / 2), 3, doubled.Pixel(0, x, y));
      doubled.Disparity(x, y) = 2 * scene.Disparity(x / 2, y / 2);
      const int mean = scene.coverage[size_t(y / 2 * kWidth + x / 2)];
      const int more = mean < 5 || mean > 250 ? 0 : 5 * (x % 2 == y % 2 ? 1 : -1);
      doubled.coverage.push_back(uint8_t(mean + more));
    }
  }
  return doubled;
}

TEST_CASE("given coverage: each preview pixel has the mean coverage of 2x2 pixels") {
  const test::Scene scene = Comb(), doubled = Doubled(scene);
  test::Config config = CombConfig(doubled);
  config.max_blur = 4 * kNear;
  config.previews = 1;
  test::Engine engine(config);
  test::PreparedMemory memory(engine);
  const starfocus_prepared* prepared = memory.Prepare(engine.get(), doubled.Field());
  starfocus::Params params = ThroughDisc(2 * kFar);
  test::Output preview(kWidth, kHeight);
  REQUIRE(test::PreviewRgb(engine.get(), &params, prepared, 1, preview.bytes.data(), preview.stride,
                           nullptr) == STARFOCUS_OK);
  params.focus = kFar;
  CHECK((preview.bytes == test::OutputOf(CombConfig(scene), params, scene).bytes));
  CHECK((preview.bytes != test::OutputOf(CombConfig(scene), params, Without(scene)).bytes));
}

TEST_CASE("given coverage: with a previous frame, changes of coverage are detected") {
  const test::Scene before = Comb();
  const test::Config config = CombConfig(before);
  const starfocus::Params params = ThroughDisc(kFar);
  const test::Output first = test::OutputOf(config, params, before);
  test::Scene changed = before;
  changed.coverage[size_t(90 * kWidth + 100)] ^= 255;
  for (const test::Scene& now : {changed, Without(before), before}) {
    test::Engine engine(config);
    test::Output out(kWidth, kHeight);
    const starfocus_light_field field = now.Field();
    const starfocus_light_field before_field = before.Field();
    const starfocus_image before_image = starfocus_image_rgb(first.bytes.data(), first.stride);
    const starfocus_previous previous = {sizeof previous, &before_field, &before_image};
    REQUIRE(test::RefocusAfterRgb(engine.get(), &params, &field, &previous, out.bytes.data(),
                                  out.stride, nullptr) == STARFOCUS_OK);
    CHECK((out.bytes == test::OutputOf(config, params, now).bytes));
  }
}

TEST_CASE(
    "given coverage: without blur, the picture does not change even if the coverage is random") {
  test::Scene scene = Comb();
  test::Random random(3);
  for (uint8_t& coverage : scene.coverage) coverage = random.Byte();
  test::Config config = CombConfig(scene);
  starfocus::Params params = ThroughDisc(0);
  params.aperture = 0.001;
  const test::Output out = test::OutputOf(config, params, scene);
  CHECK((out.bytes == scene.pictures[0]));
}

TEST_CASE("given coverage: highlights brighten only pixels near lamps") {
  test::Scene scene = Comb();
  for (auto& sample : scene.pictures[0]) sample = std::min<uint8_t>(sample, 240);
  for (int y = 2; y < 6; ++y) std::fill_n(scene.Pixel(0, 2, y), 12, uint8_t{255});
  test::Config config = CombConfig(scene);
  const starfocus::Params params = ThroughDisc(kNear);
  const test::Output plain = test::OutputOf(config, params, scene);
  config.highlights = 16;
  const test::Output lit = test::OutputOf(config, params, scene);
  CHECK((lit.bytes != plain.bytes));
  // Blocks with highlights are rendered from views only, so their rounding differs by at most a
  // level.
  int largest = 0;
  for (size_t n = 30 * plain.stride; n < plain.bytes.size(); ++n) {
    largest = std::max(largest, std::abs(lit.bytes[n] - plain.bytes[n]));
  }
  CHECK(largest <= 1);
}

TEST_CASE(
    "given coverage: without the coverage feature, coverage is ignored; bad input is rejected") {
  const test::Scene scene = Comb();
  test::Config config = CombConfig(scene);
  config.features |= STARFOCUS_FEATURE_STREAMING;
  const starfocus::Params params = ThroughDisc(kFar);
  test::Engine engine(config);
  starfocus_light_field field = scene.Field();
  int32_t consumed = 0;
  REQUIRE(starfocus_stream_begin(engine.get(), &params) == STARFOCUS_OK);
  REQUIRE(starfocus_stream_push(engine.get(), &field, 4, &consumed) == STARFOCUS_OK);
  field = scene.Field(4);
  field.coverage = nullptr;
  CHECK(starfocus_stream_push(engine.get(), &field, 4, &consumed) == STARFOCUS_ERROR_STATE);
  CHECK(consumed == 0);
  field = scene.Field();
  test::Output out(kWidth, kHeight);
  field.coverage_stride = kWidth - 1;
  CHECK(test::RefocusRgb(engine.get(), &params, &field, out.bytes.data(), out.stride, nullptr) ==
        STARFOCUS_ERROR_STRIDE);
  field.coverage = out.bytes.data();
  field.coverage_stride = kWidth;
  CHECK(test::RefocusRgb(engine.get(), &params, &field, out.bytes.data(), out.stride, nullptr) ==
        STARFOCUS_ERROR_OVERLAP);
  config.features &= ~STARFOCUS_FEATURE_COVERAGE;
  CHECK((test::OutputOf(config, params, scene).bytes ==
         test::OutputOf(config, params, Without(scene)).bytes));
}

}  // namespace
}  // namespace given_coverage_test
