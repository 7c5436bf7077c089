// SPDX-License-Identifier: Apache-2.0
// Tests previews. A preview must equal the picture refocused from a reduced light field, byte for
// byte. refusals_bytes_test.cc tests bad input.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "lib/base/transfer.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/refocused.h"
#include "tests/support/rounds.h"
#include "tests/support/scenes.h"

namespace preview_test {
namespace {

int Ceil(int size, int shift) { return (size + (1 << shift) - 1) >> shift; }

// Returns the code whose light is nearest to sum / count.
uint8_t CodeOf(int64_t sum, int64_t count, int32_t transfer) {
  const auto light = static_cast<int16_t>((2 * sum + count) / (2 * count));
  uint8_t code = 0;
  starfocus::simd::reference::Encode(&light, 1, starfocus::TransferOf(transfer), &code);
  return code;
}

// Returns the sample of channel c at (x, y) of the reduced picture.
uint8_t MeanSample(const uint8_t* rgb, size_t stride, int width, int height, int x, int y, int c,
                   int shift, int32_t transfer) {
  int64_t sum = 0, count = 0;
  for (int row = y << shift; row < std::min(height, (y + 1) << shift); ++row) {
    for (int column = x << shift; column < std::min(width, (x + 1) << shift); ++column, ++count) {
      sum +=
          starfocus::TransferOf(transfer).light[rgb[size_t(row) * stride + size_t(3 * column + c)]];
    }
  }
  return CodeOf(sum, count, transfer);
}

float MedianDisparity(const test::Scene& scene, int x, int y, int shift) {
  std::vector<double> values;
  for (int row = y << shift; row < std::min(scene.height, (y + 1) << shift); ++row) {
    for (int column = x << shift; column < std::min(scene.width, (x + 1) << shift); ++column) {
      values.push_back(std::floor(64.0 * double(scene.Disparity(column, row)) + 0.5));
    }
  }
  std::sort(values.begin(), values.end());
  const double median = values[values.size() / 2];
  return float(std::floor(median / (1 << shift) + 0.5) / 64);
}

test::Scene Reduced(const test::Scene& scene, int shift, int32_t transfer) {
  const float side = float(1 << shift);
  test::Scene reduced =
      test::EmptyScene(Ceil(scene.width, shift), Ceil(scene.height, shift), scene.views(),
                       scene.disparity_min / side, scene.disparity_max / side);
  for (int y = 0; y < reduced.height; ++y) {
    for (int x = 0; x < reduced.width; ++x) {
      for (int view = 0; view < scene.views(); ++view) {
        for (int c = 0; c < 3; ++c) {
          reduced.Pixel(view, x, y)[c] =
              MeanSample(scene.Pixel(view, 0, 0), scene.stride, scene.width, scene.height, x, y, c,
                         shift, transfer);
        }
      }
      reduced.Disparity(x, y) = std::clamp(MedianDisparity(scene, x, y, shift),
                                           reduced.disparity_min, reduced.disparity_max);
    }
  }
  return reduced;
}

test::Config ReducedConfig(const test::Config& config, int shift, int32_t superblock) {
  test::Config reduced = config;
  const float side = float(1 << shift);
  reduced.width = Ceil(config.width, shift);
  reduced.height = Ceil(config.height, shift);
  reduced.disparity_min /= side;
  reduced.disparity_max /= side;
  reduced.max_blur /= side;
  reduced.superblock = superblock;
  reduced.features &= ~(STARFOCUS_FEATURE_STREAMING | STARFOCUS_FEATURE_IMAGES);
  reduced.previews = 0;
  return reduced;
}

// Returns the rectangle of reduced pixels that overlap the region. If the region is the whole
// picture, all fields of the result are 0.
starfocus_region ReducedRegion(const starfocus_region& region, int shift) {
  if (region.width == 0) return region;
  const int x = region.x >> shift, y = region.y >> shift;
  return {x, y, Ceil(region.x + region.width, shift) - x,
          Ceil(region.y + region.height, shift) - y};
}

// An engine, and a light field that the engine has prepared.
struct Prepared {
  Prepared(const test::Scene& scene, const test::Config& config)
      : engine(config), memory(engine), field(memory.Prepare(engine.get(), scene.Field())) {}

  // Returns the preview of the whole picture or of params.region.
  test::Output Preview(const starfocus::Params& params, int shift,
                       starfocus_report* report = nullptr) {
    const starfocus_region region = ReducedRegion(params.region, shift);
    const bool whole = region.width == 0;
    test::Output out(whole ? Ceil(engine.config().width, shift) : region.width,
                     whole ? Ceil(engine.config().height, shift) : region.height, 3);
    REQUIRE(test::PreviewRgb(engine.get(), &params, field, shift, out.bytes.data(), out.stride,
                             report) == STARFOCUS_OK);
    return out;
  }

  test::Engine engine;
  test::PreparedMemory memory;
  const starfocus_prepared* field;
};

// Returns true if a preview has the same bytes as the refocused light field `reduced`.
bool IsOfReduced(Prepared* prepared, starfocus::Params params, int shift,
                 const test::Config& config, const test::Scene& reduced) {
  starfocus_report report = starfocus::NewReport();
  const test::Output got = prepared->Preview(params, shift, &report);
  test::Engine small(ReducedConfig(config, shift, report.superblock));
  params.focus /= 1 << shift;
  params.focus_nearer /= 1 << shift;
  params.focus_farther /= 1 << shift;
  params.region = ReducedRegion(params.region, shift);
  test::Output expected(got.width, got.height, 3);
  REQUIRE(test::Refocus(&small, params, reduced, &expected) == STARFOCUS_OK);
  return got.bytes == expected.bytes;
}

TEST_CASE("preview: a preview equals the picture of a light field that is reduced as documented") {
  test::Random random(231);
  constexpr int kSizes[][2] = {{1, 1},     {1, 70},    {90, 1},   {31, 33},
                               {65, 63},   {100, 37},  {67, 190}, {129, 128},
                               {150, 141}, {330, 270}, {203, 90}, {330, 200}};
  constexpr float kOffsets[] = {0, 16, 0, -12, 4.5F};
  int round = 0;
  for (const auto& size : kSizes) {
    test::Scene scene =
        test::LayeredScene(size[0], size[1], test::kStars[round % 4], 7, uint64_t(round) + 90);
    // If the disparity range does not contain 0, the range of the preview is partly or wholly
    // outside the full picture's range.
    const float offset = kOffsets[round % 5];
    scene.disparity_min += offset;
    scene.disparity_max += offset;
    for (float& disparity : scene.disparity) disparity += offset;
    test::Config config = test::ConfigFor(scene, 20);
    config.superblock = 32 << random.Int(0, 2);
    config.tuning.max_layer = round % 4 == 0 ? random.Int(0, 1) : 2;
    config.transfer = round % 3 == 0 ? STARFOCUS_TRANSFER_NONE : STARFOCUS_TRANSFER_SRGB;
    test::SetFeature(STARFOCUS_FEATURE_STREAMING, round % 2, &config.features);
    config.max_workers = 2;
    test::SetFeature(STARFOCUS_FEATURE_SHAPES, round % 5 == 4, &config.features);
    config.highlights = round % 5 == 3 ? 4.0F : 1.0F;
    config.previews = 3;
    CAPTURE(round);
    ++round;
    Prepared prepared(scene, config);
    const starfocus_callbacks callbacks = test::RunBy(test::RunOnTwo);
    REQUIRE(starfocus_set_callbacks(prepared.engine.get(), &callbacks) == STARFOCUS_OK);
    const starfocus::Params whole = test::Params(offset - 3, 1, STARFOCUS_MODE_BLOCK);
    const test::Output before = test::OutputOf(&prepared.engine, whole, scene);
    for (int shift = 1; shift <= 3; ++shift) {
      CAPTURE(shift);
      const test::Scene reduced = Reduced(scene, shift, config.transfer);
      for (int lens = 0; lens < test::Rounds(4); ++lens) {
        starfocus::Params params =
            test::Params(offset + random.Real(-12, 12), random.Real(0.3, 1), STARFOCUS_MODE_BLOCK);
        params.study.renderer = random.Int(0, 2);
        if (test::Has(config.features, STARFOCUS_FEATURE_SHAPES)) params.cats_eye = 0.5;
        if (lens == 2)
          params.study.mode = random.Int(0, 1) == 0 ? STARFOCUS_MODE_FRAME : STARFOCUS_MODE_BLUR;
        if (lens % 2 == 1) {
          params.focus_nearer = 3;
          params.focus_farther = 1.5;
        }
        if (lens == 3) {
          params.region = {random.Int(0, size[0] - 1), random.Int(0, size[1] - 1), 1, 1};
          params.region.width = random.Int(1, size[0] - params.region.x);
          params.region.height = random.Int(1, size[1] - params.region.y);
        }
        CHECK(IsOfReduced(&prepared, params, shift, config, reduced));
      }
    }
    // A preview does not change the engine of the full picture.
    CHECK(test::OutputOf(&prepared.engine, whole, scene).bytes == before.bytes);
  }
}

TEST_CASE("preview: the memory has the documented size") {
  const test::Scene scene = test::LayeredScene(800, 640, 5, 7, 11);
  test::Config config = test::ConfigFor(scene, 20);
  constexpr double kExpected[] = {3.89, 8.40, 9.52, 9.81};
  for (int previews = 0; previews <= 3; ++previews) {
    config.previews = previews;
    const size_t bytes = test::PreparedMemory(config).bytes;
    CHECK(double(bytes) / (800.0 * 640) == doctest::Approx(kExpected[previews]).epsilon(0.01));
  }
}

TEST_CASE("preview: the light field must be prepared for previews, the engine need not be") {
  const test::Scene scene = test::LayeredScene(50, 40, 5, 3, 12);
  test::Config config = test::ConfigFor(scene, 8);
  Prepared without(scene, config);
  config.previews = 2;
  Prepared with(scene, config);
  const starfocus::Params params = test::Params(1);
  test::Output out(25, 20);
  const auto run = [&](const Prepared& engine, const Prepared& field) {
    return test::PreviewRgb(engine.engine.get(), &params, field.field, 1, out.bytes.data(),
                            out.stride, nullptr);
  };
  CHECK(run(with, without) == STARFOCUS_ERROR_PREPARED);
  CHECK(out.Untouched());
  CHECK(run(without, with) == STARFOCUS_OK);
}

}  // namespace
}  // namespace preview_test
