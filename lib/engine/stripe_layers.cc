// SPDX-License-Identifier: Apache-2.0
#include "lib/engine/stripe_layers.h"

#include "lib/engine/reach.h"

namespace starfocus {
namespace {

// Subsamples columns of largest blocks into a layer: job `index` has that column.
struct LayerJob {
  const sf_config* config;
  const simd::Kernels* kernels;
  const Window* picture;    // at layer 0
  const uint8_t* needed;    // ColumnNeed of the layer's columns
  const LayerPlane* above;  // the layer that layer 2 is made of
  const LayerPlane* to;     // its planes are the output
};

template <int kLayer>
void Downsample(const LayerJob& job, int32_t index, Worker* worker) {
  const int need = job.needed[index];
  if ((need & kNeeded) == 0) return;
  LayerPlane missing = *job.to;
  if ((need & kNeededBefore) != 0) missing.rows.first = missing.known;
  if (missing.rows.first == missing.rows.last) return;
  const int32_t side = job.config->largest_block >> kLayer, begin = index * side;
  // The last column takes what a layer has beyond the picture.
  const int32_t end = index + 1 == Columns(*job.config) ? missing.width : begin + side;
  if (kLayer == 1) {
    const int32_t rows = missing.rows.last - missing.rows.first;
    worker->counts.centre_bytes +=
        3 * static_cast<uint64_t>((2 * (end - begin) + 5) * (2 * rows + 5));
    DownsamplePicture(*job.kernels, *job.picture, begin, end, worker->resample, &missing);
  } else {
    DownsampleLayer(*job.kernels, *job.above, begin, end, worker->resample, &missing);
  }
}

bool AnyColumn(const uint8_t* needed, int32_t columns) {
  for (int32_t column = 0; column < columns; ++column) {
    if ((needed[column] & kNeeded) != 0) return true;
  }
  return false;
}

}  // namespace

void ClearLayerColumns(const sf_config& config, Pictures* pictures) {
  for (int layer = 1; layer < SF_LAYERS; ++layer) {
    for (int32_t column = 0; column < Columns(config); ++column) {
      uint8_t& need = pictures->needed[layer][column];
      need = (need & kNeeded) != 0 ? kNeededBefore : 0;
    }
  }
}

void MarkLayerColumns(const sf_config& config, Pictures* pictures) {
  for (int layer = 1; layer <= config.max_layer; ++layer) {
    for (int32_t column = 0; column < Columns(config); ++column) {
      pictures->needed[layer][column] |= kNeeded;
    }
  }
}

void MarkLayerColumns(const sf_config& config, const Block& block, Pictures* pictures) {
  const int32_t side = config.largest_block, scale = 1 << block.layer;
  const int32_t left = (block.rendered.x - block.border.left) * scale;
  const int32_t right = (block.rendered.x + block.rendered.width + block.border.right) * scale;
  for (int layer = block.layer; layer > 0; --layer) {
    // Layer 2 is made of layer 1 by a filter of 3 pixels' reach, 6 of the picture.
    const int32_t reach = layer < block.layer ? 8 : 0;
    const int32_t first = Max(0, (left - reach) / side);
    const int32_t last = Min(Columns(config) - 1, (right + reach) / side);
    for (int32_t column = first; column <= last; ++column) {
      pictures->needed[layer][column] |= kNeeded;
    }
  }
}

void PlaceLayers(const RowRange& of_picture, Pictures* pictures) {
  RowRange rows = {of_picture.first >> 2, (of_picture.last >> 2) + 1};
  for (int layer = SF_LAYERS - 1; layer > 0; --layer) {
    LayerPlane& plane = pictures->layers[layer];
    const RowRange inside = {Max(0, rows.first), Min(plane.height, rows.last)};
    // Layer 2 is made anew: of the columns beside those it was needed in, layer 1 may have lacked.
    const bool kept = layer == 1 && plane.rows.first <= inside.first;
    plane.known = kept ? Clamp(plane.rows.last, inside.first, inside.last) : inside.first;
    plane.rows = inside;
    plane.samples.first = plane.rows.first;
    plane.half.first = 2 * plane.rows.first - 3;
    rows = {2 * rows.first - 3, 2 * rows.last + 3};
    pictures->windows[layer].samples = {plane.samples.data, plane.samples.stride,
                                        plane.samples.rows, plane.samples.first};
  }
}

sf_status FillLayers(const sf_config& config, const simd::Kernels& kernels, const Runner& runner,
                     Crew* crew, Pictures* pictures) {
  const int32_t columns = Columns(config);
  const LayerPlane* layers = pictures->layers;
  const Window* picture = &pictures->windows[0];
  sf_status status = SF_OK;
  if (AnyColumn(pictures->needed[1], columns)) {
    const LayerJob job = {&config, &kernels, picture, pictures->needed[1], nullptr, &layers[1]};
    status = RunJobs<LayerJob, Downsample<1>>(job, columns, runner, crew);
  }
  if (status == SF_OK && AnyColumn(pictures->needed[2], columns)) {
    const LayerJob job = {&config, &kernels, picture, pictures->needed[2], &layers[1], &layers[2]};
    status = RunJobs<LayerJob, Downsample<2>>(job, columns, runner, crew);
  }
  return status;
}

}  // namespace starfocus
