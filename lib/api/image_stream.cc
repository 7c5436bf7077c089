// SPDX-License-Identifier: Apache-2.0
// Streams of images: rows are converted as they are pushed and pulled.
#include "lib/api/stream.h"
#include "lib/api/validate_image.h"
#include "lib/engine/layout.h"
#include "lib/source/image_field.h"
#include "lib/source/image_output.h"
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
  starfocus::MakeImageField(*field, pushed, &e, &images);
  return starfocus::PushRows(starfocus::SourceOf(images), rows, 2, &e, consumed);
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
  starfocus::Extents memory;
  memory.Add(starfocus::Workspace(e));
  if (most > 0) status = starfocus::CheckImageOutput(image, e.config.width, most, memory);
  if (status != SF_OK) return status;
  const starfocus::Plane<uint8_t>& alpha = e.images.alpha;
  const starfocus::ImageOutput output = {&starfocus::simd::BestImageKernels(),
                                         starfocus::PlanesOf(*out),
                                         {0, first, e.config.width, left},
                                         {{alpha.data, alpha.stride, alpha.rows, 0}, 1}};
  status = starfocus::PullRows(starfocus::SinkOf(output), most, {runner, runner_data}, &e, written);
  if (status == SF_OK && report != nullptr) *report = e.report;
  return status;
}
