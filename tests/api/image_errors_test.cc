// SPDX-License-Identifier: Apache-2.0
// What is refused of images and depth maps, with the field that is told, before anything is
// written.
#include <doctest/doctest.h>

#include <limits>
#include <string>
#include <vector>

#include "tests/support/image_field.h"

namespace image_errors_test {
namespace {

using test::ImageField;
using test::ImageKind;
using test::ImageMemory;

constexpr int kWidth = 37, kHeight = 29;

struct Call {
  starfocus_light_field field;
  starfocus_image out;
};

struct Case {
  const char* what;
  void (*spoil)(Call* call);
  starfocus_status status;
  const char* field;
};

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

const Case kCases[] = {
    {"as it should be", [](Call*) {}, STARFOCUS_OK, ""},
    {"format -1", [](Call* c) { c->field.views[0].format = -1; }, STARFOCUS_ERROR_RANGE,
     "views[].format"},
    {"format 8", [](Call* c) { c->field.views[4].format = 8; }, STARFOCUS_ERROR_RANGE,
     "views[].format"},
    {"matrix 2", [](Call* c) { c->field.views[1].matrix = 2; }, STARFOCUS_ERROR_RANGE,
     "views[].matrix"},
    {"matrix -1", [](Call* c) { c->out.matrix = -1; }, STARFOCUS_ERROR_RANGE, "out.matrix"},
    {"range 2", [](Call* c) { c->out.range = 2; }, STARFOCUS_ERROR_RANGE, "out.range"},
    {"range -1", [](Call* c) { c->field.views[1].range = -1; }, STARFOCUS_ERROR_RANGE,
     "views[].range"},
    {"no luma", [](Call* c) { c->field.views[1].planes[0] = nullptr; }, STARFOCUS_ERROR_NULL,
     "views[].planes"},
    {"no chroma", [](Call* c) { c->field.views[1].planes[1] = nullptr; }, STARFOCUS_ERROR_NULL,
     "views[].planes"},
    {"no V", [](Call* c) { c->out.planes[2] = nullptr; }, STARFOCUS_ERROR_NULL, "out.planes"},
    {"NV12 has no third plane", [](Call* c) { c->field.views[1].planes[2] = nullptr; },
     STARFOCUS_OK, ""},
    {"luma's stride", [](Call* c) { c->field.views[1].strides[0] = kWidth - 1; },
     STARFOCUS_ERROR_STRIDE, "views[].strides"},
    {"chroma's stride", [](Call* c) { c->field.views[1].strides[1] = kWidth; },
     STARFOCUS_ERROR_STRIDE, "views[].strides"},
    {"V's stride", [](Call* c) { c->out.strides[2] = kWidth / 2; }, STARFOCUS_ERROR_STRIDE,
     "out.strides"},
    {"a stride past the addresses", [](Call* c) { c->out.strides[0] = SIZE_MAX / 2; },
     STARFOCUS_ERROR_STRIDE, "out.strides"},
    {"NV12, 1 apart", [](Call* c) { c->field.views[1].pixel_stride = 1; }, STARFOCUS_ERROR_RANGE,
     "views[].pixel_stride"},
    {"NV12, 2 apart", [](Call* c) { c->field.views[1].pixel_stride = 2; }, STARFOCUS_OK, ""},
    {"I420, 2 apart", [](Call* c) { c->out.pixel_stride = 2; }, STARFOCUS_ERROR_RANGE,
     "out.pixel_stride"},
    {"RGB, 2 apart", [](Call* c) { c->field.views[0].pixel_stride = 2; }, STARFOCUS_ERROR_RANGE,
     "views[].pixel_stride"},
    {"RGB, -3 apart", [](Call* c) { c->field.views[0].pixel_stride = -3; }, STARFOCUS_ERROR_RANGE,
     "views[].pixel_stride"},
    {"RGB, 257 apart", [](Call* c) { c->field.views[0].pixel_stride = 257; }, STARFOCUS_ERROR_RANGE,
     "views[].pixel_stride"},
    {"RGB, 4 apart in too short rows", [](Call* c) { c->field.views[0].pixel_stride = 4; },
     STARFOCUS_ERROR_STRIDE, "views[].strides"},
    {"RGBX, 3 apart",
     [](Call* c) {
       c->field.views[0].format = STARFOCUS_FORMAT_RGBX;
       c->field.views[0].pixel_stride = 3;
     },
     STARFOCUS_ERROR_RANGE, "views[].pixel_stride"},
    {"no depth", [](Call* c) { c->field.depth.data = nullptr; }, STARFOCUS_ERROR_NULL,
     "depth.data"},
    {"type 4", [](Call* c) { c->field.depth.type = 4; }, STARFOCUS_ERROR_RANGE, "depth.type"},
    {"type -1", [](Call* c) { c->field.depth.type = -1; }, STARFOCUS_ERROR_RANGE, "depth.type"},
    {"meaning 2", [](Call* c) { c->field.depth.meaning = 2; }, STARFOCUS_ERROR_RANGE,
     "depth.meaning"},
    {"meaning -1", [](Call* c) { c->field.depth.meaning = -1; }, STARFOCUS_ERROR_RANGE,
     "depth.meaning"},
    {"has_invalid 2", [](Call* c) { c->field.depth.has_invalid = 2; }, STARFOCUS_ERROR_RANGE,
     "depth.has_invalid"},
    {"scale 0", [](Call* c) { c->field.depth.scale = 0; }, STARFOCUS_ERROR_RANGE, "depth.scale"},
    {"scale NaN", [](Call* c) { c->field.depth.scale = kNan; }, STARFOCUS_ERROR_RANGE,
     "depth.scale"},
    {"offset NaN", [](Call* c) { c->field.depth.offset = kNan; }, STARFOCUS_ERROR_RANGE,
     "depth.offset"},
    {"too wide", [](Call* c) { c->field.depth.width = kWidth + 1; }, STARFOCUS_ERROR_RANGE,
     "depth.width"},
    {"too high", [](Call* c) { c->field.depth.height = kHeight + 1; }, STARFOCUS_ERROR_RANGE,
     "depth.height"},
    {"empty", [](Call* c) { c->field.depth.width = 0; }, STARFOCUS_ERROR_RANGE, "depth.width"},
    {"no rows", [](Call* c) { c->field.depth.height = -1; }, STARFOCUS_ERROR_RANGE, "depth.height"},
    {"short rows", [](Call* c) { c->field.depth.stride = 2 * 18 - 2; }, STARFOCUS_ERROR_STRIDE,
     "depth.stride"},
    {"odd rows", [](Call* c) { c->field.depth.stride += 1; }, STARFOCUS_ERROR_STRIDE,
     "depth.stride"},
    {"odd address",
     [](Call* c) { c->field.depth.data = static_cast<const char*>(c->field.depth.data) + 1; },
     STARFOCUS_ERROR_STRIDE, "depth.stride"},
    {"luma over a view", [](Call* c) { c->out.planes[0] = c->field.views[0].planes[0]; },
     STARFOCUS_ERROR_OVERLAP, "out"},
    {"V over a view's chroma",
     [](Call* c) { c->out.planes[2] = static_cast<uint8_t*>(c->field.views[1].planes[1]) + 30; },
     STARFOCUS_ERROR_OVERLAP, "out"},
    {"U over the map",
     [](Call* c) {
       c->out.planes[1] = static_cast<uint8_t*>(const_cast<void*>(c->field.depth.data)) + 40;
     },
     STARFOCUS_ERROR_OVERLAP, "out"},
};

TEST_CASE("images: bad ones are refused, with nothing written") {
  test::Random random(61);
  const test::Scene scene = test::LayeredScene(kWidth, kHeight, 5, 7, 3);
  ImageKind rgb, nv12, i420;
  nv12.format = STARFOCUS_FORMAT_NV12;
  i420.format = STARFOCUS_FORMAT_I420;
  const ImageField field = test::MakeImageField(
      scene, {rgb, nv12, i420},
      test::MakeDepth(scene, 18, 20, STARFOCUS_DEPTH_U16, STARFOCUS_DEPTH_RECIPROCAL, 0), &random);
  starfocus_config config = test::ImageConfig(field);
  test::Engine engine(config);
  const starfocus_params params = test::Params(1, 1, STARFOCUS_MODE_BLOCK);
  for (const Case& one : kCases) {
    const char* what = one.what;
    CAPTURE(what);
    ImageMemory image(kWidth, kHeight, i420), before = image;
    Call call = {field.Field(), image.Out()};
    one.spoil(&call);
    CHECK(starfocus_refocus(engine.get(), &params, &call.field, &call.out, nullptr) == one.status);
    CHECK(std::string(starfocus_engine_problem(engine.get())->field) == one.field);
    const bool untouched = image == before;
    CHECK(untouched == (one.status != STARFOCUS_OK));
  }
}

TEST_CASE("images: engines without them, no pointers, the workspace, bad parameters") {
  test::Random random(62);
  const test::Scene scene = test::LayeredScene(kWidth, kHeight, 1, 7, 3);
  const ImageField field = test::MakeImageField(
      scene, {ImageKind()},
      test::MakeDepth(scene, 9, 9, STARFOCUS_DEPTH_U8, STARFOCUS_DEPTH_LINEAR, 0), &random);
  starfocus_config config = test::ImageConfig(field);
  test::Engine engine(config);
  starfocus_params params = test::Params(1, 1, STARFOCUS_MODE_BLOCK);
  ImageMemory image(kWidth, kHeight, ImageKind());
  const starfocus_light_field images = field.Field();
  starfocus_image out = image.Out();
  starfocus_engine* e = engine.get();
  CHECK(starfocus_refocus(nullptr, &params, &images, &out, nullptr) == STARFOCUS_ERROR_NULL);
  CHECK(starfocus_refocus(e, nullptr, &images, &out, nullptr) == STARFOCUS_ERROR_NULL);
  CHECK(starfocus_refocus(e, &params, nullptr, &out, nullptr) == STARFOCUS_ERROR_NULL);
  CHECK(starfocus_refocus(e, &params, &images, nullptr, nullptr) == STARFOCUS_ERROR_NULL);
  CHECK(starfocus_refocus_prepared(e, &params, nullptr, &out, nullptr) == STARFOCUS_ERROR_NULL);
  CHECK(starfocus_prepare(e, &images, nullptr, 0, nullptr) == STARFOCUS_ERROR_NULL);
  out.planes[0] = engine.workspace();
  CHECK(starfocus_refocus(e, &params, &images, &out, nullptr) == STARFOCUS_ERROR_OVERLAP);
  out = image.Out();
  params.region = {0, 0, kWidth + 1, 1};
  CHECK(starfocus_refocus(e, &params, &images, &out, nullptr) == STARFOCUS_ERROR_RANGE);
  params.region = {};
  params.mode = 9;
  CHECK(starfocus_refocus(e, &params, &images, &out, nullptr) == STARFOCUS_ERROR_RANGE);
  params.mode = STARFOCUS_MODE_BLOCK;
  config.features &= ~STARFOCUS_FEATURE_IMAGES;
  config.features |= STARFOCUS_FEATURE_STREAMING;
  test::Engine without(config);
  starfocus_prepared* prepared = nullptr;
  int32_t rows = 0;
  CHECK(starfocus_refocus(without.get(), &params, &images, &out, nullptr) ==
        STARFOCUS_ERROR_FEATURE);
  CHECK(starfocus_prepare(without.get(), &images, engine.workspace(), 1 << 20, &prepared) ==
        STARFOCUS_ERROR_FEATURE);
  REQUIRE(starfocus_stream_begin(without.get(), &params) == STARFOCUS_OK);
  CHECK(starfocus_stream_push(without.get(), &images, 1, &rows) == STARFOCUS_ERROR_FEATURE);
  out.format = STARFOCUS_FORMAT_BGR;
  CHECK(starfocus_stream_pull(without.get(), &out, 1, &rows, nullptr) == STARFOCUS_ERROR_FEATURE);
}

}  // namespace
}  // namespace image_errors_test
