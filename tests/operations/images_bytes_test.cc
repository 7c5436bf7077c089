// SPDX-License-Identifier: Apache-2.0
// Tests the refocusing of images and depth maps of every format. The result must be equal to the
// result of images that are converted to R, G, B before refocusing.
#include <doctest/doctest.h>

#include <vector>

#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/image_field.h"
#include "tests/support/prepared_memory.h"
#include "tests/support/rounds.h"

namespace images_bytes_test {
namespace {

using test::ImageField;
using test::ImageKind;
using test::ImageMemory;

constexpr int kFormats = 8, kTypes = 5;
constexpr int kAllViews[] = {1, 5, 9, 17};

ImageField AnyField(const test::Scene& scene, int format, int round, test::Random* random) {
  std::vector<ImageKind> kinds = {test::AnyKind(format, random)};
  for (int k = 0; k < 2; ++k) kinds.push_back(test::AnyKind(random->Int(0, kFormats - 1), random));
  const bool whole = round % 5 == 0;
  return test::MakeImageField(
      scene, kinds,
      test::MakeDepth(scene, whole ? scene.width : random->Int(1, scene.width),
                      whole ? scene.height : random->Int(1, scene.height),
                      starfocus_depth_type(round % kTypes),
                      starfocus_depth_meaning(round / kTypes % 2), random->Int(0, 5)),
      random);
}

// Checks that images and their conversions to R, G, B are refocused to equal bytes: whole,
// prepared, as previews and streamed.
void CheckSame(const ImageField& field, test::Config config, const starfocus::Params& params,
               const ImageKind& kind, test::Random* random, starfocus_runner runner = nullptr) {
  config.features |= STARFOCUS_FEATURE_STREAMING;
  test::Engine engine(config);
  const starfocus_region& r = params.region;
  const int width = r.width > 0 ? r.width : config.width;
  const int height = r.height > 0 ? r.height : config.height;
  ImageMemory got(width, height, kind);
  const starfocus_light_field images = field.Field();
  const starfocus_image out = got.Out();
  test::Report report, expected_report;
  const starfocus_callbacks callbacks = test::RunBy(runner);
  REQUIRE(starfocus_set_callbacks(engine.get(), &callbacks) == STARFOCUS_OK);
  REQUIRE(starfocus_refocus(engine.get(), &params, &images, &out, &report) == STARFOCUS_OK);
  test::Output expected(width, height);
  REQUIRE(test::Refocus(&engine, params, field.converted, &expected, callbacks, &expected_report) ==
          STARFOCUS_OK);
  CHECK((got == field.Converted(expected, kind, r.x, r.y)));
  CHECK(report.unknown_pixels == expected_report.unknown_pixels);
  CHECK(report.n == expected_report.n);
  test::PreparedMemory memory(engine), other(engine);
  const starfocus_prepared* prepared = memory.Prepare(engine.get(), images);
  ImageMemory again(width, height, kind);
  const starfocus_image to = again.Out();
  REQUIRE(starfocus_refocus_prepared(engine.get(), &params, prepared, &to, &report) ==
          STARFOCUS_OK);
  CHECK((again == got));
  if (r.width > 0) return;
  const starfocus_prepared* plain = other.Prepare(engine.get(), field.converted.Field());
  for (int shift = 1; shift <= config.previews; ++shift) {
    test::Output reduced((width + (1 << shift) - 1) >> shift, (height + (1 << shift) - 1) >> shift);
    REQUIRE(test::PreviewRgb(engine.get(), &params, plain, shift, reduced.bytes.data(),
                             reduced.stride, nullptr) == STARFOCUS_OK);
    ImageMemory wanted(reduced.width, reduced.height, kind), preview = wanted;
    test::PutPicture(
        reduced.bytes.data(), reduced.stride, [](int, int) { return uint8_t{255}; }, &wanted);
    const starfocus_image image = preview.Out();
    REQUIRE(test::Preview(engine.get(), &params, prepared, shift, &image, nullptr) == STARFOCUS_OK);
    CHECK((preview == wanted));
  }
  ImageMemory streamed(width, height, kind);
  REQUIRE(test::Stream(&engine, field, params, 2 * random->Int(1, 30), 2 * random->Int(1, 50),
                       &streamed, &report) == STARFOCUS_OK);
  CHECK((streamed == got));
  CHECK(report.unknown_pixels == expected_report.unknown_pixels);
}

TEST_CASE(
    "images: in every mode and format, the result equals the result for pictures converted to R, "
    "G, B") {
  test::Random random(24);
  constexpr int kSizes[][2] = {{1, 1},   {2, 2},    {1, 77},   {131, 1}, {33, 31},
                               {64, 64}, {101, 67}, {150, 91}, {97, 130}};
  for (int round = 0; round < (test::kSlow ? 1 : 3) * kFormats; ++round) {
    CAPTURE(round);
    const auto& size = kSizes[round % 9];
    const test::Scene scene =
        test::LayeredScene(size[0], size[1], kAllViews[round % 4], 7, uint64_t(round) + 1);
    const ImageField field = AnyField(scene, round % kFormats, round, &random);
    test::Config config = test::ImageConfig(field);
    config.superblock = 32 << random.Int(0, 3);
    config.max_workers = 2;
    config.previews = 2;
    config.transfer = round % 7 == 6 ? STARFOCUS_TRANSFER_NONE : STARFOCUS_TRANSFER_SRGB;
    const starfocus_mode mode = round % 6 == 4   ? STARFOCUS_MODE_FRAME
                                : round % 6 == 5 ? STARFOCUS_MODE_BLUR
                                                 : STARFOCUS_MODE_BLOCK;
    starfocus::Params params = test::Params(random.Real(-9, 9), random.Real(0.3, 1), mode);
    params.study.renderer = random.Int(0, 2);
    const ImageKind kind = test::AnyKind((round * 3 + round / kFormats) % kFormats, &random);
    CheckSame(field, config, params, kind, &random, round % 2 == 0 ? nullptr : test::RunOnTwo);
  }
}

TEST_CASE(
    "images: regions with odd positions and sizes equal regions of pictures converted to R, G, B") {
  test::Random random(25);
  const test::Scene scene = test::LayeredScene(141, 163, 5, 7, 9);
  for (int round = 0; round < (test::kSlow ? 1 : 2) * kFormats; ++round) {
    CAPTURE(round);
    const ImageField field = AnyField(scene, round % kFormats, round, &random);
    test::Config config = test::ImageConfig(field);
    config.superblock = 32 << random.Int(0, 1);
    config.max_workers = 2;
    starfocus::Params params = test::Params(random.Real(-9, 9), 1, STARFOCUS_MODE_BLOCK);
    starfocus_region& region = params.region;
    region = {random.Int(0, 60), random.Int(0, 40), 1, 1};
    region.width = random.Int(1, scene.width - region.x);
    region.height = round % 3 == 0 ? random.Int(1, 9) : random.Int(1, scene.height - region.y);
    const ImageKind kind = test::AnyKind((round + 4) % kFormats, &random);
    CheckSame(field, config, params, kind, &random, round % 2 == 0 ? nullptr : test::RunOnTwo);
  }
}

TEST_CASE(
    "images: with near surfaces, the result equals the result for pictures converted to R, G, B") {
  test::Random random(26);
  for (const int views : {5, 17}) {
    for (const int renderer : {STARFOCUS_RENDERER_SLICES, STARFOCUS_RENDERER_LINE_SCAN}) {
      const test::Scene scene = test::NearScene(173, 122, views, 3);
      const ImageField field = AnyField(scene, STARFOCUS_FORMAT_NV12, 0, &random);
      test::Config config = test::ImageConfig(field, 8);
      starfocus::Params params =
          test::Params(test::kNearFocus, 0.2, STARFOCUS_MODE_BLOCK, renderer);
      CheckSame(field, config, params, test::AnyKind(STARFOCUS_FORMAT_I420, &random), &random);
    }
  }
}

TEST_CASE("images: highlights of lamps equal the highlights of pictures converted to R, G, B") {
  test::Random random(27);
  test::Scene scene = test::LayeredScene(140, 110, 5, 7, 12);
  for (int lamp = 0; lamp < 12; ++lamp) {
    const int x = random.Int(0, 130), y = random.Int(0, 100), size = random.Int(1, 9);
    for (int view = 0; view < 5; ++view) {
      for (int k = 0; k < size * size; ++k) {
        for (int c = 0; c < 3; ++c) scene.Pixel(view, x + k % size, y + k / size)[c] = 255;
      }
    }
  }
  for (const starfocus_mode mode : {STARFOCUS_MODE_BLOCK, STARFOCUS_MODE_BLUR}) {
    const ImageField field = AnyField(scene, STARFOCUS_FORMAT_NV21, 5, &random);
    test::Config config = test::ImageConfig(field);
    config.highlights = 8;
    config.superblock = 32;
    CheckSame(field, config, test::Params(5, 1, mode),
              test::AnyKind(STARFOCUS_FORMAT_BGRX, &random), &random);
  }
}

TEST_CASE("images: depth maps may have any type, meaning and size, and unknown values") {
  test::Random random(28);
  const test::Scene scene = test::LayeredScene(130, 97, 5, 7, 4);
  const int sizes[][2] = {{130, 97}, {65, 49}, {33, 97}, {130, 25}, {1, 1}, {44, 2}};
  for (int round = 0; round < 6 * kTypes * 2; ++round) {
    CAPTURE(round);
    const auto& size = sizes[round / (2 * kTypes)];
    const auto type = starfocus_depth_type(round % kTypes);
    test::DepthMemory depth = test::MakeDepth(
        scene, size[0], size[1], type, starfocus_depth_meaning(round / kTypes % 2), round % 3);
    depth.map.has_invalid = 1;
    depth.map.invalid = type == STARFOCUS_DEPTH_U16 ? 65535 : 255;
    const bool unknown = round % 3 != 2;
    if (unknown) {
      for (int k = 0; k < 1 + size[0] * size[1] / 20; ++k) {
        const int x = random.Int(0, size[0] - 1), y = random.Int(0, size[1] - 1);
        const bool not_a_number = type == STARFOCUS_DEPTH_FLOAT || type == STARFOCUS_DEPTH_HALF;
        depth.Put(
            x, y,
            not_a_number ? std::numeric_limits<double>::quiet_NaN() : double(depth.map.invalid));
      }
    } else {
      depth.map.invalid = 254.5f;
    }
    const ImageField field = test::MakeImageField(
        scene, {test::AnyKind(STARFOCUS_FORMAT_NV12, &random)}, depth, &random);
    test::Config config = test::ImageConfig(field);
    config.superblock = 32;
    config.unknown = STARFOCUS_UNKNOWN_FILL;
    const starfocus::Params params = test::Params(2, 1, STARFOCUS_MODE_BLOCK);
    CheckSame(field, config, params, test::AnyKind(STARFOCUS_FORMAT_NV12, &random), &random);
    config.unknown = STARFOCUS_UNKNOWN_REFUSE;
    test::Engine engine(config);
    ImageMemory out(130, 97, test::AnyKind(STARFOCUS_FORMAT_RGB, &random)), before = out;
    const starfocus_light_field images = field.Field();
    const starfocus_image to = out.Out();
    const starfocus_status status = starfocus_refocus(engine.get(), &params, &images, &to, nullptr);
    CHECK(status == (unknown ? STARFOCUS_ERROR_NOT_FINITE : STARFOCUS_OK));
    const bool untouched = out == before;
    CHECK(untouched == unknown);
  }
}

TEST_CASE(
    "images: a depth value outside the configured range is rejected before anything is written") {
  test::Random random(29);
  const test::Scene scene = test::LayeredScene(70, 60, 1, 7, 4);
  ImageField field = AnyField(scene, STARFOCUS_FORMAT_I420, 4, &random);
  const test::Config config = test::ImageConfig(field);
  starfocus_depth_map& map = field.depth.map;
  field.depth = test::MakeDepth(scene, 30, 20, STARFOCUS_DEPTH_U16, STARFOCUS_DEPTH_RECIPROCAL, 0);
  field.depth.Put(29, 19, 1);
  map.data = field.depth.words.data();
  test::Engine engine(config);
  ImageMemory out(70, 60, test::AnyKind(STARFOCUS_FORMAT_NV12, &random)), before = out;
  const starfocus_light_field images = field.Field();
  const starfocus_image to = out.Out();
  const starfocus::Params params = test::Params(2, 1, STARFOCUS_MODE_BLOCK);
  CHECK(starfocus_refocus(engine.get(), &params, &images, &to, nullptr) ==
        STARFOCUS_ERROR_DISPARITY);
  const bool untouched = out == before;
  CHECK(untouched);
}

}  // namespace
}  // namespace images_bytes_test
