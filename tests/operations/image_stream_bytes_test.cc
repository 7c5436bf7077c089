// SPDX-License-Identifier: Apache-2.0
// Tests the streaming and preparing of images. The resulting bytes must equal the bytes from
// starfocus_refocus.
#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/image_field.h"
#include "tests/support/inside.h"
#include "tests/support/prepared_memory.h"
#include "tests/support/refocused.h"
#include "tests/support/watch.h"

namespace image_stream_bytes_test {
namespace {

using test::ImageField;
using test::ImageKind;
using test::ImageMemory;

constexpr int kFormats = 8;

ImageField FieldOf(const test::Scene& scene, int format, bool unknown, test::Random* random,
                   bool all_rows = false) {
  std::vector<ImageKind> kinds;
  for (int k = 0; k < 3; ++k) kinds.push_back(test::AnyKind((format + 3 * k) % kFormats, random));
  test::DepthMemory depth = test::MakeDepth(scene, (scene.width + 1) / 2,
                                            all_rows ? scene.height : (scene.height + 2) / 3,
                                            STARFOCUS_DEPTH_HALF, STARFOCUS_DEPTH_RECIPROCAL, 1);
  if (unknown) depth.Put(0, depth.map.height / 2, std::numeric_limits<double>::quiet_NaN());
  return test::MakeImageField(scene, kinds, std::move(depth), random);
}

ImageMemory Refocused(test::Engine* engine, const ImageField& field,
                      const starfocus::Params& params, const ImageKind& kind,
                      starfocus_report* report) {
  ImageMemory image(field.converted.width, field.converted.height, kind);
  const starfocus_light_field images = field.Field();
  const starfocus_image out = image.Out();
  REQUIRE(starfocus_refocus(engine->get(), &params, &images, &out, report) == STARFOCUS_OK);
  return image;
}

TEST_CASE("image streams: rows of R, G, B may be pushed and pulled") {
  test::Random random(42);
  const test::Scene scene = test::LayeredScene(100, 90, 5, 7, 50);
  const ImageField field = FieldOf(scene, STARFOCUS_FORMAT_RGBX, false, &random);
  test::Config config = test::ImageConfig(field, 20);
  config.features |= STARFOCUS_FEATURE_STREAMING;
  test::Engine engine(config);
  ImageKind kind;
  kind.format = STARFOCUS_FORMAT_BGRX;
  const starfocus::Params params = test::Params(1, 1, STARFOCUS_MODE_BLOCK);
  test::Output got(100, 90);
  const test::Output expected = test::OutputOf(&engine, params, field.converted);
  ImageMemory image(100, 90, kind), opaque(100, 90, kind);
  test::PutPicture(
      expected.bytes.data(), expected.stride, [](int, int) { return uint8_t{255}; }, &opaque);
  const starfocus_image out = image.Out();
  const starfocus_light_field images = field.Field();
  const starfocus_light_field converted = field.converted.Field();
  int32_t rows = 0;
  // The alpha of the previous stream must not appear in the output.
  for (int round = 0; round < 2; ++round) {
    REQUIRE(starfocus_stream_begin(engine.get(), &params) == STARFOCUS_OK);
    REQUIRE(starfocus_stream_push(engine.get(), &images, 90, &rows) == STARFOCUS_OK);
    REQUIRE(rows == 90);
    REQUIRE(test::PullRgb(engine.get(), got.bytes.data(), got.stride, 90, &rows, nullptr) ==
            STARFOCUS_OK);
    CHECK(got.bytes == expected.bytes);
    REQUIRE(starfocus_stream_begin(engine.get(), &params) == STARFOCUS_OK);
    REQUIRE(starfocus_stream_push(engine.get(), &converted, 90, &rows) == STARFOCUS_OK);
    REQUIRE(starfocus_stream_pull(engine.get(), &out, 90, &rows, nullptr) == STARFOCUS_OK);
    CHECK((image == opaque));
  }
}

TEST_CASE("image streams: alpha is copied to the output even if the rows are pulled late") {
  test::Random random(48);
  test::Scene scene = test::LayeredScene(20, 900, 1, 1, 50);
  const ImageField field = FieldOf(scene, STARFOCUS_FORMAT_RGBX, false, &random);
  test::Config config = test::ImageConfig(field, 2);
  config.features |= STARFOCUS_FEATURE_STREAMING;
  config.superblock = 256;
  test::Engine engine(config);
  ImageKind kind;
  kind.format = STARFOCUS_FORMAT_RGBX;
  const starfocus::Params params = test::Params(0, 1, STARFOCUS_MODE_BLOCK);
  const ImageMemory expected = Refocused(&engine, field, params, kind, nullptr);
  ImageMemory streamed(20, 900, kind);
  REQUIRE(test::Stream(&engine, field, params, 900, 2, &streamed, nullptr) == STARFOCUS_OK);
  CHECK((streamed == expected));
}

TEST_CASE("image streams: after a cancelled pull, a repeated pull returns the remaining rows") {
  test::Random random(51);
  const ImageField field =
      FieldOf(test::LayeredScene(70, 100, 1, 7, 50), STARFOCUS_FORMAT_RGBX, false, &random);
  test::Config config = test::ImageConfig(field, 20);
  config.features |= STARFOCUS_FEATURE_STREAMING;
  config.superblock = 32;
  test::Engine engine(config);
  const starfocus::Params params = test::Params(1, 1, STARFOCUS_MODE_BLOCK);
  const ImageKind kind = test::AnyKind(STARFOCUS_FORMAT_NV12, &random);
  const ImageMemory expected = Refocused(&engine, field, params, kind, nullptr);
  bool ended = false;
  for (int stop = 0; !ended; ++stop) {
    CAPTURE(stop);
    test::Watch watch(stop);
    starfocus_callbacks callbacks = {};
    callbacks.progress = test::Watch::Progress;
    callbacks.progress_data = &watch;
    REQUIRE(starfocus_set_callbacks(engine.get(), &callbacks) == STARFOCUS_OK);
    REQUIRE(starfocus_stream_begin(engine.get(), &params) == STARFOCUS_OK);
    ImageMemory image(70, 100, kind);
    int cancelled = 0;
    for (int32_t pushed = 0, pulled = 0; pulled < 100;) {
      int32_t consumed = 0, written = 0;
      const starfocus_light_field rows = field.Field(pushed);
      if (pushed < 100) {
        REQUIRE(starfocus_stream_push(engine.get(), &rows, 100 - pushed, &consumed) ==
                STARFOCUS_OK);
      }
      const starfocus_image out = image.Out(pulled);
      const starfocus_status status =
          starfocus_stream_pull(engine.get(), &out, 100 - pulled, &written, nullptr);
      cancelled += status == STARFOCUS_ERROR_CANCELLED ? 1 : 0;
      REQUIRE(cancelled <= 1);
      REQUIRE((status == STARFOCUS_OK || status == STARFOCUS_ERROR_CANCELLED));
      pushed += consumed;
      pulled += written;
    }
    CHECK((image == expected));
    ended = cancelled == 0;
  }
}

TEST_CASE("image streams: ring buffers hold an even number of rows for every disparity range") {
  test::Random random(49);
  const ImageField field =
      FieldOf(test::LayeredScene(20, 20, 1, 1, 50), STARFOCUS_FORMAT_RGB, false, &random);
  test::Config config = test::ImageConfig(field, 2);
  for (float most = 3; most < 12; most += 0.5f) {
    config.disparity_max = most;
    const starfocus::Borders borders = test::BordersOf(config);
    CHECK(borders.streamed % 2 == 0);
    CHECK(borders.streamed >= borders.views);
  }
}

TEST_CASE(
    "image streams: odd numbers of rows are rejected, and a bad depth rejects both rows of a "
    "pair") {
  test::Random random(43);
  const test::Scene scene = test::LayeredScene(60, 51, 1, 7, 50);
  ImageField field = FieldOf(scene, STARFOCUS_FORMAT_NV12, false, &random);
  test::Config config = test::ImageConfig(field, 20);
  config.features |= STARFOCUS_FEATURE_STREAMING;
  test::Engine engine(config);
  const starfocus::Params params = test::Params(1, 1, STARFOCUS_MODE_BLOCK);
  starfocus_light_field images = field.Field();
  ImageMemory image(60, 51, test::AnyKind(STARFOCUS_FORMAT_I420, &random));
  starfocus_image out = image.Out();
  int32_t rows = 7;
  CHECK(starfocus_stream_push(engine.get(), &images, 2, &rows) == STARFOCUS_ERROR_STATE);
  CHECK(rows == 0);
  REQUIRE(starfocus_stream_begin(engine.get(), &params) == STARFOCUS_OK);
  CHECK(starfocus_stream_push(engine.get(), &images, 3, &rows) == STARFOCUS_ERROR_RANGE);
  CHECK(starfocus_stream_push(engine.get(), &images, 52, &rows) == STARFOCUS_ERROR_RANGE);
  CHECK(starfocus_stream_push(engine.get(), &images, 51, &rows) == STARFOCUS_OK);
  CHECK(rows == 51);
  CHECK(starfocus_stream_pull(engine.get(), &out, 3, &rows, nullptr) == STARFOCUS_ERROR_RANGE);
  CHECK(starfocus_stream_pull(engine.get(), &out, 50, &rows, nullptr) == STARFOCUS_OK);
  CHECK(rows == 50);
  out = image.Out(50);
  CHECK(starfocus_stream_pull(engine.get(), &out, 9, &rows, nullptr) == STARFOCUS_OK);
  CHECK(rows == 1);
  // The last row of the depth map holds a bad value. The engine consumes only the pairs of rows
  // before the last row.
  field.depth.Put(3, field.depth.map.height - 1, 1e-3);
  images = field.Field();
  REQUIRE(starfocus_stream_begin(engine.get(), &params) == STARFOCUS_OK);
  CHECK(starfocus_stream_push(engine.get(), &images, 51, &rows) == STARFOCUS_ERROR_DISPARITY);
  CHECK(starfocus_engine_problem(engine.get())->x == 3);
  CHECK(starfocus_engine_problem(engine.get())->y == field.depth.map.height - 1);
  CHECK(rows > 20);
  CHECK(rows < 51);
  CHECK(rows % 2 == 0);
}

TEST_CASE(
    "prepared images: disparities and layers equal the results for pictures converted to R, G, B") {
  test::Random random(47);
  for (const int side : {32, 64, 128}) {
    CAPTURE(side);
    const test::Scene scene = test::LayeredScene(150, 271, 1, 7, 60);
    const ImageField field = FieldOf(scene, STARFOCUS_FORMAT_NV12, false, &random);
    test::Config config = test::ImageConfig(field, 20);
    config.superblock = side;
    test::Engine engine(config);
    test::PreparedMemory memory(engine), other(engine);
    const starfocus_prepared* got = memory.Prepare(engine.get(), field.Field());
    const starfocus_prepared* expected = other.Prepare(engine.get(), field.converted.Field());
    const auto& a = *reinterpret_cast<const starfocus::Prepared*>(got);
    const auto& b = *reinterpret_cast<const starfocus::Prepared*>(expected);
    const auto same = [](const auto& one, const auto& two, int rows) {
      return std::equal(one.data, one.data + one.stride * size_t(rows), two.data);
    };
    CHECK(same(a.disparity, b.disparity, 271));
    CHECK(same(a.layers[1], b.layers[1], 136));
    CHECK(same(a.layers[2], b.layers[2], 68));
  }
}

TEST_CASE(
    "prepared images: light fields of any format can be refocused to pictures of any format") {
  test::Random random(45);
  const test::Scene scene = test::LayeredScene(60, 50, 5, 7, 50);
  const ImageField field = FieldOf(scene, STARFOCUS_FORMAT_NV12, false, &random);
  const test::Config config = test::ImageConfig(field, 20);
  test::Engine engine(config);
  test::PreparedMemory memory(engine), other(engine);
  const starfocus_prepared* of_images = memory.Prepare(engine.get(), field.Field());
  const starfocus_prepared* of_pictures = other.Prepare(engine.get(), field.converted.Field());
  const starfocus::Params params = test::Params(1, 1, STARFOCUS_MODE_BLOCK);
  test::Output out(60, 50);
  ImageMemory image(60, 50, test::AnyKind(STARFOCUS_FORMAT_NV12, &random));
  const starfocus_image to = image.Out();
  REQUIRE(test::RefocusPreparedRgb(engine.get(), &params, of_images, out.bytes.data(), out.stride,
                                   nullptr) == STARFOCUS_OK);
  const test::Output of_rgb = test::OutputOf(&engine, params, field.converted);
  CHECK(out.bytes == of_rgb.bytes);
  REQUIRE(starfocus_refocus_prepared(engine.get(), &params, of_pictures, &to, nullptr) ==
          STARFOCUS_OK);
  CHECK(image == field.Converted(out, image.kind()));
}

}  // namespace
}  // namespace image_stream_bytes_test
