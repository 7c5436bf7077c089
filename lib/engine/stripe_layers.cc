#include "lib/engine/stripe_layers.h"

#include <cstring>

namespace starfocus {
namespace {

struct LayerJob {
  EngineState* engine;
};

template <int kLayer>
void Downsample(const LayerJob& job, int32_t index, Worker* worker) {
  EngineState& engine = *job.engine;
  const int need = engine.plan.needed[kLayer][index];
  if ((need & kNeeded) == 0) return;
  LayerPlane missing = engine.layers[kLayer], *to = &missing;
  if ((need & kNeededBefore) != 0) to->rows.first = to->known;
  if (to->rows.first == to->rows.last) return;
  const int32_t side = BlockSide(engine) >> kLayer;
  const int32_t begin = index * side;
  // The last column takes what a layer has beyond the picture.
  const int32_t end = index + 1 == Columns(engine) ? to->width : begin + side;
  if (kLayer == 1) {
    const int32_t rows = to->rows.last - to->rows.first;
    worker->counts.centre_bytes +=
        3 * static_cast<uint64_t>((2 * (end - begin) + 5) * (2 * rows + 5));
    DownsamplePicture(*engine.kernels, engine.windows[0].centre, engine.config.width,
                      engine.config.height, begin, end, worker->resample, to);
  } else {
    DownsampleLayer(*engine.kernels, engine.layers[kLayer - 1], begin, end, worker->resample, to);
  }
}

void Mark(const EngineState& engine, int layer, int32_t column) {
  engine.plan.needed[layer][column] |= kNeeded;
}

bool AnyColumn(const EngineState& engine, int layer) {
  int any = 0;
  for (int32_t column = 0; column < Columns(engine); ++column) {
    any |= engine.plan.needed[layer][column];
  }
  return (any & kNeeded) != 0;
}

// Layer 1 lies in rings, of as many rows as a stripe may need: what the stripe before made stays.
void PlaceInRings(const sf_config& config, LayerPlane* plane) {
  plane->rgb.rows = plane->samples.rows = LayerRows(config, 1);
}

}  // namespace

void ClearLayerColumns(const EngineState& engine) {
  for (int layer = 1; layer < SF_LAYERS; ++layer) {
    for (int32_t column = 0; column < Columns(engine); ++column) {
      uint8_t& need = engine.plan.needed[layer][column];
      need = (need & kNeeded) != 0 ? kNeededBefore : 0;
    }
  }
}

void MarkLayerColumns(const EngineState& engine) {
  for (int layer = 1; layer <= engine.config.max_layer; ++layer) {
    for (int32_t column = 0; column < Columns(engine); ++column) Mark(engine, layer, column);
  }
}

void MarkLayerColumns(const EngineState& engine, const Block& block) {
  const int32_t scale = 1 << block.layer;
  const int32_t left = (block.rendered.x - block.border.left) * scale;
  const int32_t right = (block.rendered.x + block.rendered.width + block.border.right) * scale;
  for (int layer = block.layer; layer > 0; --layer) {
    // Layer 2 is made of layer 1 by a filter of 3 pixels' reach, 6 of the picture.
    const int32_t reach = layer < block.layer ? 8 : 0;
    const int32_t first = Max(0, (left - reach) / BlockSide(engine));
    const int32_t last = Min(Columns(engine) - 1, (right + reach) / BlockSide(engine));
    for (int32_t column = first; column <= last; ++column) {
      Mark(engine, layer, column);
    }
  }
}

void ForgetLayers(EngineState* engine) {
  PlaceInRings(engine->config, &engine->layers[1]);
  for (int layer = 1; layer < SF_LAYERS; ++layer) {
    engine->layers[layer].rows = {0, 0};
    std::memset(engine->plan.needed[layer], 0, static_cast<size_t>(Columns(*engine)));
  }
}

void PlaceLayers(const RowRange& of_picture, EngineState* engine) {
  RowRange rows = {of_picture.first >> 2, (of_picture.last >> 2) + 1};
  for (int layer = SF_LAYERS - 1; layer > 0; --layer) {
    LayerPlane& plane = engine->layers[layer];
    const RowRange inside = {Max(0, rows.first), Min(plane.height, rows.last)};
    // Layer 2 is made anew: of the columns beside those it was needed in, layer 1 may have lacked.
    const bool kept = layer == 1 && plane.rows.first <= inside.first;
    plane.known = kept ? Clamp(plane.rows.last, inside.first, inside.last) : inside.first;
    plane.rows = inside;
    plane.rgb.first = plane.samples.first = plane.rows.first;
    plane.half.first = 2 * plane.rows.first - 3;
    rows = {2 * rows.first - 3, 2 * rows.last + 3};
    engine->windows[layer].centre = {plane.rgb.data, plane.rgb.stride, plane.rgb.rows,
                                     plane.rgb.first};
  }
}

sf_status FillLayers(EngineState* engine, const Runner& runner) {
  const LayerJob job = {engine};
  const int32_t columns = Columns(*engine);
  sf_status status = SF_OK;
  if (AnyColumn(*engine, 1)) {
    status = RunJobs<LayerJob, Downsample<1>>(job, columns, runner);
  }
  if (status == SF_OK && AnyColumn(*engine, 2)) {
    status = RunJobs<LayerJob, Downsample<2>>(job, columns, runner);
  }
  return status;
}

}  // namespace starfocus
