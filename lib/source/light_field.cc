// SPDX-License-Identifier: Apache-2.0
#include "lib/source/light_field.h"

#include <cstring>

namespace starfocus {
namespace {

uint8_t* At(const Picture& picture, int32_t x, int32_t y) {
  return picture.data + static_cast<size_t>(y - picture.rect.y) * picture.stride +
         3 * static_cast<size_t>(x - picture.rect.x);
}

// Copies columns [first, last) of a row.
void CopyColumns(const Picture& picture, const Plane<uint8_t>& from, int32_t y, int32_t first,
                 int32_t last) {
  if (first >= last) return;
  std::memcpy(At(picture, first, y), from.Row(y) + 3 * static_cast<size_t>(first),
              3 * static_cast<size_t>(last - first));
}

// Copies what changed of a row.
void CopyFrameDiff(const Picture& picture, const Plane<uint8_t>& from, int32_t y,
                   const EngineState& engine) {
  const Rect& rect = picture.rect;
  const int32_t side = engine.config.largest_block, reach = engine.lens.borders.joined;
  for (int32_t column = 0; column < Columns(engine.config); ++column) {
    const int32_t x = column * side;
    if (!HasChanged(engine.stripe.changes, {x, y - reach, side, 1 + 2 * reach})) continue;
    CopyColumns(picture, from, y, Max(x - reach, rect.x),
                Min(x + side + reach, rect.x + rect.width));
  }
}

sf_status Store(const void* self, const RowRange& rows, const Plane<uint8_t>& from,
                EngineState* engine) {
  const auto& picture = *static_cast<const Picture*>(self);
  const Rect& rect = picture.rect;
  for (int32_t y = rows.first; y < rows.last; ++y) {
    if (picture.previous == nullptr) {
      CopyColumns(picture, from, y, rect.x, rect.x + rect.width);
      continue;
    }
    std::memcpy(
        At(picture, rect.x, y),
        picture.previous->out + static_cast<size_t>(y - rect.y) * picture.previous->out_stride,
        3 * static_cast<size_t>(rect.width));
    CopyFrameDiff(picture, from, y, *engine);
  }
  return SF_OK;
}

}  // namespace

LightFieldRows::LightFieldRows(const sf_light_field& light_field, int32_t first,
                               const EngineState& engine)
    : engine_(engine),
      disparity_{light_field.disparity, light_field.disparity_stride / sizeof(float), 0, first},
      coverage_{light_field.coverage, light_field.coverage_stride, 0, first} {
  planes_.kernels = engine.kernels;
  planes_.transfer = &TransferOf(engine.config.transfer);
  for (int view = 0; view < engine.config.views; ++view) {
    planes_.view[view] = {light_field.views[view].data, light_field.views[view].stride, 0, first};
  }
}

uint32_t LightFieldRows::ReadMap(const void* self, int32_t y, int16_t* out, uint64_t* bytes) {
  const auto& rows = *static_cast<const LightFieldRows*>(self);
  const sf_config& config = rows.engine_.config;
  *bytes += sizeof(float) * static_cast<uint64_t>(config.width);
  return ConvertDisparities(config, *rows.engine_.kernels, rows.disparity_.Row(y), out);
}

void LightFieldRows::ReadCoverage(const void* self, int32_t y, uint8_t* out) {
  const auto& rows = *static_cast<const LightFieldRows*>(self);
  std::memcpy(out, rows.coverage_.Row(y), static_cast<size_t>(rows.engine_.config.width));
}

RowSource LightFieldRows::Source() const {
  RowSource source;
  source.views = ReaderOf(planes_);
  source.map = ReadMap;
  if (coverage_.data != nullptr) source.coverage = ReadCoverage;
  source.self = this;
  return source;
}

void LightFieldRows::Use(EngineState* engine) const {
  PlaneViews& planes = engine->pictures.planes;
  planes = planes_;
  SetViews(engine->config, ReaderOf(planes), planes.view[0], &engine->pictures);
  engine->pictures.windows[0].given_coverage = coverage_;
}

RowSink SinkOf(const Picture& picture) { return {Store, &picture}; }

}  // namespace starfocus
