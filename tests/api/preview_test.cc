// SPDX-License-Identifier: Apache-2.0
// Tests previews. A preview must equal the picture refocused from a reduced light field, byte for
// byte. A preview must be close to the refocused full picture, reduced to the size of the preview.
// Functions for previews must reject bad input.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "lib/base/transfer.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/layered_scene.h"
#include "tests/support/prepared_memory.h"
#include "tests/support/refocused.h"
#include "tests/support/rounds.h"

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
class Prepared {
 public:
  Prepared(const test::Scene& scene, const test::Config& config, starfocus_runner runner = nullptr)
      : engine(config), memory(engine), scene_(scene) {
    const starfocus_callbacks callbacks = test::RunBy(runner);
    REQUIRE(starfocus_set_callbacks(engine.get(), &callbacks) == STARFOCUS_OK);
    field_ = memory.Prepare(engine.get(), scene.Field());
  }

  starfocus_status Preview(const starfocus::Params& params, int shift, test::Output* out,
                           const starfocus_callbacks& callbacks = {},
                           starfocus_report* report = nullptr) {
    const starfocus_status status = starfocus_set_callbacks(engine.get(), &callbacks);
    if (status != STARFOCUS_OK) return status;
    return test::PreviewRgb(engine.get(), &params, field_, shift, out->bytes.data(), out->stride,
                            report);
  }
  // Returns the preview of the whole picture or of params.region.
  test::Output Preview(const starfocus::Params& params, int shift,
                       const starfocus_callbacks& callbacks = {},
                       starfocus_report* report = nullptr) {
    const starfocus_region region = ReducedRegion(params.region, shift);
    const bool whole = region.width == 0;
    test::Output out(whole ? Ceil(scene_.width, shift) : region.width,
                     whole ? Ceil(scene_.height, shift) : region.height, 3);
    REQUIRE(Preview(params, shift, &out, callbacks, report) == STARFOCUS_OK);
    return out;
  }
  const starfocus_prepared* field() const { return field_; }

  test::Engine engine;
  test::PreparedMemory memory;

 private:
  const test::Scene& scene_;
  starfocus_prepared* field_ = nullptr;
};

// Returns the PSNR in dB between a preview and the full picture, reduced to the size of the
// preview.
double Psnr(const test::Output& got, const test::Output& full, int shift, int32_t transfer) {
  double sum = 0;
  for (int y = 0; y < got.height; ++y) {
    for (int x = 0; x < got.width; ++x) {
      for (int c = 0; c < 3; ++c) {
        const double error =
            double(got.Pixel(x, y)[c]) - MeanSample(full.bytes.data(), full.stride, full.width,
                                                    full.height, x, y, c, shift, transfer);
        sum += error * error;
      }
    }
  }
  return 10 * std::log10(255.0 * 255 * 3 * got.width * got.height / sum);
}

// Returns true if a preview has the same bytes as the refocused light field `reduced`.
bool IsOfReduced(Prepared* prepared, starfocus::Params params, int shift,
                 const test::Config& config, const test::Scene& reduced) {
  starfocus_report report = starfocus::NewReport();
  const test::Output got = prepared->Preview(params, shift, test::RunBy(test::RunOnTwo), &report);
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
  constexpr int kSizes[][2] = {{1, 1},    {1, 70},   {90, 1},    {31, 33},   {65, 63},
                               {100, 37}, {67, 190}, {129, 128}, {150, 141}, {203, 90}};
  int round = 0;
  for (const auto& size : kSizes) {
    const test::Scene scene =
        test::LayeredScene(size[0], size[1], test::kStars[round % 4], 7, uint64_t(round) + 90);
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
    Prepared prepared(scene, config, test::RunOnTwo);
    for (int shift = 1; shift <= 3; ++shift) {
      CAPTURE(shift);
      const test::Scene reduced = Reduced(scene, shift, config.transfer);
      for (int lens = 0; lens < test::Rounds(4); ++lens) {
        starfocus::Params params =
            test::Params(random.Real(-12, 12), random.Real(0.3, 1), STARFOCUS_MODE_BLOCK);
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
  }
}

// If the disparity range does not contain 0, the range of the preview is partly or wholly outside
// the full picture's range.
TEST_CASE("preview: a streaming engine accepts scenes whose disparities all have one sign") {
  for (const float offset : {16.0F, -12.0F, 4.5F}) {
    CAPTURE(offset);
    test::Scene scene = test::LayeredScene(330, 270, 5, 4, 17);
    scene.disparity_min += offset;
    scene.disparity_max += offset;
    for (int y = 0; y < scene.height; ++y) {
      for (int x = 0; x < scene.width; ++x) scene.Disparity(x, y) += offset;
    }
    test::Config config = test::ConfigFor(scene, 8);
    config.superblock = 32;
    config.features |= STARFOCUS_FEATURE_STREAMING;
    config.max_workers = 2;
    config.previews = 3;
    Prepared prepared(scene, config, test::RunOnTwo);
    for (int shift = 1; shift <= 3; ++shift) {
      CAPTURE(shift);
      const test::Scene reduced = Reduced(scene, shift, config.transfer);
      const starfocus::Params params = test::Params(offset + 1, 1, STARFOCUS_MODE_BLOCK);
      CHECK(IsOfReduced(&prepared, params, shift, config, reduced));
    }
  }
}

TEST_CASE("preview: previews neither change the engine nor need a larger workspace") {
  const test::Scene scene = test::LayeredScene(170, 130, 5, 7, 3);
  test::Config config = test::ConfigFor(scene, 20);
  config.features |= STARFOCUS_FEATURE_STREAMING;
  size_t without = 0, with = 0;
  REQUIRE(starfocus_workspace_size(&config, &without, nullptr) == STARFOCUS_OK);
  config.previews = 3;
  REQUIRE(starfocus_workspace_size(&config, &with, nullptr) == STARFOCUS_OK);
  CHECK(with == without);
  Prepared prepared(scene, config);
  const starfocus::Params params = test::Params(-3, 1, STARFOCUS_MODE_BLOCK);
  test::Output streamed(170, 130);
  const test::Output before = test::OutputOf(&prepared.engine, params, scene);
  const test::Output first = prepared.Preview(test::Params(5, 1, STARFOCUS_MODE_BLOCK), 2);
  const test::Output after = test::OutputOf(&prepared.engine, params, scene);
  CHECK(after.bytes == before.bytes);
  // A preview ends a stream, which the caller must then begin again.
  REQUIRE(starfocus_stream_begin(prepared.engine.get(), &params) == STARFOCUS_OK);
  const test::Output again = prepared.Preview(test::Params(5, 1, STARFOCUS_MODE_BLOCK), 2);
  CHECK(again.bytes == first.bytes);
  int32_t written = 0;
  CHECK(test::PullRgb(prepared.engine.get(), streamed.bytes.data(), streamed.stride, 1, &written,
                      nullptr) == STARFOCUS_ERROR_STATE);
  REQUIRE(test::Stream(&prepared.engine, params, scene, &streamed, 9, 9) == STARFOCUS_OK);
  CHECK(streamed.bytes == before.bytes);
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

// Returns a wall and a nearer disc, both with waves. All views show one consistent scene.
test::Scene SmoothScene(int width, int height) {
  test::Scene scene = test::EmptyScene(width, height, 5, -12, 12);
  for (int view = 0; view < 5; ++view) {
    double u = 0, v = 0;
    starfocus_view_position(view, &u, &v, nullptr);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const double nx = x + 9 * u - 0.5 * width, ny = y + 9 * v - 0.5 * height;
        const bool nearer = nx * nx + ny * ny < 0.06 * width * width;
        const double d = nearer ? 9 : -9, px = x + u * d, py = y + v * d;
        for (int c = 0; c < 3; ++c) {
          const double wave = std::sin(px / (9 + c)) + std::cos(py / 11 + px / 40);
          scene.Pixel(view, x, y)[c] = uint8_t((nearer ? 150 : 90) + 35 * wave);
        }
        if (view == 0) scene.Disparity(x, y) = float(d);
      }
    }
  }
  return scene;
}

TEST_CASE("preview: the preview is close to the full picture, reduced to the size of the preview") {
  const test::Scene scene = SmoothScene(512, 384);
  test::Config config = test::ConfigFor(scene, 24);
  config.previews = 3;
  Prepared prepared(scene, config);
  // The PSNR of the smallest preview is low, since waves of 9 pixels hardly survive at 1/8 of the
  // size.
  constexpr double kLeast[] = {0, 53.5, 51.5, 43};
  for (const double focus : {9.0, 0.0, -9.0}) {
    const starfocus::Params params = test::Params(focus, 1, STARFOCUS_MODE_BLOCK);
    const test::Output full = test::OutputOf(&prepared.engine, params, scene);
    for (int shift = 1; shift <= 3; ++shift) {
      CAPTURES(focus, shift);
      CHECK(Psnr(prepared.Preview(params, shift), full, shift, config.transfer) >= kLeast[shift]);
    }
  }
}

TEST_CASE("preview: the light field must be prepared for previews by an engine of the same size") {
  const test::Scene scene = test::LayeredScene(50, 40, 5, 3, 12);
  test::Config config = test::ConfigFor(scene, 8);
  Prepared none(scene, config);
  config.previews = 2;
  Prepared prepared(scene, config);
  config.width = 49;
  test::Engine another(config);
  const starfocus::Params params = test::Params(1);
  test::Output out(25, 20);
  CHECK(none.Preview(params, 1, &out) == STARFOCUS_ERROR_PREPARED);
  const auto run = [&](const test::Engine& engine) {
    return test::PreviewRgb(engine.get(), &params, prepared.field(), 1, out.bytes.data(),
                            out.stride, nullptr);
  };
  CHECK(run(another) == STARFOCUS_ERROR_PREPARED);
  CHECK(out.Untouched());
  // The light field must be prepared for previews, but the engine may be configured without
  // previews.
  CHECK(run(none.engine) == STARFOCUS_OK);
}

}  // namespace
}  // namespace preview_test
