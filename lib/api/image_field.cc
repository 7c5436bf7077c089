// SPDX-License-Identifier: Apache-2.0
#include "lib/api/image_field.h"

#include "lib/api/stripe_rows.h"

namespace starfocus {
namespace {

const uint8_t* CodesOf(const void* self, int view, int32_t x, int32_t y, int32_t count,
                       uint8_t* room) {
  const auto& field = *static_cast<const ImageField*>(self);
  if (view == 0) return ReaderOf(field.centre).Codes(view, x, y, count, room);
  ReadCodes(*field.kernels, field.views[view], x, y, count, room);
  return room;
}

void LightOf(const void* self, int view, int32_t x, int32_t y, int32_t count, int16_t* rgb) {
  constexpr int32_t kPiece = 256;
  const PlaneViews& centre = static_cast<const ImageField*>(self)->centre;
  uint8_t room[3 * kPiece];
  for (int32_t p = 0; p < count; p += kPiece) {
    const int32_t some = Min(kPiece, count - p);
    centre.kernels->Decode(CodesOf(self, view, x + p, y, some, room), 3 * static_cast<size_t>(some),
                           centre.transfer->encoding, rgb + 3 * p);
  }
}

// Converts rows: job `index` of `jobs` has as many as the others, but for one.
struct RowsJob {
  const ImageField* field;
  const EngineState* engine;
  RowRange rows;
  int32_t jobs;
  const Plane<int16_t>* disparity;  // null: not read
};

void ReadDepths(const RowsJob& job, int32_t y, Worker* worker) {
  const EngineState& engine = *job.engine;
  int16_t* row = job.disparity->Row(y);
  ReadDepthRow(*job.field->kernels, job.field->depth, y, row);
  if (job.field->fills) {
    const int32_t unknown = FillUnknown(engine.config, *engine.kernels, row);
    worker->counts.unknown_pixels += static_cast<uint64_t>(unknown);
  }
  CheckAll(ranges::kDisparity, row, static_cast<size_t>(engine.config.width));
}

void ReadRows(const RowsJob& job, int32_t index, Worker* worker) {
  const int32_t width = job.engine->config.width;
  const RowRange rows = PartOf(job.rows, index, job.jobs);
  for (int32_t y = rows.first; y < rows.last; ++y) {
    if (!worker->patience.Spend(4 * int64_t{width})) return;
    ReadCodes(*job.field->kernels, job.field->views[0], 0, y, width, job.engine->rings[0].Row(y));
    if (job.disparity != nullptr) ReadDepths(job, y, worker);
  }
}

}  // namespace

uint64_t MapRowBytes(const sf_depth_map& map) {
  return uint64_t{DepthBytes(map.type)} * static_cast<uint64_t>(map.width);
}

void MakeImageField(const sf_image_field& images, EngineState* engine, ImageField* field) {
  field->kernels = &simd::BestImageKernels();
  for (int view = 0; view < engine->config.views; ++view) {
    field->views[view] = PlanesOf(images.views[view]);
  }
  ImageMemory& memory = engine->images;
  if (memory.map_width != images.depth.width) {
    memory.map_width = images.depth.width;
    FillColumns(engine->config.width, memory.map_width, memory.columns);
  }
  field->depth = MakeDepthSource(engine->config, images.depth, memory.columns);
  const Plane<uint8_t>& ring = engine->rings[0];
  field->centre.kernels = engine->kernels;
  field->centre.transfer = &TransferOf(engine->config.transfer);
  field->centre.view[0] = {ring.data, ring.stride, ring.rows, 0};
  field->fills = false;
}

void UseImageField(const ImageField& field, EngineState* engine) {
  SetViews(engine->config, {LightOf, CodesOf, &field}, field.centre.view[0], &engine->pictures);
}

sf_status StatusOfDepth(uint32_t flags, const sf_config& config) {
  if ((flags & simd::kUnknownDepth) != 0 && config.fill_unknown == 0) return SF_ERROR_NOT_FINITE;
  return (flags & simd::kDepthOutside) != 0 ? SF_ERROR_DISPARITY : SF_OK;
}

sf_status CheckDepths(const RowRange& rows, EngineState* engine, ImageField* field) {
  const sf_depth_map& map = field->depth.map;
  const uint32_t first = PlaceOfRow(field->depth, rows.first) / simd::kColumnOne;
  const uint32_t end = PlaceOfRow(field->depth, rows.last - 1) + simd::kColumnOne - 1;
  const auto last = static_cast<int32_t>(end / simd::kColumnOne);  // its share may be 0
  for (auto y = static_cast<int32_t>(first); y <= last; ++y) {
    if (!OwnPatience(engine)->Spend(map.width)) return SF_ERROR_CANCELLED;
    const uint32_t flags = CheckDepthRow(*field->kernels, field->depth, y);
    const sf_status status = StatusOfDepth(flags, engine->config);
    if (status != SF_OK) return status;
    field->fills = field->fills || flags != 0;
    engine->report.disparity_bytes += MapRowBytes(map);
  }
  return SF_OK;
}

sf_status ReadImageRows(const ImageField& field, const RowRange& rows,
                        const Plane<int16_t>* disparity, const Runner& runner,
                        EngineState* engine) {
  if (rows.first >= rows.last) return SF_OK;
  const int32_t jobs = Min(MaxJobs(engine->config), rows.last - rows.first);
  const RowsJob job = {&field, engine, rows, jobs, disparity};
  const sf_status status = RunJobs<RowsJob, ReadRows>(job, jobs, runner, &engine->crew);
  TakeCounts(engine);
  for (int32_t y = rows.first; disparity != nullptr && y < rows.last; ++y) {
    const bool two = PlaceOfRow(field.depth, y) % simd::kColumnOne != 0;
    engine->report.disparity_bytes += MapRowBytes(field.depth.map) * (two ? 2 : 1);
  }
  return status;
}

}  // namespace starfocus
