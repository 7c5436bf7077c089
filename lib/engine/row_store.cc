// SPDX-License-Identifier: Apache-2.0
#include "lib/engine/row_store.h"

#include <cstring>

#include "lib/base/features.h"
#include "lib/base/fixed.h"
#include "lib/engine/borders.h"
#include "lib/io/gaps.h"
#include "simd/depth_values.h"

namespace starfocus {

void SetViews(const starfocus_config& config, const ViewReader& reader,
              const Plane<const uint8_t>& centre, RowStore* row_store) {
  // Creating the engine has already validated the positions of the views.
  ViewSet set;
  FindViews(config.views, config.positions, config.problem, &set);
  const OcclusionViews occlusion_views = ChooseOcclusionViews(set);
  for (int layer = 0; layer < STARFOCUS_LAYERS; ++layer) {
    Window& window = row_store->windows[layer];
    window.layer = layer;
    window.width = LayerSize(config.width, layer);
    window.height = LayerSize(config.height, layer);
    window.picture_width = config.width;
    window.picture_height = config.height;
    window.views = config.views;
    window.occlusion_views = occlusion_views;
    window.transfer = &TransferOf(config.transfer);
    window.reader = reader;
    window.disparity = {row_store->disparity.data, row_store->disparity.stride,
                        row_store->disparity.rows, 0};
    window.given_coverage = {};
    row_store->layers[layer].width = window.width;
    row_store->layers[layer].height = window.height;
  }
  row_store->windows[0].centre = centre;
}

void SetPlanes(const starfocus_config& config, const simd::Kernels& kernels,
               const Plane<uint8_t>* views, RowStore* row_store) {
  PlaneViews& planes = row_store->planes;
  planes.kernels = &kernels;
  planes.transfer = &TransferOf(config.transfer);
  for (int view = 0; view < config.views; ++view) {
    planes.view[view] = {views[view].data, views[view].stride, views[view].rows, 0};
  }
  SetViews(config, ReaderOf(planes), planes.view[0], row_store);
}

int32_t FillUnknown(const starfocus_config& config, const simd::Kernels& kernels, int16_t* row) {
  int32_t unknown = 0;
  for (int32_t x = 0; x < config.width; ++x) unknown += row[x] == simd::kNoSurface ? 1 : 0;
  const auto is_known = [](int16_t value) { return value != simd::kNoSurface; };
  if (unknown == 0 || FillGaps(row, config.width, is_known)) return unknown;
  const DisparityRange range = RangeOf(config);
  kernels.ConvertDisparity(&range.min, 1, range.min, range.max, row);
  for (int32_t x = 1; x < config.width; ++x) row[x] = row[0];
  return unknown;
}

void ForgetLayers(const starfocus_config& config, RowStore* row_store) {
  for (int layer = 1; layer < STARFOCUS_LAYERS; ++layer) {
    // The ring holds the largest number of rows that a stripe may read, so that rows of the
    // previous stripe are kept.
    row_store->layers[layer].samples.rows = LayerRows(config, layer);
    row_store->layers[layer].rows = {0, 0};
    std::memset(row_store->needed[layer], 0, static_cast<size_t>(Columns(config)));
  }
}

}  // namespace starfocus
