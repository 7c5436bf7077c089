// SPDX-License-Identifier: Apache-2.0
#include "lib/source/image_field.h"

#include <cstring>

namespace starfocus {
namespace {

const ImageField& FieldOf(const void* self) { return *static_cast<const ImageField*>(self); }

const uint8_t* ReadView(const void* self, int view, int32_t x, int32_t y, int32_t count,
                        uint8_t* room) {
  const ImageField& field = FieldOf(self);
  ReadCodes(*field.kernels, field.views[view], x, y - field.first, count, room);
  return room;
}

// The windows read the centre view's rows where they have been converted.
const uint8_t* WindowCodes(const void* self, int view, int32_t x, int32_t y, int32_t count,
                           uint8_t* room) {
  if (view > 0) return ReadView(self, view, x, y, count, room);
  return ReaderOf(FieldOf(self).centre).Codes(view, x, y, count, room);
}

void WindowLight(const void* self, int view, int32_t x, int32_t y, int32_t count, int16_t* rgb) {
  constexpr int32_t kPiece = 256;
  const PlaneViews& centre = FieldOf(self).centre;
  uint8_t room[3 * kPiece];
  for (int32_t p = 0; p < count; p += kPiece) {
    const int32_t some = Min(kPiece, count - p);
    centre.kernels->Decode(WindowCodes(self, view, x + p, y, some, room),
                           3 * static_cast<size_t>(some), centre.transfer->encoding, rgb + 3 * p);
  }
}

uint32_t ReadMap(const void* self, int32_t y, int16_t* out, uint64_t* bytes) {
  const ImageField& field = FieldOf(self);
  const bool two = PlaceOfRow(field.depth, y) % simd::kColumnOne != 0;
  const size_t row = DepthBytes(field.depth.map.type) * static_cast<size_t>(field.depth.map.width);
  *bytes += two ? 2 * row : row;
  return ReadDepthRow(*field.kernels, field.depth, y, out);
}

void ReadCoverage(const void* self, int32_t y, uint8_t* out) {
  const ImageField& field = FieldOf(self);
  std::memcpy(out, field.coverage.Row(y), static_cast<size_t>(field.depth.width));
}

void ReadAlpha(const void* self, int32_t y, uint8_t* out) {
  const ImageField& field = FieldOf(self);
  const AlphaSource alpha = AlphaOf(field.views[0]);
  if (alpha.rows.data == nullptr) return;
  const uint8_t* const row = alpha.rows.Row(y - field.first);
  for (int32_t x = 0; x < field.depth.width; ++x) out[x] = row[static_cast<size_t>(x) * alpha.step];
}

}  // namespace

void MakeImageField(const sf_image_field& images, int32_t first, EngineState* engine,
                    ImageField* field) {
  field->kernels = &simd::BestImageKernels();
  for (int view = 0; view < engine->config.views; ++view) {
    field->views[view] = PlanesOf<const uint8_t>(images.views[view]);
  }
  field->first = first;
  ImageMemory& memory = engine->images;
  if (memory.map_width != images.depth.width) {
    memory.map_width = images.depth.width;
    FillColumns(engine->config.width, memory.map_width, memory.columns);
  }
  field->depth = MakeDepthSource(engine->config, images.depth, memory.columns);
  field->coverage = {images.coverage, images.coverage_stride, 0, first};
  const Plane<uint8_t>& ring = engine->rings[0];
  field->centre.kernels = engine->kernels;
  field->centre.transfer = &TransferOf(engine->config.transfer);
  field->centre.view[0] = {ring.data, ring.stride, ring.rows, 0};
}

RowSource SourceOf(const ImageField& field) {
  RowSource source;
  source.views = {nullptr, ReadView, &field};
  source.converts_centre = true;
  source.map = ReadMap;
  if (field.coverage.data != nullptr) source.coverage = ReadCoverage;
  source.alpha = ReadAlpha;
  source.self = &field;
  return source;
}

void UseImageField(const ImageField& field, EngineState* engine) {
  SetViews(engine->config, {WindowLight, WindowCodes, &field}, field.centre.view[0],
           &engine->pictures);
  engine->pictures.windows[0].given_coverage = field.coverage;
}

}  // namespace starfocus
