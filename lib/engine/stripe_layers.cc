// SPDX-License-Identifier: Apache-2.0
// Subsamples the centre view around a stripe to layers 1 and 2.
#include "lib/engine/stripe.h"
#include "lib/optics/rules.h"

namespace starfocus {
namespace {

// Subsamples the picture or, if it is not null, layer 1 into column `index` of superblocks of a
// layer.
void DownsampleColumn(const EngineState& engine, const LayerPlane* layer_one, int32_t layer,
                      int32_t index, const ResampleScratch& scratch) {
  const int need = engine.layers.needed[layer][index];
  if ((need & kNeeded) == 0) return;
  LayerPlane missing = engine.layers.planes[layer];
  if ((need & kNeededBefore) != 0) missing.rows.first = missing.known;
  if (missing.rows.first == missing.rows.last) return;
  const int32_t side = engine.config.superblock >> layer, begin = index * side;
  // The last column of superblocks includes the pixels of a layer that lie beyond the picture.
  const int32_t end = index + 1 == Columns(engine.config) ? missing.width : begin + side;
  if (layer_one != nullptr) {
    DownsampleLayer(*engine.kernels, *layer_one, kDownFilter, {begin, end}, scratch, missing);
  } else {
    DownsamplePicture(*engine.kernels, engine.input, layer, {begin, end}, scratch, missing);
  }
}

// Subsamples a pass into column `index` of superblocks of its layers.
void DownsamplePass(const EngineState& engine, Pass pass, int32_t index, const Scratch& scratch) {
  const Input in = InputOf(engine, pass, scratch);
  for (int32_t layer = 1; layer <= engine.config.tuning.max_layer; ++layer) {
    if ((engine.layers.needed[layer][index] & kNeeded) == 0) continue;
    const LayerPlane& plane = engine.pass_layers[pass][layer];
    const int32_t side = engine.config.superblock >> layer, begin = index * side;
    const int32_t end = index + 1 == Columns(engine.config) ? plane.width : begin + side;
    DownsamplePicture(*engine.kernels, in, layer, {begin, end}, scratch.resample, plane);
  }
}

bool NeedsPass(const EngineState& engine, Pass pass) {
  const StripePlan& plan = engine.stripe.plan;
  for (int32_t k = 0; k < plan.used; ++k) {
    if (plan.blocks[k].passes[pass]) return true;
  }
  return false;
}

bool AnyColumn(const uint8_t* needed, int32_t columns) {
  for (int32_t column = 0; column < columns; ++column) {
    if ((needed[column] & kNeeded) != 0) return true;
  }
  return false;
}

}  // namespace

void TakeResample(const FullConfig& config, Arena* arena, ResampleScratch* resample) {
  // The last column of superblocks includes one or two pixels of a layer that lie beyond the
  // picture.
  const auto side = config.superblock;
  const auto columns = static_cast<size_t>(Max(side / 2 + 1, TapsOfLayer(side / 4 + 2)));
  const int32_t above_two = TapsOfLayer(LayerRows(config, 2));
  const auto rows = static_cast<size_t>(TapsOfLayer(Max(LayerRows(config, 1), above_two)));
  resample->even = arena->Take<int16_t>(3 * (columns + 3));
  resample->odd = arena->Take<int16_t>(3 * (columns + 3));
  resample->half = arena->Take<int16_t>(3 * columns, rows);
  resample->above = arena->Take<int16_t>(3 * columns, static_cast<size_t>(above_two));
}

void TakeLayers(const FullConfig& config, Arena* arena, StripeLayers* layers) {
  for (int layer = 1; layer <= config.tuning.max_layer; ++layer) {
    const auto width = static_cast<size_t>(LayerSize(config.width, layer));
    layers->planes[layer].samples = TakePlane<int16_t>(3 * width, LayerRows(config, layer), arena);
  }
  for (int layer = 1; layer < STARFOCUS_LAYERS; ++layer) {
    layers->needed[layer] = arena->Take<uint8_t>(static_cast<size_t>(Columns(config)));
  }
}

void TakePassLayers(const FullConfig& config, Arena* arena, EngineState* engine) {
  const bool deep = HasDeep(config);
  for (int pass = kExcessPass; pass < kPassCount; ++pass) {
    for (int layer = 1; layer <= config.tuning.max_layer; ++layer) {
      LayerPlane& plane = engine->pass_layers[pass][layer];
      plane = {};
      plane.width = LayerSize(config.width, layer);
      plane.height = LayerSize(config.height, layer);
      if (!deep && (pass != kExcessPass || config.highlights <= 1)) continue;
      plane.samples =
          TakePlane<int16_t>(3 * static_cast<size_t>(plane.width), LayerRows(config, layer), arena);
    }
  }
}

void ClearLayerColumns(const FullConfig& config, StripeLayers* layers) {
  for (int layer = 1; layer < STARFOCUS_LAYERS; ++layer) {
    for (int32_t column = 0; column < Columns(config); ++column) {
      uint8_t& need = layers->needed[layer][column];
      need = (need & kNeeded) != 0 ? kNeededBefore : 0;
    }
  }
}

void MarkLayerColumns(const FullConfig& config, StripeLayers* layers) {
  for (int layer = 1; layer <= config.tuning.max_layer; ++layer) {
    for (int32_t column = 0; column < Columns(config); ++column) {
      layers->needed[layer][column] |= kNeeded;
    }
  }
}

void MarkLayerColumns(const FullConfig& config, const Block& block, StripeLayers* layers) {
  if (block.layer == 0) return;
  const int32_t side = config.superblock, scale = 1 << block.layer;
  int32_t left = block.rendered.x - block.border.left;
  int32_t right = block.rendered.x + block.rendered.width + block.border.right;
  if (block.gathers) {
    const Rect frame = LayerFrame(block.rect, block.layer);
    left = block.rendered.width > 0 ? Min(left, frame.x - kMaxGather) : frame.x - kMaxGather;
    right = Max(right, frame.x + frame.width + kMaxGather);
  }
  const int32_t first = Max(0, left * scale / side);
  const int32_t last = Min(Columns(config) - 1, right * scale / side);
  for (int32_t column = first; column <= last; ++column) {
    layers->needed[block.layer][column] |= kNeeded;
  }
}

void PlaceLayers(const Range& of_picture, const Borders& borders, EngineState* engine) {
  for (int layer = 1; layer < STARFOCUS_LAYERS; ++layer) {
    LayerPlane& plane = engine->layers.planes[layer];
    const int32_t beyond = borders.layer[layer];
    const int32_t last = (of_picture.last + (1 << layer) - 1) >> layer;
    const Range inside = {Max(0, (of_picture.first >> layer) - beyond),
                          Min(plane.height, last + beyond)};
    const bool kept = plane.rows.first <= inside.first;
    plane.known = kept ? Clamp(plane.rows.last, inside.first, inside.last) : inside.first;
    plane.rows = inside;
    plane.samples.first = plane.rows.first;
    engine->input.layers[layer] = {plane.samples.data, plane.samples.stride, plane.samples.rows,
                                   plane.samples.first};
  }
}

starfocus_status FillLayers(const Range& layers, const LayerPlane* layer_one, EngineState* engine) {
  const int32_t columns = Columns(engine->config);
  bool any = false;
  for (int32_t layer = layers.first; layer < layers.last; ++layer) {
    any = any || AnyColumn(engine->layers.needed[layer], columns);
  }
  if (!any) return STARFOCUS_OK;
  return ForEach(columns, engine->jobs, [&](int32_t column, int32_t worker) {
    for (int32_t layer = layers.first; layer < layers.last; ++layer) {
      DownsampleColumn(*engine, layer_one, layer, column, engine->scratch[worker].resample);
    }
  });
}

starfocus_status FillPassLayers(const Range& stripe, EngineState* engine) {
  bool needs[kPassCount] = {};
  for (int pass = kExcessPass; pass < kPassCount; ++pass) {
    needs[pass] = NeedsPass(*engine, static_cast<Pass>(pass));
    if (!needs[pass]) continue;
    for (int layer = 1; layer <= engine->config.tuning.max_layer; ++layer) {
      LayerPlane& plane = engine->pass_layers[pass][layer];
      const int32_t beyond = engine->lens.borders.layer[layer];
      plane.rows = {Max(0, (stripe.first >> layer) - beyond),
                    Min(plane.height, ((stripe.last + (1 << layer) - 1) >> layer) + beyond)};
      plane.samples.first = plane.rows.first;
    }
  }
  if (!needs[kExcessPass] && !needs[kAlphaPass]) return STARFOCUS_OK;
  return ForEach(Columns(engine->config), engine->jobs, [&](int32_t column, int32_t worker) {
    for (int pass = kExcessPass; pass < kPassCount; ++pass) {
      if (!needs[pass]) continue;
      DownsamplePass(*engine, static_cast<Pass>(pass), column, engine->scratch[worker]);
    }
  });
}

}  // namespace starfocus
