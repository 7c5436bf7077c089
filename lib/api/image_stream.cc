// SPDX-License-Identifier: Apache-2.0
// Streams of images: rows are converted as they are pushed and pulled.
#include "lib/api/image_field.h"
#include "lib/api/image_output.h"
#include "lib/api/stream.h"
#include "lib/api/validate_image.h"
#include "lib/engine/layout.h"
#include "lib/engine/stripe.h"
#include "starfocus/image.h"

namespace starfocus {
namespace {

// Whether `rows` rows from row `first` of the picture on are as many as a format takes at a time.
bool AreWholePairs(bool is_yuv, int32_t first, int32_t rows, int32_t height) {
  return !is_yuv || (first % 2 == 0 && (rows % 2 == 0 || first + rows == height));
}

bool AnyYuv(const sf_config& config, const sf_image_field& field) {
  for (int view = 0; view < config.views; ++view) {
    if (IsYuv(field.views[view].format)) return true;
  }
  return false;
}

// Converts the depth of the next `rows` rows.
sf_status PushDepths(const ImageField& field, int32_t rows, EngineState* engine) {
  int32_t unknown = 0;
  for (int32_t k = 0; k < rows; ++k) {
    const int32_t y = engine->stream.pushed + k;
    int16_t* row = engine->pictures.disparity.Row(y);
    const uint32_t flags = ReadDepthRow(*field.kernels, field.depth, y, row);
    const sf_status status = StatusOfDepth(flags, engine->config);
    if (status != SF_OK) return status;
    if (flags != 0) unknown += FillUnknown(engine->config, *engine->kernels, row);
  }
  engine->report.unknown_pixels += static_cast<uint64_t>(unknown);
  engine->report.disparity_bytes += static_cast<uint64_t>(rows) * MapRowBytes(field.depth.map);
  return SF_OK;
}

// Converts row y of the images, the next one, into the rings.
void PushViews(const ImageField& field, int32_t y, EngineState* engine) {
  const sf_config& config = engine->config;
  const int32_t row = engine->stream.pushed;
  for (int view = 0; view < config.views; ++view) {
    ReadCodes(*field.kernels, field.views[view], 0, y, config.width, engine->rings[view].Row(row));
  }
  uint8_t* alpha = engine->images.alpha.Row(row);
  const AlphaSource from = AlphaOf(field.views[0]);
  for (size_t x = 0; x < static_cast<size_t>(config.width); ++x) {
    alpha[x] = from.rows.data != nullptr ? from.rows.Row(y)[x * from.step] : uint8_t{255};
  }
  ++engine->stream.pushed;
}

sf_status PushRows(const ImageField& field, int32_t rows, EngineState* engine, int32_t* consumed) {
  while (*consumed < rows && engine->stream.pushed < NeededRows(*engine)) {
    // Both rows of a pair, or none.
    const int32_t pair = Min(2, rows - *consumed);
    const sf_status status = PushDepths(field, pair, engine);
    if (status != SF_OK) return status;
    for (int32_t k = 0; k < pair; ++k, ++*consumed) PushViews(field, *consumed, engine);
  }
  return SF_OK;
}

sf_status PullRows(const ImageOutput& out, int32_t rows, const Runner& runner, EngineState* engine,
                   int32_t* written) {
  Stream& stream = engine->stream;
  while (*written < rows && stream.written < engine->config.height) {
    if (!StripeWaiting(*engine)) {
      if (stream.pushed < NeededRows(*engine)) break;
      const sf_status status = RefocusNext(engine, runner);
      if (status != SF_OK) return status;
    }
    const int32_t some = Min(rows - *written, stream.finished - stream.written);
    const Plane<uint8_t> from = BufferRows(*engine, stream.next - engine->config.largest_block);
    const sf_status status =
        WriteImageRows(out, from, {stream.written, stream.written + some}, runner, engine);
    if (status != SF_OK) return status;
    stream.written += some;
    *written += some;
  }
  return SF_OK;
}

}  // namespace
}  // namespace starfocus

using starfocus::EngineState;

sf_status sf_stream_push_images(sf_engine* engine, const sf_image_field* field, int32_t rows,
                                int32_t* consumed) {
  if (consumed == nullptr) return SF_ERROR_NULL;
  *consumed = 0;
  if (engine == nullptr || field == nullptr) return SF_ERROR_NULL;
  EngineState& e = *reinterpret_cast<EngineState*>(engine);
  if (!e.stream.active || e.config.images == 0) return SF_ERROR_STATE;
  const int32_t height = e.config.height, pushed = e.stream.pushed;
  if (rows < 0 || rows > height - pushed) return SF_ERROR_COUNT;
  const sf_status status = starfocus::CheckImageField(e.config, *field);
  if (status != SF_OK) return status;
  if (!starfocus::AreWholePairs(starfocus::AnyYuv(e.config, *field), pushed, rows, height)) {
    return SF_ERROR_COUNT;
  }
  starfocus::ImageField images;
  starfocus::MakeImageField(*field, &e, &images);
  return starfocus::PushRows(images, rows, &e, consumed);
}

sf_status sf_stream_pull_images(sf_engine* engine, const sf_image_out* out, int32_t rows,
                                sf_runner runner, void* runner_data, int32_t* written,
                                sf_report* report) {
  if (written == nullptr) return SF_ERROR_NULL;
  *written = 0;
  if (engine == nullptr || out == nullptr) return SF_ERROR_NULL;
  EngineState& e = *reinterpret_cast<EngineState*>(engine);
  if (!e.stream.active || e.config.images == 0) return SF_ERROR_STATE;
  if (rows < 0) return SF_ERROR_COUNT;
  const int32_t first = e.stream.written, left = e.config.height - first;
  const int32_t most = starfocus::Min(rows, left);
  const sf_image image = starfocus::AsImage(*out);
  sf_status status = starfocus::CheckImage(image, e.config.width, e.config.height);
  if (status != SF_OK) return status;
  if (!starfocus::AreWholePairs(starfocus::IsYuv(out->format), first, most, e.config.height)) {
    return SF_ERROR_COUNT;
  }
  if (most > 0 && starfocus::OverlapsImage(starfocus::Workspace(e), image, e.config.width, most)) {
    return SF_ERROR_OVERLAP;
  }
  const starfocus::Plane<uint8_t>& alpha = e.images.alpha;
  const starfocus::ImageOutput output = {&starfocus::simd::BestImageKernels(),
                                         starfocus::PlanesOf(*out),
                                         {0, first, e.config.width, left},
                                         {{alpha.data, alpha.stride, alpha.rows, 0}, 1}};
  status = starfocus::PullRows(output, most, {runner, runner_data}, &e, written);
  if (status == SF_OK && report != nullptr) *report = e.report;
  return status;
}
