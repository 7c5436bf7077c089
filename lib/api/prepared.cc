// SPDX-License-Identifier: Apache-2.0
#include "lib/api/prepared.h"

#include <new>

#include "lib/api/light_field.h"
#include "lib/base/view_set.h"
#include "lib/engine/layout.h"
#include "lib/engine/stripe_layers.h"

namespace starfocus {
namespace {

// Converts the map into rows of `to`.
sf_status ConvertMap(const EngineState& engine, const sf_light_field& light_field,
                     const Plane<int16_t>& to) {
  for (int32_t y = 0; y < engine.config.height; ++y) {
    if (!engine.crew.workers[0].patience.Spend(engine.config.width)) return SF_ERROR_CANCELLED;
    int32_t unknown = 0;
    const sf_status status = ConvertDisparity(engine.config, *engine.kernels,
                                              DisparityRow(light_field, y), to.Row(y), &unknown);
    if (status != SF_OK) return status;
  }
  return SF_OK;
}

}  // namespace

size_t LayOutPrepared(const sf_config& config, void* base, Prepared** prepared) {
  Carver carver(base);
  *prepared = carver.Take<Prepared>(1);
  Prepared counted;  // stands in for **prepared while counting
  Prepared& p = *prepared == nullptr ? counted : **prepared;
  const auto width = static_cast<size_t>(config.width), height = static_cast<size_t>(config.height);
  if (config.images != 0) p.images = carver.Take<sf_image_field>(1);
  p.disparity.stride = width;
  p.disparity.data = carver.Take<int16_t>(width, height);
  for (int layer = 1; layer <= config.max_layer; ++layer) {
    Plane<int16_t>& plane = p.layers[layer];
    plane.stride = 3 * static_cast<size_t>(LayerSize(config.width, layer));
    plane.data =
        carver.Take<int16_t>(plane.stride, static_cast<size_t>(LayerSize(config.height, layer)));
  }
  for (int shift = 1; shift <= config.previews; ++shift) {
    TakeReduced(config, shift, &carver, &p.reduced[shift]);
  }
  return carver.Bytes();
}

sf_status CheckPreparedMemory(const EngineState& engine, const void* memory, size_t bytes,
                              Extent* extent) {
  const sf_status status = CheckMemory(memory);
  if (status != SF_OK) return status;
  Prepared* counted = nullptr;
  const size_t needed = LayOutPrepared(engine.config, nullptr, &counted);
  if (needed == kTooLarge) return SF_ERROR_TOO_LARGE;
  if (bytes < needed) return SF_ERROR_WORKSPACE_SMALL;
  *extent = ExtentOf(memory, 0, 1, needed);
  return Overlaps(*extent, Workspace(engine)) ? SF_ERROR_OVERLAP : SF_OK;
}

sf_status MakeLayers(const Prepared& prepared, const RowSource& source, const Runner& runner,
                     EngineState* engine) {
  LayerPlane own[SF_LAYERS];
  for (int layer = 0; layer < SF_LAYERS; ++layer) own[layer] = engine->pictures.layers[layer];
  const int32_t height = engine->config.height, side = engine->config.largest_block;
  // Layers end beyond the picture (LayerSize), by fewer than so many of its pixels; PlaceLayers
  // leaves out what lies beyond them.
  constexpr int32_t kBeyond = 16;
  RowRange read = {0, 0};
  sf_status status = SF_OK;
  for (int32_t y = 0; y < height && status == SF_OK; y += side) {
    ForgetLayers(engine->config, &engine->pictures);
    MarkLayerColumns(engine->config, &engine->pictures);
    PlaceLayers({y, y + side < height ? y + side : height + kBeyond}, Reach(), &engine->pictures);
    for (int layer = 1; layer <= engine->config.max_layer; ++layer) {
      engine->pictures.layers[layer].samples.rows = 0;
      engine->pictures.layers[layer].samples.data =
          prepared.layers[layer].Row(engine->pictures.layers[layer].rows.first);
    }
    engine->crew.jobs.watch.SetRows(y);
    if (source.read != nullptr) {
      // The filters' taps reach as far below the stripe.
      read = {read.last, Min(height, y + side + kBeyond)};
      status = source.read(source.field, read, prepared.disparity, runner, engine);
      if (status != SF_OK) break;
    }
    status = FillLayers(engine->config, *engine->kernels, runner, &engine->crew, &engine->pictures);
    if (status != SF_OK) break;
    status = ReduceRows(prepared.disparity, {y, Min(y + side, height)}, prepared.config.previews,
                        prepared.reduced, runner, engine);
  }
  for (int layer = 0; layer < SF_LAYERS; ++layer) engine->pictures.layers[layer] = own[layer];
  ForgetLayers(engine->config, &engine->pictures);
  return status;
}

bool Fits(const Prepared& prepared, const sf_config& config) {
  const sf_config& made = prepared.config;
  return made.width == config.width && made.height == config.height && SameViews(made, config) &&
         made.disparity_min == config.disparity_min && made.disparity_max == config.disparity_max &&
         made.max_layer == config.max_layer && made.transfer == config.transfer;
}

Extent PreparedMemory(const Prepared& prepared) {
  Prepared* counted = nullptr;
  return ExtentOf(&prepared, 0, 1, LayOutPrepared(prepared.config, nullptr, &counted));
}

void UsePrepared(const Prepared& prepared, EngineState* engine) {
  const Plane<int16_t>& disparity = prepared.disparity;
  for (int layer = 0; layer < SF_LAYERS; ++layer) {
    engine->pictures.windows[layer].disparity = {disparity.data, disparity.stride, 0, 0};
    const Plane<int16_t>& plane = prepared.layers[layer];
    if (layer > 0) engine->pictures.windows[layer].samples = {plane.data, plane.stride, 0, 0};
  }
  engine->pictures.prepared = true;
}

}  // namespace starfocus

using starfocus::EngineState;
using starfocus::Prepared;

sf_status sf_prepared_size(const sf_config* config, size_t* bytes) {
  if (config == nullptr || bytes == nullptr) return SF_ERROR_NULL;
  const sf_status status = starfocus::CheckConfig(*config);
  if (status != SF_OK) return status;
  Prepared* counted = nullptr;
  const size_t needed = starfocus::LayOutPrepared(*config, nullptr, &counted);
  if (needed == starfocus::kTooLarge) return SF_ERROR_TOO_LARGE;
  *bytes = needed;
  return SF_OK;
}

sf_status sf_prepare(sf_engine* engine, const sf_light_field* light_field, void* memory,
                     size_t bytes, sf_progress progress, void* progress_data, sf_runner runner,
                     void* runner_data, sf_prepared** prepared) {
  if (prepared == nullptr) return SF_ERROR_NULL;
  *prepared = nullptr;
  if (engine == nullptr || light_field == nullptr) return SF_ERROR_NULL;
  EngineState& e = *reinterpret_cast<EngineState*>(engine);
  sf_status status = starfocus::CheckLightField(e.config, *light_field);
  starfocus::Extent extent;
  if (status == SF_OK) status = starfocus::CheckPreparedMemory(e, memory, bytes, &extent);
  if (status != SF_OK) return status;
  if (starfocus::OverlapsLightField(extent, e.config, *light_field)) return SF_ERROR_OVERLAP;
  e.stream.active = false;
  starfocus::Watch& watch = e.crew.jobs.watch;
  watch.Begin(progress, progress_data, 0, e.config.height);
  // The map is converted into the engine's own ring first, only to be checked: the caller's memory
  // stays as it is when a row is bad.
  status = starfocus::ConvertMap(e, *light_field, e.pictures.disparity);
  if (status != SF_OK) return status;
  new (memory) Prepared();
  Prepared* made = nullptr;
  starfocus::LayOutPrepared(e.config, memory, &made);
  made->images = nullptr;
  made->config = e.config;
  made->light_field = *light_field;
  status = starfocus::ConvertMap(e, *light_field, made->disparity);
  if (status != SF_OK) return status;
  starfocus::SetPictures(*light_field, &e);
  status = starfocus::MakeLayers(*made, {nullptr, nullptr}, {runner, runner_data}, &e);
  if (status != SF_OK) return status;
  watch.SetRows(e.config.height);
  if (!watch.Ask()) return SF_ERROR_CANCELLED;
  *prepared = reinterpret_cast<sf_prepared*>(made);
  return SF_OK;
}
