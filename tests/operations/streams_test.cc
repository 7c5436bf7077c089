// SPDX-License-Identifier: Apache-2.0
// Tests that a stream continues after a failed or cancelled pull, the memory of a stream, and the
// rows that a stream accepts. operations_bytes_test.cc tests the bytes of streams.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/operations/picture_operations.h"
#include "tests/support/inside.h"
#include "tests/support/refocused.h"

namespace streams_test {
namespace {

using namespace properties;
using test::ImageMemory;

// A progress function that cancels some calls.
struct Cancelling {
  int first, times = 1, calls = 0;

  static int Progress(void* data, int32_t, int32_t) {
    Cancelling& self = *static_cast<Cancelling*>(data);
    const int call = self.calls++;
    return call >= self.first && call < self.first + self.times;
  }
};

struct Stream {
  std::string name;
  Case of;
  Way way;
};

// Streams of every lens, of images, and in small portions.
std::vector<Stream> Streams() {
  std::vector<Stream> all;
  for (const Lens& lens : kLenses) {
    all.push_back({lens.name, CaseOf(lens), {Entry::kStream}});
  }
  for (const Lens& lens : {kBlocks, kBlur}) {
    Way way = {Entry::kStream};
    way.images = STARFOCUS_FORMAT_RGBX;
    way.kind.format = STARFOCUS_FORMAT_NV12;
    way.push = way.pull = 8;
    all.push_back({"images", CaseOf(lens), way});
  }
  return all;
}

// Interrupts a stream by a Trouble {first, times} for each `first`. Uses a new engine each time,
// since memory from an earlier stream could have the right contents by chance. Checks that repeated
// pulls return the bytes and the report of an undisturbed stream.
template <class Trouble, class Callbacks>
void CheckRetries(Stream stream, const Callbacks& callbacks_of) {
  CAPTURE(stream.name);
  Bytes expected;
  REQUIRE(Picture(stream.of, stream.way, {}).Ask({}, &expected) == STARFOCUS_OK);
  for (int first = 0;; first += test::kSlow ? 7 : 1 + first / 20) {
    CAPTURE(first);
    stream.way.pull = first % 2 == 0 ? kHeight + 1 : 8;
    Trouble trouble = {first, first % 3 == 0 ? 2 : 1};
    Picture picture(stream.of, stream.way, {});
    Bytes got;
    int retries = 0;
    REQUIRE(picture.Ask(callbacks_of(&trouble), &got, &retries) == STARFOCUS_OK);
    const size_t same =
        size_t(std::mismatch(got.begin(), got.end(), expected.begin()).first - got.begin());
    CAPTURE(same);
    CHECK(same == expected.size());
    if (retries > 0) continue;
    CHECK(first > 5);
    return;
  }
}

TEST_CASE("streams: after a failed runner, a repeated pull returns the remaining rows") {
  for (const Stream& stream : Streams()) {
    CheckRetries<FailingRunner>(
        stream, [](FailingRunner* runner) { return test::RunBy(FailingRunner::Run, runner); });
  }
}

TEST_CASE("streams: after a cancelled pull, a repeated pull returns the remaining rows") {
  for (const Stream& stream : Streams()) {
    CheckRetries<Cancelling>(
        stream, [](Cancelling* told) { return test::ToldTo(Cancelling::Progress, told); });
  }
}

TEST_CASE("streams: if starfocus_stream_begin is cancelled, no stream has begun") {
  Way way = {Entry::kStream};
  Picture picture(CaseOf(kBlur), way, {});  // in blur mode, starfocus_stream_begin makes the PSFs
  Cancelling told = {0};
  const starfocus_callbacks callbacks = test::ToldTo(Cancelling::Progress, &told);
  starfocus_engine* engine = picture.rig()->get();
  REQUIRE(starfocus_set_callbacks(engine, &callbacks) == STARFOCUS_OK);
  CHECK(starfocus_stream_begin(engine, &picture.asked().params) == STARFOCUS_ERROR_CANCELLED);
  CHECK(starfocus_engine_problem(engine)->status == STARFOCUS_ERROR_CANCELLED);
  const starfocus_light_field field = picture.Field();
  int32_t consumed = 0;
  CHECK(starfocus_stream_push(engine, &field, 1, &consumed) == STARFOCUS_ERROR_STATE);
}

TEST_CASE("streams: a picture of 20,000 rows fits the workspace of a picture of 200 rows") {
  constexpr int kColumns = 24, kTall = 20000;
  const test::Scene scene = test::RandomScene(kColumns, kTall, 17, -2, 2, 77);
  test::Config config = test::ConfigFor(scene);
  size_t tall_bytes = 0, low_bytes = 0;
  for (const bool streaming : {false, true}) {
    test::SetFeature(STARFOCUS_FEATURE_STREAMING, streaming, &config.features);
    config.height = kTall;
    REQUIRE(starfocus_workspace_size(&config, &tall_bytes, nullptr) == STARFOCUS_OK);
    config.height = 200;
    REQUIRE(starfocus_workspace_size(&config, &low_bytes, nullptr) == STARFOCUS_OK);
    CHECK(tall_bytes == low_bytes);
  }
  // The ring buffers hold fewer than 20,000 rows, so a single push must not consume all rows.
  config.height = kTall;
  test::Engine engine(config);
  REQUIRE(engine.bytes() == low_bytes);
  const starfocus::Params params = test::Params(0.5);
  REQUIRE(starfocus_stream_begin(engine.get(), &params) == STARFOCUS_OK);
  const starfocus_light_field field = scene.Field();
  int32_t consumed = 0;
  REQUIRE(starfocus_stream_push(engine.get(), &field, kTall, &consumed) == STARFOCUS_OK);
  CHECK(consumed > 0);
  CHECK(consumed < 2000);
  test::Output streamed(kColumns, kTall);
  REQUIRE(test::Stream(&engine, params, scene, &streamed, 100, 100) == STARFOCUS_OK);
  CHECK((streamed.bytes == test::OutputOf(config, params, scene).bytes));
}

TEST_CASE("streams: of images, rings hold an even number of rows for every range of disparities") {
  test::Config config = CaseOf(kBlocks).config;
  config.features |= STARFOCUS_FEATURE_STREAMING | STARFOCUS_FEATURE_IMAGES;
  for (float most = 3; most < 12; most += 0.5f) {
    config.disparity_max = most;
    const starfocus::Borders borders = test::BordersOf(config);
    CHECK(borders.streamed % 2 == 0);
    CHECK(borders.streamed >= borders.views);
  }
}

TEST_CASE("streams: the alpha of a stream does not appear in the next stream") {
  Way images = {Entry::kStream};
  images.images = STARFOCUS_FORMAT_RGBX;
  images.kind.format = STARFOCUS_FORMAT_BGRX;
  images.push = images.pull = 8;
  Picture picture(CaseOf(kBlocks), images, {});
  Bytes got;
  REQUIRE(picture.Ask({}, &got) == STARFOCUS_OK);
  ImageMemory image(kWidth, kHeight, images.kind);
  const starfocus_light_field field = picture.asked().scene.Field();
  const starfocus_image out = image.Out();
  int32_t rows = 0;
  REQUIRE(starfocus_stream_begin(picture.rig()->get(), &picture.asked().params) == STARFOCUS_OK);
  REQUIRE(starfocus_stream_push(picture.rig()->get(), &field, kHeight, &rows) == STARFOCUS_OK);
  REQUIRE(starfocus_stream_pull(picture.rig()->get(), &out, kHeight, &rows, nullptr) ==
          STARFOCUS_OK);
  REQUIRE(rows == kHeight);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) REQUIRE(*image.Colour(x, y, 3) == 255);
  }
}

TEST_CASE("streams: of images, odd numbers of rows are rejected, and a bad depth rejects a pair") {
  test::Random random(43);
  const test::Scene scene = test::LayeredScene(60, 51, 1, 7, 50);
  test::ImageField field = test::MakeImageField(
      scene, {test::AnyKind(STARFOCUS_FORMAT_NV12, &random)},
      test::MakeDepth(scene, 30, 17, STARFOCUS_DEPTH_HALF, STARFOCUS_DEPTH_RECIPROCAL, 1), &random);
  test::Config config = test::ImageConfig(field, 20);
  config.features |= STARFOCUS_FEATURE_STREAMING;
  test::Engine engine(config);
  const starfocus::Params params = test::Params(1, 1, STARFOCUS_MODE_BLOCK);
  starfocus_light_field images = field.Field();
  ImageMemory image(60, 51, test::AnyKind(STARFOCUS_FORMAT_I420, &random));
  int32_t rows = 7;
  const auto push = [&](int count) {
    return starfocus_stream_push(engine.get(), &images, count, &rows);
  };
  const auto pull = [&](int from, int count) {
    const starfocus_image out = image.Out(from);
    return starfocus_stream_pull(engine.get(), &out, count, &rows, nullptr);
  };
  CHECK(push(2) == STARFOCUS_ERROR_STATE);
  CHECK(rows == 0);
  REQUIRE(starfocus_stream_begin(engine.get(), &params) == STARFOCUS_OK);
  CHECK(push(3) == STARFOCUS_ERROR_RANGE);
  CHECK(push(52) == STARFOCUS_ERROR_RANGE);
  CHECK(push(51) == STARFOCUS_OK);
  CHECK(rows == 51);
  CHECK(pull(0, 3) == STARFOCUS_ERROR_RANGE);
  CHECK(pull(0, 50) == STARFOCUS_OK);
  CHECK(rows == 50);
  CHECK(pull(50, 9) == STARFOCUS_OK);
  CHECK(rows == 1);
  // The last row of the depth map holds a bad value. The engine consumes only the pairs of rows
  // before the last row.
  field.depth.Put(3, field.depth.map.height - 1, 1e-3);
  images = field.Field();
  REQUIRE(starfocus_stream_begin(engine.get(), &params) == STARFOCUS_OK);
  CHECK(push(51) == STARFOCUS_ERROR_DISPARITY);
  CHECK(starfocus_engine_problem(engine.get())->x == 3);
  CHECK(starfocus_engine_problem(engine.get())->y == field.depth.map.height - 1);
  CHECK(rows > 20);
  CHECK(rows < 51);
  CHECK(rows % 2 == 0);
}

}  // namespace
}  // namespace streams_test
