// SPDX-License-Identifier: Apache-2.0
#include "lib/engine/light_field.h"

#include <cstring>

#include "lib/base/features.h"
#include "lib/io/rows.h"

namespace starfocus {
namespace {

const LightField& FieldOf(const void* self) { return *static_cast<const LightField*>(self); }

const uint8_t* ReadView(const void* self, int view, int32_t x, int32_t y, int32_t count,
                        uint8_t* room) {
  const LightField& field = FieldOf(self);
  ReadCodes(*field.kernels, field.views[view], x, y - field.first, count, room);
  return room;
}

// Reads 8-bit samples (codes) of a row of a view, for the input windows of the engine. Codes of the
// centre view are read from the ring buffer of converted rows.
const uint8_t* WindowCodes(const void* self, int view, int32_t x, int32_t y, int32_t count,
                           uint8_t* room) {
  if (view > 0) return ReadView(self, view, x, y, count, room);
  return ReaderOf(FieldOf(self).planes).Codes(view, x, y, count, room);
}

void WindowLight(const void* self, int view, int32_t x, int32_t y, int32_t count, int16_t* rgb) {
  constexpr int32_t kPiece = 256;
  const PlaneViews& planes = FieldOf(self).planes;
  uint8_t room[3 * kPiece];
  for (int32_t p = 0; p < count; p += kPiece) {
    const int32_t some = Min(kPiece, count - p);
    planes.kernels->Decode(WindowCodes(self, view, x + p, y, some, room),
                           3 * static_cast<size_t>(some), planes.transfer->encoding, rgb + 3 * p);
  }
}

uint32_t CheckMap(const void* self, const Range& rows) {
  const LightField& field = FieldOf(self);
  return CheckDepth(*field.kernels, field.depth, rows);
}

uint32_t ReadMap(const void* self, const Range& rows, const Plane<int16_t>& out) {
  const LightField& field = FieldOf(self);
  const Rect rect = {0, rows.first, field.depth.width, rows.last - rows.first};
  return ReadDepth(*field.kernels, field.depth, rect, out);
}

void ReadCoverage(const void* self, int32_t y, uint8_t* out) {
  const LightField& field = FieldOf(self);
  std::memcpy(out, field.coverage.Row(y), static_cast<size_t>(field.depth.width));
}

void ReadAlpha(const void* self, int32_t y, uint8_t* out) {
  const LightField& field = FieldOf(self);
  const ImageSource& centre = field.views[0];
  const uint8_t* const row = AlphaOf(centre).Row(y - field.first);
  for (int32_t x = 0; x < field.depth.width; ++x)
    out[x] = row[static_cast<size_t>(x) * centre.step];
}

void MakeViews(const starfocus_light_field& given, EngineState* engine, LightField* field) {
  field->in_place = true;
  for (int view = 0; view < engine->config.views; ++view) {
    field->views[view] = PlanesOf<const uint8_t>(given.views[view]);
    field->in_place = field->in_place && field->views[view].IsPacked();
  }
  PlaneViews& planes = field->planes;
  planes.kernels = engine->kernels;
  planes.transfer = &TransferOf(engine->config.transfer);
  const Plane<uint8_t>& ring = engine->rings[0];
  if (!field->in_place) planes.view[0] = {ring.data, ring.stride, ring.rows, 0};
  for (int view = 0; field->in_place && view < engine->config.views; ++view) {
    planes.view[view] = RowsOf(given.views[view], field->first);
  }
}

}  // namespace

void MakeLightField(const starfocus_light_field& given, int32_t first, EngineState* engine,
                    LightField* field) {
  field->kernels = &simd::BestImageKernels();
  field->first = first;
  MakeViews(given, engine, field);
  ImageMemory& memory = engine->images;
  if (memory.columns != nullptr && memory.map_width != given.depth.width) {
    memory.map_width = given.depth.width;
    FillColumns(engine->config.width, memory.map_width, 0, engine->config.width, memory.columns);
  }
  const starfocus_config& config = engine->config;
  const DisparityRange range = RangeOf(config);
  field->depth = {given.depth, RuleOf(given.depth, range.min, range.max), config.width,
                  config.height, memory.columns};
  // If the map has fewer rows than the picture, the caller always passes all rows of the map, so
  // the first row is 0.
  if (given.depth.height == config.height) field->depth.first = first;
  field->coverage = {given.coverage, given.coverage_stride, 0, first};
}

RowSource SourceOf(const LightField& field) {
  RowSource source;
  source.views = field.in_place ? ReaderOf(field.planes) : ViewReader{nullptr, ReadView, &field};
  source.converts_centre = !field.in_place;
  source.check_map = CheckMap;
  source.map = ReadMap;
  if (field.coverage.data != nullptr) source.coverage = ReadCoverage;
  if (field.views[0].has_alpha) source.alpha = ReadAlpha;
  source.self = &field;
  return source;
}

void UseLightField(const LightField& field, EngineState* engine) {
  PlaneViews& planes = engine->row_store.planes;
  planes = field.planes;
  const ViewReader reader =
      field.in_place ? ReaderOf(planes) : ViewReader{WindowLight, WindowCodes, &field};
  SetViews(engine->config, reader, planes.view[0], &engine->row_store);
  engine->row_store.windows[0].given_coverage = field.coverage;
}

}  // namespace starfocus
