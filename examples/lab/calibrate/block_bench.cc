// SPDX-License-Identifier: Apache-2.0
#include "examples/lab/calibrate/block_bench.h"

#include <algorithm>

#include "examples/lab/lab_config.h"
#include "lib/api/validate.h"
#include "lib/engine/stripe.h"
#include "lib/io/depth_map.h"
#include "platform/clock.h"
#include "platform/file.h"
#include "starfocus/starfocus.hpp"

namespace starfocus {
namespace {

starfocus::Config MakeConfig(const LightField& light_field) {
  starfocus::Config config = ConfigOf(light_field);
  config.superblock = 256;  // Allocates scratch memory for blocks of any size.
  config.tuning.n_scale = STARFOCUS_MAX_N_SCALE;  // Allows apertures for every sampled N.
  return config;
}

}  // namespace

Error BlockBench::Open(const std::string& where, const LightField& light_field) {
  light_field_ = &light_field;
  const FloatMap& map = light_field.disparity;
  const starfocus_disparity_stats stats = MeasureDisparity(map);
  starfocus_status status = stats.invalid != 0 ? STARFOCUS_ERROR_NOT_FINITE : STARFOCUS_OK;
  if (status == STARFOCUS_OK) status = owner_.Init(MakeConfig(light_field));
  if (status == STARFOCUS_OK) {
    engine_ = reinterpret_cast<EngineState*>(owner_.get());
    // Create apertures for blocks of any N. The aperture has the default shape, as in
    // BlockBench::Focus.
    starfocus::Params params;
    SetOpening(ShapeOf(params), engine_->tables);
    const Demand demand = DemandOf(engine_->tables->opening);
    const int32_t last = LargestN(engine_->config, kSliceRenderer, demand, STARFOCUS_MAX_BLUR);
    status = MakeApertures(kSliceRenderer, last, nullptr, engine_->tables);
  }
  if (status != STARFOCUS_OK) {
    return Expected(where, "a light field that the engine accepts",
                    starfocus_status_string(status));
  }
  picture_ = Image(map.width, map.height);
  HoldDisparity();
  for (int layer = 1; layer < STARFOCUS_LAYERS; ++layer) HoldLayer(layer);
  return {};
}

void BlockBench::HoldDisparity() {
  const FloatMap& map = light_field_->disparity;
  disparity_.resize(map.values.size() + simd::kPadding);
  const Plane<int16_t> disparity = {disparity_.data(), size_t(map.width), 0, 0};
  // Disparities cannot be out of range, because the configuration has the range of the map.
  const FullConfig& config = engine_->config;
  const starfocus_depth_map given = EngineMap(map);
  const simd::DepthRule rule =
      RuleOf(given, float(config.disparity_min), float(config.disparity_max));
  ReadDepth(simd::BestImageKernels(), {given, rule, map.width, map.height, nullptr},
            {0, 0, map.width, map.height}, disparity);
  // The engine only reads the pixels.
  Plane<uint8_t> views[STARFOCUS_MAX_VIEWS];
  for (size_t i = 0; i < light_field_->views.size(); ++i) {
    const Image& view = light_field_->views[i];
    views[i] = {const_cast<uint8_t*>(view.pixels.data()), view.stride(), 0, 0};
  }
  engine_->input = InputOf(config, *engine_->kernels, views, disparity, {});
}

void BlockBench::HoldLayer(int layer) {
  LayerPlane& plane = engine_->layers.planes[layer];
  plane.width = engine_->input.Width(layer);
  plane.height = engine_->input.Height(layer);
  const size_t stride = 3 * size_t(plane.width), rows = size_t(plane.height);
  layer_samples_[layer].resize(stride * rows + simd::kPadding);
  plane.rows = {0, plane.height};
  plane.samples = {layer_samples_[layer].data(), stride, 0, 0};
  // Computes all rows at once, which requires more memory than a worker of the engine has.
  const int32_t step = engine_->config.superblock / 2;
  const auto columns = size_t(TapsOfLayer(step));
  const auto above = size_t(TapsOfLayer(plane.height));
  std::vector<int16_t> even(3 * (columns + 3) + simd::kPadding), odd = even;
  std::vector<int16_t> halved(3 * columns * (2 * above + 5) + simd::kPadding);
  std::vector<int16_t> layer_one(3 * columns * above + simd::kPadding);
  const ResampleScratch scratch = {even.data(), odd.data(), halved.data(), layer_one.data()};
  for (int32_t begin = 0; begin < plane.width; begin += step) {
    const int32_t end = std::min(begin + step, plane.width);
    DownsamplePicture(*engine_->kernels, engine_->input, layer, {begin, end}, scratch, plane);
  }
  engine_->input.layers[layer] = {plane.samples.data, stride, 0, 0};
}

void BlockBench::Focus(const BlockTask& task) {
  FullParams params = DefaultParams();
  params.focus = task.focus;
  params.aperture = task.aperture;
  SetLens(params, engine_);
}

BlockWork BlockBench::Work(const BlockTask& task) {
  Focus(task);
  const Block& block = task.block;
  const Rect& rect = block.rect;
  Content content[2] = {};
  std::vector<Cell> cells(size_t((rect.width + kCellSize - 1) / kCellSize));
  const int first = rect.x / kCellSize;
  for (int y = rect.y; y < rect.y + rect.height; y += kCellSize) {
    MeasureCells(*engine_->kernels, engine_->input, engine_->lens.scale, y / kCellSize,
                 {first, first + int(cells.size())}, cells.data());
    for (const Cell& cell : cells) AddCell(cell, &content);
  }
  const uint64_t upsampled = block.layer == 0 ? 0 : uint64_t(rect.width) * uint64_t(rect.height);
  BlockWork work = kSliceRenderer.measure_work(
      block.rendered, block.border, engine_->lens.weights_by_n[block.n], content, block.layer);
  work.upsample = upsampled;
  return work;
}

uint64_t BlockBench::Time(const BlockTask& task) {
  Focus(task);
  // Disable copying of blocks, since the model describes rendering.
  static const Renderer kAlways = [] {
    Renderer renderer = kSliceRenderer;
    renderer.nothing_moves = [](const RenderJob&) { return false; };
    return renderer;
  }();
  engine_->lens.renderer = &kAlways;
  const Plane<uint8_t> out = {picture_.pixels.data(), picture_.stride(), 0, 0};
  const uint64_t start = ThreadNanoseconds();
  RefocusBlock(*engine_, task.block, out, engine_->scratch);
  return 1000 * (ThreadNanoseconds() - start);
}

}  // namespace starfocus
