// SPDX-License-Identifier: Apache-2.0
// The operations that make a picture, with lenses of every kind and images of every format.
#ifndef STARFOCUS_TESTS_OPERATIONS_PICTURE_OPERATIONS_H_
#define STARFOCUS_TESTS_OPERATIONS_PICTURE_OPERATIONS_H_

#include <doctest/doctest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "starfocus/starfocus.hpp"
#include "tests/operations/operations.h"
#include "tests/support/config.h"
#include "tests/support/image_field.h"
#include "tests/support/inside.h"
#include "tests/support/prepared_memory.h"
#include "tests/support/rgb_calls.h"
#include "tests/support/test_scene.h"

namespace properties {

// Size of the pictures: three superblocks in each direction.
constexpr int kWidth = 70, kHeight = 75;

struct Lens {
  const char* name;
  starfocus_mode mode;
  starfocus_renderer renderer;
  double aperture;
  int views;
  float highlights = 1;
  // True for a scene of one surface, which is blurred without views unless `layered`.
  bool flat = false;
  bool layered = false;  // True if blocks of one surface render views at layers 1 and 2.
};

constexpr Lens kBlocks = {"blocks", STARFOCUS_MODE_BLOCK, STARFOCUS_RENDERER_SLICES, 1, 5};
constexpr Lens kBlur = {"blur", STARFOCUS_MODE_BLUR, STARFOCUS_RENDERER_AUTO, 1, 5};
constexpr Lens kPaper = {"benchmark, paper", STARFOCUS_MODE_BENCHMARK, STARFOCUS_RENDERER_LINE_SCAN,
                         0.3, 5};
constexpr Lens kLenses[] = {
    kBlocks,
    kBlur,
    kPaper,
    {"blocks, one view", STARFOCUS_MODE_BLOCK, STARFOCUS_RENDERER_AUTO, 0.7, 1},
    {"blocks, gathered", STARFOCUS_MODE_BLOCK, STARFOCUS_RENDERER_SLICES, 1, 5, 1, true},
    {"blocks, layered", STARFOCUS_MODE_BLOCK, STARFOCUS_RENDERER_SLICES, 1, 5, 1, true, true},
    {"blocks, paper", STARFOCUS_MODE_BLOCK, STARFOCUS_RENDERER_LINE_SCAN, 0.5, 9},
    {"blocks, highlights", STARFOCUS_MODE_BLOCK, STARFOCUS_RENDERER_SLICES, 1, 5, 4},
    {"frame, paper", STARFOCUS_MODE_FRAME, STARFOCUS_RENDERER_LINE_SCAN, 0.5, 17},
    {"frame, one view", STARFOCUS_MODE_FRAME, STARFOCUS_RENDERER_AUTO, 1, 1},
    {"frame, subapertures", STARFOCUS_MODE_FRAME, STARFOCUS_RENDERER_SLICES, 1, 9},
    {"benchmark, slices", STARFOCUS_MODE_BENCHMARK, STARFOCUS_RENDERER_SLICES, 0.3, 5},
    {"pinhole", STARFOCUS_MODE_BLOCK, STARFOCUS_RENDERER_AUTO, 0, 5},
};

// A scene, the frame before this scene, and an engine that has prepared the scene.
struct Picture {
  Picture(test::Scene of, const Lens& lens, const Setup& setup) : scene(std::move(of)) {
    if (lens.flat) scene.disparity.assign(scene.disparity.size(), 9);
    for (int view = 0; view < scene.views(); ++view) {  // 4x4 white pixels are a lamp
      for (int y = 40; y < 44; ++y) std::fill_n(scene.Pixel(view, 30, y), 12, uint8_t{255});
    }
    before = scene;
    before.Pixel(0, 50, 60)[1] ^= 64;  // the frames differ in one pixel of the last stripe
    config = test::ConfigFor(scene, 13);
    config.superblock = 32;
    config.features |= STARFOCUS_FEATURE_STREAMING | STARFOCUS_FEATURE_IMAGES;
    config.previews = 1;
    config.max_workers = setup.workers;
    config.highlights = lens.highlights;
    config.tuning.gather = lens.layered ? 0 : 1;
    params = test::Params(-3, lens.aperture, lens.mode);
    params.study.renderer = lens.renderer;
    engine = std::make_unique<test::Engine>(config);
    REQUIRE(engine->status() == STARFOCUS_OK);
    if (setup.kernels != nullptr) test::UseKernels(setup.kernels, engine->get());
    if (setup.used) Use();
    REQUIRE(test::Refocus(engine.get(), params, before, &previous) == STARFOCUS_OK);
    memory = std::make_unique<test::PreparedMemory>(*engine);
    REQUIRE(Prepare(scene.Field(), &prepared) == STARFOCUS_OK);
  }
  void Use() {
    test::Output out(kWidth, kHeight);
    starfocus::Params other = test::Params(7, 0.4, STARFOCUS_MODE_BLUR);
    REQUIRE(test::Refocus(engine.get(), other, before, &out) == STARFOCUS_OK);
    other.study.mode = STARFOCUS_MODE_FRAME;
    REQUIRE(starfocus_stream_begin(engine->get(), &other) == STARFOCUS_OK);
    const starfocus_light_field field = before.Field();
    int32_t moved = 0;
    REQUIRE(starfocus_stream_push(engine->get(), &field, kHeight, &moved) == STARFOCUS_OK);
    REQUIRE(test::PullRgb(engine->get(), out.bytes.data(), out.stride, 5, &moved, nullptr) ==
            STARFOCUS_OK);
  }
  starfocus_status Prepare(const starfocus_light_field& field, starfocus_prepared** made) {
    const starfocus_status status =
        starfocus_prepare(engine->get(), &field, memory->get(), memory->bytes, made);
    CHECK((*made == nullptr) == (status != STARFOCUS_OK));
    return status;
  }

  test::Scene scene, before;
  test::Config config;
  starfocus::Params params;
  std::unique_ptr<test::Engine> engine;
  test::Output previous{kWidth, kHeight, 5};
  std::unique_ptr<test::PreparedMemory> memory;
  starfocus_prepared* prepared = nullptr;
};

inline test::Scene SceneOf(const Lens& lens) {
  return test::RandomScene(kWidth, kHeight, lens.views, -3, 9, 8);
}

// The operations that make a picture.
inline starfocus_status Whole(Picture* of, const starfocus_callbacks& callbacks, test::Output* out,
                              starfocus_report* report) {
  return test::Refocus(of->engine.get(), of->params, of->scene, out, callbacks, report);
}
inline starfocus_status Region(Picture* of, const starfocus_callbacks& callbacks, test::Output* out,
                               starfocus_report* report) {
  starfocus::Params params = of->params;
  params.region = {21, 17, 30, 41};
  return test::Refocus(of->engine.get(), params, of->scene, out, callbacks, report);
}
inline starfocus_status Stream(Picture* of, const starfocus_callbacks& callbacks, test::Output* out,
                               starfocus_report* report) {
  return test::Stream(of->engine.get(), of->params, of->scene, out, 9, 7, callbacks, report);
}
inline starfocus_status After(Picture* of, const starfocus_callbacks&, test::Output* out,
                              starfocus_report* report) {
  const starfocus_light_field field = of->scene.Field();
  const starfocus_light_field before = of->before.Field();
  const starfocus_image picture =
      starfocus_image_rgb(of->previous.bytes.data(), of->previous.stride);
  const starfocus_previous previous = {sizeof previous, &before, &picture};
  return test::RefocusAfterRgb(of->engine->get(), &of->params, &field, &previous, out->bytes.data(),
                               out->stride, report);
}
inline starfocus_status Prepared(Picture* of, const starfocus_callbacks&, test::Output* out,
                                 starfocus_report* report) {
  return test::RefocusPreparedRgb(of->engine->get(), &of->params, of->prepared, out->bytes.data(),
                                  out->stride, report);
}
inline starfocus_status Preview(Picture* of, const starfocus_callbacks&, test::Output* out,
                                starfocus_report* report) {
  return test::PreviewRgb(of->engine->get(), &of->params, of->prepared, 1, out->bytes.data(),
                          out->stride, report);
}
inline starfocus_status Prepare(Picture* of, const starfocus_callbacks&, test::Output* out,
                                starfocus_report* report) {
  const starfocus_status status = of->Prepare(of->scene.Field(), &of->prepared);
  const starfocus_callbacks none = {};
  REQUIRE(starfocus_set_callbacks(of->engine->get(), &none) == STARFOCUS_OK);
  return status == STARFOCUS_OK ? Prepared(of, none, out, report) : status;
}

using Way = starfocus_status (*)(Picture* of, const starfocus_callbacks& callbacks,
                                 test::Output* out, starfocus_report* report);
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
            return [of, way](const starfocus_callbacks& callbacks, Bytes* bytes) {
              REQUIRE(starfocus_set_callbacks(of->engine->get(), &callbacks) == STARFOCUS_OK);
              test::Output out(way.width, way.height, 5);
              test::Report report;
              const starfocus_status status = way.ask(of.get(), callbacks, &out, &report);
              CHECK(out.PaddingUntouched());
              *bytes = out.bytes;
              for (const starfocus_layer_report& layer : report.layers) {
                for (const uint64_t count : {layer.blocks, layer.views, layer.pixels}) {
                  for (int k = 0; k < 8; ++k) bytes->push_back(uint8_t(count >> 8 * k));
                }
              }
              return status;
            };
          }};
}

// Returns an operation that makes a picture from views in the given format and a depth map of half
// the size. If `prepares` is true, the operation prepares the light field first.
inline Run SetUpImages(int format, bool prepares, const Setup& setup) {
  test::Random random(uint64_t(format) + 1);
  const test::ImageKind kind = test::AnyKind(format, &random);
  const test::Scene scene = SceneOf(kBlocks);
  const auto field = std::make_shared<test::ImageField>(test::MakeImageField(
      scene, {kind},
      test::MakeDepth(scene, 35, 38, STARFOCUS_DEPTH_U16, STARFOCUS_DEPTH_RECIPROCAL, 0), &random));
  const auto of = std::make_shared<Picture>(field->converted, kBlocks, setup);
  return [of, field, kind, prepares](const starfocus_callbacks& callbacks, Bytes* bytes) {
    starfocus_engine* engine = of->engine->get();
    REQUIRE(starfocus_set_callbacks(engine, &callbacks) == STARFOCUS_OK);
    test::ImageMemory image(kWidth, kHeight, kind);
    const starfocus_light_field images = field->Field();
    const starfocus_image out = image.Out();
    starfocus_status status = STARFOCUS_OK;
    if (prepares) {
      status = of->Prepare(images, &of->prepared);
      const starfocus_callbacks none = {};
      REQUIRE(starfocus_set_callbacks(engine, &none) == STARFOCUS_OK);
      if (status == STARFOCUS_OK) {
        status = starfocus_refocus_prepared(engine, &of->params, of->prepared, &out, nullptr);
      }
    } else {
      status = starfocus_refocus(engine, &of->params, &images, &out, nullptr);
    }
    *bytes = image.Bytes();
    return status;
  };
}

// Returns all operations that make pictures; operations on images use all formats, or only NV12.
inline std::vector<Operation> PictureOperations(bool all_formats = true) {
  std::vector<Operation> all;
  for (const Lens& lens : kLenses) {
    all.push_back(OperationOf(lens, {"whole", Whole, kWidth, kHeight, 10}));
  }
  for (const Lens& lens : {kBlocks, kBlur, kPaper}) {
    for (const NamedWay& way : kWays) all.push_back(OperationOf(lens, way));
  }
  for (int format = STARFOCUS_FORMAT_RGB; format <= STARFOCUS_FORMAT_YUV_420_888; ++format) {
    if (!all_formats && format != STARFOCUS_FORMAT_NV12) continue;
    for (const bool prepares : {false, true}) {
      all.push_back({(prepares ? "prepared images " : "images ") + std::to_string(format), kHeight,
                     7, [=](const Setup& setup) { return SetUpImages(format, prepares, setup); }});
    }
  }
  return all;
}

}  // namespace properties

#endif  // STARFOCUS_TESTS_OPERATIONS_PICTURE_OPERATIONS_H_
