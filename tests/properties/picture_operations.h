// SPDX-License-Identifier: Apache-2.0
// The ways to ask an engine for a picture, through lenses of every kind and in every format.
#ifndef STARFOCUS_TESTS_PROPERTIES_PICTURE_OPERATIONS_H_
#define STARFOCUS_TESTS_PROPERTIES_PICTURE_OPERATIONS_H_

#include <doctest/doctest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tests/properties/operations.h"
#include "tests/support/image_field.h"
#include "tests/support/inside.h"
#include "tests/support/prepared_memory.h"
#include "tests/support/rgb_calls.h"
#include "tests/support/test_scene.h"

namespace properties {

constexpr int kWidth = 70, kHeight = 75;  // three superblocks each way

struct Lens {
  const char* name;
  sf_mode mode;
  sf_renderer renderer;
  double aperture;
  int views;
  float highlights = 1;
  bool flat = false;     // one surface, which is gathered,
  bool layered = false;  // or subsampled
};

constexpr Lens kBlocks = {"blocks", SF_MODE_BLOCK, SF_RENDERER_SLICES, 1, 5};
constexpr Lens kBlur = {"blur", SF_MODE_BLUR, SF_RENDERER_AUTO, 1, 5};
constexpr Lens kPaper = {"benchmark, paper", SF_MODE_BENCHMARK, SF_RENDERER_LINE_SCAN, 0.3, 5};
constexpr Lens kLenses[] = {
    kBlocks,
    kBlur,
    kPaper,
    {"blocks, one view", SF_MODE_BLOCK, SF_RENDERER_AUTO, 0.7, 1},
    {"blocks, gathered", SF_MODE_BLOCK, SF_RENDERER_SLICES, 1, 5, 1, true},
    {"blocks, layered", SF_MODE_BLOCK, SF_RENDERER_SLICES, 1, 5, 1, true, true},
    {"blocks, paper", SF_MODE_BLOCK, SF_RENDERER_LINE_SCAN, 0.5, 9},
    {"blocks, highlights", SF_MODE_BLOCK, SF_RENDERER_SLICES, 1, 5, 4},
    {"frame, paper", SF_MODE_FRAME, SF_RENDERER_LINE_SCAN, 0.5, 17},
    {"frame, one view", SF_MODE_FRAME, SF_RENDERER_AUTO, 1, 1},
    {"frame, subapertures", SF_MODE_FRAME, SF_RENDERER_SLICES, 1, 9},
    {"benchmark, slices", SF_MODE_BENCHMARK, SF_RENDERER_SLICES, 0.3, 5},
    {"pinhole", SF_MODE_BLOCK, SF_RENDERER_AUTO, 0, 5},
};

// A scene, the frame before it, and an engine that has prepared it.
struct Picture {
  Picture(test::Scene of, const Lens& lens, const Setup& setup) : scene(std::move(of)) {
    if (lens.flat) scene.disparity.assign(scene.disparity.size(), 9);
    for (int view = 0; view < scene.views(); ++view) {  // bright squares are lamps
      for (int y = 40; y < 44; ++y) std::fill_n(scene.Pixel(view, 30, y), 12, uint8_t{255});
    }
    before = scene;
    before.Pixel(0, 50, 60)[1] ^= 64;  // a corner of the last stripes differs
    config = test::ConfigFor(scene, 13);
    config.superblock = 32;
    config.features |= SF_FEATURE_STREAMING | SF_FEATURE_IMAGES;
    config.previews = 1;
    config.max_workers = setup.workers;
    config.highlights = lens.highlights;
    config.tuning.gather = lens.layered ? 0 : 1;
    params = test::Params(-3, lens.aperture, lens.mode);
    params.renderer = lens.renderer;
    engine = std::make_unique<test::Engine>(config);
    REQUIRE(engine->status() == SF_OK);
    if (setup.kernels != nullptr) test::UseKernels(setup.kernels, engine->get());
    if (setup.used) Use();
    REQUIRE(test::Refocus(engine.get(), params, before, &previous) == SF_OK);
    memory = std::make_unique<test::PreparedMemory>(config);
    REQUIRE(Prepare(scene.Field(), &prepared) == SF_OK);
  }
  void Use() {
    test::Output out(kWidth, kHeight);
    sf_params other = test::Params(7, 0.4, SF_MODE_BLUR);
    REQUIRE(test::Refocus(engine.get(), other, before, &out) == SF_OK);
    other.mode = SF_MODE_FRAME;
    REQUIRE(sf_stream_begin(engine->get(), &other) == SF_OK);
    const sf_light_field field = before.Field();
    int32_t moved = 0;
    REQUIRE(sf_stream_push(engine->get(), &field, kHeight, &moved) == SF_OK);
    REQUIRE(test::PullRgb(engine->get(), out.bytes.data(), out.stride, 5, &moved, nullptr) ==
            SF_OK);
  }
  sf_status Prepare(const sf_light_field& field, sf_prepared** made) {
    const sf_status status = sf_prepare(engine->get(), &field, memory->get(), memory->bytes, made);
    CHECK((*made == nullptr) == (status != SF_OK));
    return status;
  }

  test::Scene scene, before;
  sf_config config;
  sf_params params;
  std::unique_ptr<test::Engine> engine;
  test::Output previous{kWidth, kHeight, 5};
  std::unique_ptr<test::PreparedMemory> memory;
  sf_prepared* prepared = nullptr;
};

inline test::Scene SceneOf(const Lens& lens) {
  return test::RandomScene(kWidth, kHeight, lens.views, -3, 9, 8);
}

// Ways to ask for a picture. The callbacks are set.
inline sf_status Whole(Picture* of, const sf_callbacks& callbacks, test::Output* out,
                       sf_report* report) {
  return test::Refocus(of->engine.get(), of->params, of->scene, out, callbacks, report);
}
inline sf_status Region(Picture* of, const sf_callbacks& callbacks, test::Output* out,
                        sf_report* report) {
  sf_params params = of->params;
  params.region = {21, 17, 30, 41};
  return test::Refocus(of->engine.get(), params, of->scene, out, callbacks, report);
}
inline sf_status Stream(Picture* of, const sf_callbacks& callbacks, test::Output* out,
                        sf_report* report) {
  return test::Stream(of->engine.get(), of->params, of->scene, out, 9, 7, callbacks, report);
}
inline sf_status After(Picture* of, const sf_callbacks&, test::Output* out, sf_report* report) {
  const sf_light_field field = of->scene.Field();
  const sf_previous previous = {of->before.Field(),
                                sf_image_rgb(of->previous.bytes.data(), of->previous.stride)};
  return test::RefocusAfterRgb(of->engine->get(), &of->params, &field, &previous, out->bytes.data(),
                               out->stride, report);
}
inline sf_status Prepared(Picture* of, const sf_callbacks&, test::Output* out, sf_report* report) {
  return test::RefocusPreparedRgb(of->engine->get(), &of->params, of->prepared, out->bytes.data(),
                                  out->stride, report);
}
inline sf_status Preview(Picture* of, const sf_callbacks&, test::Output* out, sf_report* report) {
  return test::PreviewRgb(of->engine->get(), &of->params, of->prepared, 1, out->bytes.data(),
                          out->stride, report);
}
inline sf_status Prepare(Picture* of, const sf_callbacks&, test::Output* out, sf_report* report) {
  const sf_status status = of->Prepare(of->scene.Field(), &of->prepared);
  const sf_callbacks none = {};
  REQUIRE(sf_set_callbacks(of->engine->get(), &none) == SF_OK);
  return status == SF_OK ? Prepared(of, none, out, report) : status;
}

using Way = sf_status (*)(Picture* of, const sf_callbacks& callbacks, test::Output* out,
                          sf_report* report);
struct NamedWay {
  const char* name;
  Way ask;
  int width, height, questions;
};
constexpr NamedWay kWays[] = {
    {"region", Region, 30, 41, 1},        {"stream", Stream, kWidth, kHeight, 10},
    {"after", After, kWidth, kHeight, 3}, {"prepared", Prepared, kWidth, kHeight, 10},
    {"preview", Preview, 35, 38, 3},      {"prepare", Prepare, kWidth, kHeight, 7}};

inline Operation OperationOf(const Lens& lens, const NamedWay& way) {
  return {way.name + std::string(": ") + lens.name, way.height, way.questions,
          [lens, way](const Setup& setup) -> Run {
            const auto of = std::make_shared<Picture>(SceneOf(lens), lens, setup);
            return [of, way](const sf_callbacks& callbacks, Bytes* bytes) {
              REQUIRE(sf_set_callbacks(of->engine->get(), &callbacks) == SF_OK);
              test::Output out(way.width, way.height, 5);
              sf_report report = {};
              const sf_status status = way.ask(of.get(), callbacks, &out, &report);
              CHECK(out.PaddingUntouched());
              *bytes = out.bytes;
              for (const sf_layer_report& layer : report.layers) {
                for (const uint64_t count : {layer.blocks, layer.views, layer.pixels}) {
                  for (int k = 0; k < 8; ++k) bytes->push_back(uint8_t(count >> 8 * k));
                }
              }
              return status;
            };
          }};
}

// A picture from views of a format and a map of half the size, into that format; or one that is
// prepared.
inline Run SetUpImages(int format, bool prepares, const Setup& setup) {
  test::Random random(uint64_t(format) + 1);
  const test::ImageKind kind = test::AnyKind(format, &random);
  const test::Scene scene = SceneOf(kBlocks);
  const auto field = std::make_shared<test::ImageField>(test::MakeImageField(
      scene, {kind}, test::MakeDepth(scene, 35, 38, SF_DEPTH_U16, SF_DEPTH_RECIPROCAL, 0),
      &random));
  const auto of = std::make_shared<Picture>(field->converted, kBlocks, setup);
  return [of, field, kind, prepares](const sf_callbacks& callbacks, Bytes* bytes) {
    sf_engine* engine = of->engine->get();
    REQUIRE(sf_set_callbacks(engine, &callbacks) == SF_OK);
    test::ImageMemory image(kWidth, kHeight, kind);
    const sf_light_field images = field->Field();
    const sf_image out = image.Out();
    sf_status status = SF_OK;
    if (prepares) {
      status = of->Prepare(images, &of->prepared);
      const sf_callbacks none = {};
      REQUIRE(sf_set_callbacks(engine, &none) == SF_OK);
      if (status == SF_OK) {
        status = sf_refocus_prepared(engine, &of->params, of->prepared, &out, nullptr);
      }
    } else {
      status = sf_refocus(engine, &of->params, &images, &out, nullptr);
    }
    *bytes = image.Bytes();
    return status;
  };
}

// With images of all formats, or of NV12 alone.
inline std::vector<Operation> PictureOperations(bool all_formats = true) {
  std::vector<Operation> all;
  for (const Lens& lens : kLenses) {
    all.push_back(OperationOf(lens, {"whole", Whole, kWidth, kHeight, 10}));
  }
  for (const Lens& lens : {kBlocks, kBlur, kPaper}) {
    for (const NamedWay& way : kWays) all.push_back(OperationOf(lens, way));
  }
  for (int format = SF_FORMAT_RGB; format <= SF_FORMAT_YUV_420_888; ++format) {
    if (!all_formats && format != SF_FORMAT_NV12) continue;
    for (const bool prepares : {false, true}) {
      all.push_back({(prepares ? "prepared images " : "images ") + std::to_string(format), kHeight,
                     7, [=](const Setup& setup) { return SetUpImages(format, prepares, setup); }});
    }
  }
  return all;
}

}  // namespace properties

#endif  // STARFOCUS_TESTS_PROPERTIES_PICTURE_OPERATIONS_H_
