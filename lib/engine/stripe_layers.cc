// SPDX-License-Identifier: Apache-2.0
#include "lib/engine/stripe_layers.h"

#include "lib/optics/rules.h"

namespace starfocus {
namespace {

// Subsamples columns of superblocks into layers. Job `index` processes column `index`.
struct LayerJob {
  const starfocus_config& config;
  const simd::Kernels& kernels;
  const LayerInterval& interval;
  const RowStore& row_store;  // The picture, the marked columns, and the planes of the layers.
};

void DownsampleInto(const LayerJob& job, int32_t layer, int32_t index, Scratch* scratch) {
  const int need = job.row_store.needed[layer][index];
  if ((need & kNeeded) == 0) return;
  LayerPlane missing = job.row_store.layers[layer];
  if ((need & kNeededBefore) != 0) missing.rows.first = missing.known;
  if (missing.rows.first == missing.rows.last) return;
  const int32_t side = job.config.superblock >> layer, begin = index * side;
  // The last column of superblocks includes the pixels of a layer that lie beyond the picture.
  const int32_t end = index + 1 == Columns(job.config) ? missing.width : begin + side;
  const LayerTarget to = {layer, begin, end, &missing};
  if (job.interval.layer_one != nullptr) {
    DownsampleLayer(job.kernels, *job.interval.layer_one, scratch->resample, to);
  } else {
    DownsamplePicture(job.kernels, job.row_store.windows[0], scratch->resample, to);
  }
}

void DownsampleColumn(const LayerJob& job, int32_t index, Scratch* scratch) {
  for (int32_t layer = job.interval.first; layer <= job.interval.last; ++layer)
    DownsampleInto(job, layer, index, scratch);
}

bool AnyColumn(const uint8_t* needed, int32_t columns) {
  for (int32_t column = 0; column < columns; ++column) {
    if ((needed[column] & kNeeded) != 0) return true;
  }
  return false;
}

}  // namespace

void ClearLayerColumns(const starfocus_config& config, RowStore* row_store) {
  for (int layer = 1; layer < STARFOCUS_LAYERS; ++layer) {
    for (int32_t column = 0; column < Columns(config); ++column) {
      uint8_t& need = row_store->needed[layer][column];
      need = (need & kNeeded) != 0 ? kNeededBefore : 0;
    }
  }
}

void MarkLayerColumns(const starfocus_config& config, RowStore* row_store) {
  for (int layer = 1; layer <= config.tuning.max_layer; ++layer) {
    for (int32_t column = 0; column < Columns(config); ++column) {
      row_store->needed[layer][column] |= kNeeded;
    }
  }
}

void MarkLayerColumns(const starfocus_config& config, const Block& block, RowStore* row_store) {
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
    row_store->needed[block.layer][column] |= kNeeded;
  }
}

void PlaceLayers(const RowRange& of_picture, const Borders& borders, RowStore* row_store) {
  for (int layer = 1; layer < STARFOCUS_LAYERS; ++layer) {
    LayerPlane& plane = row_store->layers[layer];
    const int32_t beyond = borders.layer[layer];
    const int32_t last = (of_picture.last + (1 << layer) - 1) >> layer;
    const RowRange inside = {Max(0, (of_picture.first >> layer) - beyond),
                             Min(plane.height, last + beyond)};
    const bool kept = plane.rows.first <= inside.first;
    plane.known = kept ? Clamp(plane.rows.last, inside.first, inside.last) : inside.first;
    plane.rows = inside;
    plane.samples.first = plane.rows.first;
    row_store->windows[layer].samples = {plane.samples.data, plane.samples.stride,
                                         plane.samples.rows, plane.samples.first};
  }
}

starfocus_status FillLayers(const starfocus_config& config, const simd::Kernels& kernels,
                            const LayerInterval& layers, Workers* workers, RowStore* row_store) {
  const int32_t columns = Columns(config);
  bool any = false;
  for (int32_t layer = layers.first; layer <= layers.last; ++layer) {
    any = any || AnyColumn(row_store->needed[layer], columns);
  }
  if (!any) return STARFOCUS_OK;
  const LayerJob job = {config, kernels, layers, *row_store};
  return RunJobs<LayerJob, DownsampleColumn>(job, columns, workers);
}

}  // namespace starfocus
