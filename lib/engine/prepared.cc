// SPDX-License-Identifier: Apache-2.0
#include "lib/engine/prepared.h"

#include <new>

#include "lib/engine/layout.h"
#include "lib/engine/stripe_layers.h"
#include "lib/optics/view_set.h"

namespace starfocus {
namespace {

// Largest number of rows of the picture that the filters of the layers read beyond a stripe.
constexpr int32_t kBeyond = 16;

// Rows of one stripe of the picture.
struct PreparedStripe {
  Range rows;
  bool is_last;
};

// Computes the rows of layer 1 of a stripe from the picture, and the rows of layer 2 whose source
// rows are complete. `two` are the rows of layer 2 of the previous stripe, and are replaced by the
// rows of this stripe. Computing layer 2 from layer 1 halves the number of codes that are decoded.
starfocus_status MakeLayers(const Prepared& prepared, const PreparedStripe& stripe, Range* two,
                            EngineState* engine) {
  // Layers extend beyond the picture (LayerSize) by fewer than kBeyond pixels of the picture.
  // PlaceLayers omits rows outside the layers.
  const starfocus_config& config = engine->config;
  StripeLayers* const store = &engine->layers;
  const int32_t most = config.tuning.max_layer;
  ForgetLayers(config, store);
  MarkLayerColumns(config, store);
  PlaceLayers({stripe.rows.first, stripe.is_last ? config.height + kBeyond : stripe.rows.last},
              Borders(), engine);
  for (int layer = 1; layer <= most; ++layer) {
    store->planes[layer].samples = prepared.layers[layer];
  }
  LayerPlane& second = store->planes[2];
  const LayerPlane& first = store->planes[1];
  const starfocus_status status = FillLayers({1, 2}, nullptr, engine);
  // Row y of layer 2 depends on the rows of layer 1 before 2 * y + 4.
  *two = {two->last, stripe.is_last ? second.height : Max(two->last, first.rows.last / 2 - 1)};
  second.rows = *two;
  if (status != STARFOCUS_OK || most < 2) return status;
  return FillLayers({2, 3}, &first, engine);
}

// Converts the map and computes the layers and reduced light fields into the planes of `prepared`.
starfocus_status MakePlanes(const Prepared& prepared, EngineState* engine) {
  const StripeLayers own = engine->layers;
  const int32_t height = engine->config.height, side = engine->config.superblock;
  Range read = {0, 0}, two = {0, 0};
  starfocus_status status = STARFOCUS_OK;
  for (int32_t y = 0; y < height && status == STARFOCUS_OK; y += side) {
    engine->jobs->call_progress.SetRows(y);
    // The filters of the layers read up to kBeyond rows below the rows that they process.
    read = {read.last, Min(height, y + side + kBeyond)};
    status = ReadRows(read, &prepared.disparity, engine);
    if (status != STARFOCUS_OK) break;
    const Range rows = {y, Min(y + side, height)};
    status = MakeLayers(prepared, {rows, rows.last == height}, &two, engine);
    if (status != STARFOCUS_OK) break;
    status =
        ReduceRows(prepared.disparity, rows, prepared.config.previews, prepared.reduced, engine);
  }
  engine->layers = own;
  ForgetLayers(engine->config, &engine->layers);
  return status;
}

}  // namespace

size_t LayOutPrepared(const starfocus_config& config, void* base, Prepared** prepared) {
  Arena arena(base);
  *prepared = arena.Take<Prepared>(1);
  Prepared counted;  // used instead of **prepared if `base` is null
  Prepared& p = *prepared == nullptr ? counted : **prepared;
  const auto width = static_cast<size_t>(config.width), height = static_cast<size_t>(config.height);
  p.disparity.stride = width;
  p.disparity.data = arena.Take<int16_t>(width, height);
  for (int layer = 1; layer <= config.tuning.max_layer; ++layer) {
    Plane<int16_t>& plane = p.layers[layer];
    plane.stride = 3 * static_cast<size_t>(LayerSize(config.width, layer));
    plane.data =
        arena.Take<int16_t>(plane.stride, static_cast<size_t>(LayerSize(config.height, layer)));
  }
  for (int shift = 1; shift <= config.previews; ++shift) {
    TakeReduced(config, shift, &arena, &p.reduced[shift]);
  }
  return arena.Bytes();
}

starfocus_status Prepare(const PrepareCall& call, EngineState* engine, Prepared** prepared) {
  const int32_t height = engine->config.height;
  CallProgress& call_progress = engine->jobs->call_progress;
  engine->stream.active = false;
  call_progress.Begin(0, height);
  starfocus_status status = ReadRows({0, height}, nullptr, engine);
  if (status != STARFOCUS_OK) return status;
  new (call.memory) Prepared();
  Prepared* made = nullptr;
  LayOutPrepared(engine->config, call.memory, &made);
  made->config = engine->config;
  made->covers = engine->input.given_coverage.data != nullptr;
  status = MakePlanes(*made, engine);
  if (status != STARFOCUS_OK) return status;
  call_progress.SetRows(height);
  if (!call_progress.Ask()) return STARFOCUS_ERROR_CANCELLED;
  *prepared = made;
  return STARFOCUS_OK;
}

bool Fits(const Prepared& prepared, const starfocus_config& config) {
  const starfocus_config& made = prepared.config;
  return made.width == config.width && made.height == config.height && SameViews(made, config) &&
         made.disparity_min == config.disparity_min && made.disparity_max == config.disparity_max &&
         made.tuning.max_layer == config.tuning.max_layer && made.transfer == config.transfer;
}

Extent PreparedMemory(const Prepared& prepared) {
  Prepared* counted = nullptr;
  return ExtentOf(&prepared, 0, 1, LayOutPrepared(prepared.config, nullptr, &counted));
}

Input InputOf(const Prepared& prepared, const Input& views) {
  Input in = views;
  in.map = {};
  in.disparity = {prepared.disparity.data, prepared.disparity.stride, 0, 0};
  for (int layer = 1; layer < STARFOCUS_LAYERS; ++layer) {
    in.layers[layer] = {prepared.layers[layer].data, prepared.layers[layer].stride, 0, 0};
  }
  in.has_layers = true;
  return in;
}

}  // namespace starfocus
