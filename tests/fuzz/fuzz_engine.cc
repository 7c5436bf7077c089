// SPDX-License-Identifier: Apache-2.0
// Fuzz target: the C ABI with any configuration, parameters, sizes, strides and contents, for whole
// pictures and streams.
#include <algorithm>
#include <cstdlib>
#include <vector>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/fuzz/engine_input.h"
#include "tests/support/config.h"
#include "tests/support/hair.h"
#include "tests/support/test_scene.h"

namespace {

using namespace starfocus::fuzz;
using test::Strands;

constexpr int kBlocks[] = {32, 64, 128, 256};
// Limits the product of rendered views and pixels, so that every input runs fast.
constexpr double kMostWork = 300000;

// Derives the shape from the value of another field, so that recorded inputs keep their meaning.
void SetShape(int drawn, starfocus_params* lens) {
  lens->shape = drawn % 4;
  lens->blades = 3 + drawn % 10;
  lens->rotation = 3 * drawn - 360;
  lens->curvature = drawn % 11 / 10.0;
  lens->ring_inner = drawn % 7 / 8.0;
  lens->cats_eye = drawn % 3 == 0 ? drawn % 9 / 8.0 : 0;
}

// Derives 2 to 17 views, at positions that form no star set, from the value of another field.
void SetPositions(int drawn, starfocus_config* config) {
  config->views = 2 + drawn % 16;
  for (int k = 1; k < config->views; ++k) {
    config->positions[k] = {(drawn * k % 33 - 16) / 16.0, (k - 8) / 8.0};
  }
}

// Sets a range of disparities that suits strands in front of a background.
void SetDepths(Input* input, starfocus_config* config) {
  config->disparity_min = static_cast<float>(input->Real(-12, 3));
  config->disparity_max = config->disparity_min + static_cast<float>(input->Real(5, 12));
}

// Makes a configuration and the shape of the lens. With `strands`, the picture is large enough for
// strands; otherwise, the picture has any size. Most configurations are valid; a few have arbitrary
// bytes in one field.
test::Config MakeConfig(bool strands, Input* input, starfocus_params* lens) {
  test::Config config;
  const int side = input->Rarely() ? 100 : 24;
  config.width = input->Int(strands ? 16 : 1, side);
  config.height = input->Int(strands ? 16 : 1, side);
  config.views = kViews[input->Int(0, 3)];
  DrawDisparities(input, &config);
  if (strands) SetDepths(input, &config);
  config.max_blur = input->Rarely() ? input->Real(1, STARFOCUS_MAX_BLUR) : input->Real(0.01, 14);
  config.superblock = kBlocks[input->Int(0, 3)];
  config.max_workers = input->Rarely() ? STARFOCUS_MAX_WORKERS : 1;
  test::SetFeature(STARFOCUS_FEATURE_STREAMING, input->Int(0, 1), &config.features);
  lens->theta = input->Real(STARFOCUS_MIN_THETA, STARFOCUS_MAX_THETA);
  config.tuning.max_layer = input->Int(0, 2);
  config.tuning.deblocking = input->Int(0, 255);
  config.tuning.timing.block = 1u << input->Int(0, 26);
  config.tuning.timing.c = static_cast<uint32_t>(input->Int(0, 100000));
  // The following fields derive from tuning.deblocking, so that recorded inputs keep their meaning.
  const int drawn = config.tuning.deblocking;
  config.tuning.gather = drawn % 3 != 0;
  config.previews = drawn / 4 % 4;
  config.tuning.n_scale = 0.5 + 0.25 * (drawn % 7);
  if (drawn % 7 == 1) config.highlights = 1.0F + static_cast<float>(drawn) / 8;
  config.transfer = drawn % 5 == 0 ? STARFOCUS_TRANSFER_NONE : STARFOCUS_TRANSFER_SRGB;
  if (drawn % 2 == 0) {
    SetShape(drawn * 2 / 3, lens);
    config.features |= STARFOCUS_FEATURE_SHAPES;
  }
  if (drawn % 6 == 1) SetPositions(drawn, &config);
  if (drawn % 8 == 3) config.features = 0;
  SpoilRarely(input, static_cast<starfocus_config*>(&config), kNumbersOfConfig);
  return config;
}

// Sets all parameters except the shape of the lens, which the caller has set.
void SetParams(const test::Config& config, Input* input, starfocus::Params* given) {
  starfocus::Params& params = *given;
  params.study.mode = input->Rarely() ? input->Value<int32_t>() : input->Int(0, 3);
  params.study.renderer = input->Rarely() ? input->Value<int32_t>() : input->Int(0, 2);
  params.focus = input->Real(config.disparity_min, config.disparity_max);
  if (input->Rarely()) params.focus = input->Value<double>();
  params.aperture = input->Real(0, 1);
  // In most cases, reduces the aperture to the largest one that the configuration allows.
  const double radius = params.aperture * std::max(params.focus - config.disparity_min,
                                                   config.disparity_max - params.focus);
  if (radius > config.max_blur && !input->Rarely()) {
    params.aperture *= config.max_blur / radius * 0.999;
  }
  if (input->Rarely()) params.focus_nearer = input->Real(0, config.disparity_max);
  if (input->Rarely()) params.focus_farther = input->Real(0, config.disparity_max);
  if (input->Rarely()) {
    params.region = {input->Int(0, config.width), input->Int(0, config.height),
                     input->Int(0, config.width), input->Int(0, config.height)};
  }
  SpoilRarely(input, &params, sizeof params);
  // The caller passes only valid pointers.
  params.previous = nullptr;
  given->starfocus_params::study = &params.study;
}

struct Pictures {
  std::vector<Rows<uint8_t>> views, coverage;
  std::vector<float> disparity;
  starfocus_light_field field = starfocus::NewLightField();
};

// Makes runs of random levels, or the levels of the strands.
Rows<uint8_t> MakeLevels(const test::Config& config, const Strands& strands,
                         int (Strands::*level_at)(int x, int y) const, Input* input) {
  Rows<uint8_t> levels(static_cast<size_t>(config.width), config.height, 3, input);
  FillRuns(input, &levels);
  for (size_t i = 0; strands.any() && i < levels.count; ++i) {
    const auto x = static_cast<int>(i % levels.stride), y = static_cast<int>(i / levels.stride);
    levels.values[i] = static_cast<uint8_t>((strands.*level_at)(x, y));
  }
  return levels;
}

void MakeDisparity(const test::Config& config, const Strands& strands, Input* input,
                   Pictures* pictures) {
  const Rows<uint8_t> levels = MakeLevels(config, strands, &Strands::DepthAt, input);
  std::vector<float>& disparity = pictures->disparity;
  disparity.resize(levels.count);
  for (size_t i = 0; i < levels.count; ++i) disparity[i] = DisparityOf(config, levels.values[i]);
  if (input->Rarely()) disparity[input->Value<uint32_t>() % levels.count] = input->Value<float>();
  pictures->field.depth = starfocus_depth_float(disparity.data(), levels.stride * sizeof(float),
                                                config.width, config.height);
}

// Makes a view with any bytes, or with strands of one colour in front of another colour.
Rows<uint8_t> MakeView(const test::Config& config, const Strands& strands, Input* input) {
  Rows<uint8_t> view(3 * static_cast<size_t>(config.width), config.height, 5, input);
  FillPicture(input, &view);
  const std::vector<uint8_t> colours(view.values.get(),
                                     view.values.get() + std::min<size_t>(view.count, 6));
  for (size_t i = 0; strands.any() && i < view.count; ++i) {
    const auto x = static_cast<int>(i % view.stride / 3), y = static_cast<int>(i / view.stride);
    const size_t c = i % view.stride % 3;
    view.values[i] = test::Mixture(strands.CoverageAt(x, y), colours[c], colours[3 + c]);
  }
  return view;
}

Pictures MakePictures(const test::Config& config, const Strands& strands, Input* input) {
  Pictures pictures;
  for (int view = 0; view < config.views; ++view) {
    pictures.views.push_back(MakeView(config, strands, input));
    pictures.field.views[view] =
        starfocus_image_rgb(pictures.views.back().values.get(), pictures.views.back().stride);
  }
  MakeDisparity(config, strands, input, &pictures);
  if (input->Int(0, 2) != 0) return pictures;
  pictures.coverage.push_back(MakeLevels(config, strands, &Strands::CoverageAt, input));
  pictures.field.coverage = pictures.coverage[0].values.get();
  pictures.field.coverage_stride = pictures.coverage[0].stride;
  return pictures;
}

starfocus_light_field From(starfocus_light_field field, int views, size_t row) {
  for (int view = 0; view < views; ++view) {
    starfocus_image& image = field.views[view];
    image.planes[0] = static_cast<uint8_t*>(image.planes[0]) + row * image.strides[0];
  }
  field.depth.data = static_cast<const char*>(field.depth.data) + row * field.depth.stride;
  if (field.coverage != nullptr) field.coverage += row * field.coverage_stride;
  return field;
}

int RowCount(int left, Input* input) {
  return std::min(input->Int(0, 40) + (input->empty() ? 9 : 0), left);
}

// Pushes rows, and pulls finished rows into `out`, in any order. Restarts the stream in some cases.
void Stream(starfocus_engine* engine, const test::Config& config, const starfocus::Params& params,
            const Pictures& pictures, uint8_t* out, size_t stride, Input* input) {
  if (starfocus_stream_begin(engine, &params) != STARFOCUS_OK) return;
  int pushed = 0, pulled = 0;
  for (int round = 0; round < 200 && pulled < config.height; ++round) {
    int32_t moved = 0;
    if (pushed < config.height) {
      const starfocus_light_field rows =
          From(pictures.field, config.views, static_cast<size_t>(pushed));
      const int count = RowCount(config.height - pushed, input);
      if (starfocus_stream_push(engine, &rows, count, &moved) != STARFOCUS_OK) return;
      pushed += moved;
    }
    uint8_t* rest = out + static_cast<size_t>(pulled) * stride;
    const int count = RowCount(config.height - pulled, input);
    const starfocus_status status = test::PullRgb(engine, rest, stride, count, &moved, nullptr);
    if (status != STARFOCUS_OK && status != STARFOCUS_ERROR_CANCELLED) return;
    pulled += moved;  // after a cancellation, the stream can continue
    if (!input->Rarely()) continue;
    if (starfocus_stream_begin(engine, &params) != STARFOCUS_OK) return;
    pushed = pulled = 0;
  }
}

// Refocuses a whole picture with one of several API functions. The previous frame may be equal to
// the current frame or different.
void Refocus(starfocus_engine* engine, const test::Config& config, const starfocus::Params& params,
             const Pictures& pictures, uint8_t* out, size_t stride, Input* input) {
  starfocus_report report = starfocus::NewReport();
  if (!input->Rarely()) {
    test::RefocusRgb(engine, &params, &pictures.field, out, stride, &report);
    return;
  }
  if (input->Int(0, 1) == 0) {
    const Pictures before = MakePictures(config, Strands(), input);
    const Rows<uint8_t> picture(3 * static_cast<size_t>(config.width), config.height, 5, input);
    const starfocus_image image = starfocus_image_rgb(picture.values.get(), picture.stride);
    const starfocus_previous previous = {
        sizeof previous, input->Int(0, 1) == 0 ? &before.field : &pictures.field, &image};
    test::RefocusAfterRgb(engine, &params, &pictures.field, &previous, out, stride, &report);
    return;
  }
  size_t bytes = 0;
  Must(starfocus_prepared_size(&config, &bytes, nullptr) == STARFOCUS_OK);
  const auto memory = TakeMemory(bytes);
  if (!memory) return;
  starfocus_prepared* prepared = nullptr;
  const starfocus_status status =
      starfocus_prepare(engine, &pictures.field, memory.get(), bytes, &prepared);
  if (status != STARFOCUS_OK) return;
  // A preview is not larger than the picture and does not change the engine.
  test::PreviewRgb(engine, &params, prepared, config.previews, out, stride, &report);
  test::RefocusPreparedRgb(engine, &params, prepared, out, stride, &report);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  Input input(data, size);
  const Strands strands = input.Int(0, 1) == 0 ? Strands() : test::DrawStrands(&input);
  starfocus::Params lens;
  const test::Config config = MakeConfig(strands.any(), &input, &lens);
  size_t bytes = 0;
  if (starfocus_workspace_size(&config, &bytes, nullptr) != STARFOCUS_OK) return 0;
  const auto workspace = TakeWorkspace(config, bytes);
  if (!workspace) return 0;
  starfocus_engine* engine = Started(config, workspace.get(), bytes);
  const Pictures pictures = MakePictures(config, strands, &input);
  const Rows<uint8_t> out(3 * static_cast<size_t>(config.width), config.height, 5, &input);
  for (int round = 0; round < 2; ++round) {
    starfocus::Params params = lens;
    SetParams(config, &input, &params);
    const starfocus_callbacks callbacks = DrawCallbacks(100, &input);
    Must(starfocus_set_callbacks(engine, &callbacks) == STARFOCUS_OK);
    const double scale = params.study.mode == STARFOCUS_MODE_BENCHMARK ? 2 : config.tuning.n_scale;
    const bool frame = params.study.mode == STARFOCUS_MODE_FRAME;
    const bool by_default =
        params.study.mode == STARFOCUS_MODE_BLOCK || (frame && config.views == 1);
    const bool subapertures = by_default
                                  ? params.study.renderer != STARFOCUS_RENDERER_LINE_SCAN
                                  : frame && params.study.renderer == STARFOCUS_RENDERER_SLICES;
    // The rule of subapertures uses at most 13 views along the radius, however large the blur is.
    const double n = scale * (subapertures ? std::min(config.max_blur, 13.0) : config.max_blur);
    if (3.2 * n * n * config.width * config.height > kMostWork) continue;
    if (test::Has(config.features, STARFOCUS_FEATURE_STREAMING) && input.Int(0, 1) == 1) {
      Stream(engine, config, params, pictures, out.values.get(), out.stride, &input);
    } else {
      Refocus(engine, config, params, pictures, out.values.get(), out.stride, &input);
    }
  }
  return 0;
}
