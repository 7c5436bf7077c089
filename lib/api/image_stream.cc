// SPDX-License-Identifier: Apache-2.0
// Streams of images: rows are converted as they are pushed and pulled.
#include "lib/api/stream.h"
#include "lib/api/validate.h"
#include "lib/api/validate_image.h"
#include "lib/engine/layout.h"
#include "lib/source/image_field.h"
#include "lib/source/image_output.h"
#include "starfocus/image.h"

namespace starfocus {
namespace {

// Checks that `rows` rows from row `first` of the picture on are as many as a format takes.
sf_status CheckPairs(const sf_config& config, bool is_yuv, int32_t first, int32_t rows) {
  Checker check(config.problem);
  check.Need(!is_yuv || (first % 2 == 0 && (rows % 2 == 0 || first + rows == config.height)),
             SF_ERROR_RANGE, {"rows", double(rows)}, {"even, but at the end of the picture"});
  return check.status();
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
  if (consumed != nullptr) *consumed = 0;
  sf_status status = starfocus::EnterEngine(engine, {{"field", field}, {"consumed", consumed}});
  if (status != SF_OK) return status;
  EngineState& e = *reinterpret_cast<EngineState*>(engine);
  const int32_t pushed = e.stream.pushed;
  status = starfocus::NeedImages(e.config);
  if (status == SF_OK) status = starfocus::CheckPush(e, rows);
  if (status == SF_OK) status = starfocus::CheckImageField(e.config, *field);
  if (status == SF_OK) {
    const bool is_yuv = starfocus::AnyYuv(e.config, *field);
    status = starfocus::CheckPairs(e.config, is_yuv, pushed, rows);
  }
  if (status != SF_OK) return status;
  starfocus::ImageField images;
  starfocus::MakeImageField(*field, pushed, &e, &images);
  return starfocus::PushRows(starfocus::SourceOf(images), rows, 2, &e, consumed);
}

sf_status sf_stream_pull_images(sf_engine* engine, const sf_image* out, int32_t rows,
                                int32_t* written, sf_report* report) {
  if (written != nullptr) *written = 0;
  sf_status status = starfocus::EnterEngine(engine, {{"out", out}, {"written", written}});
  if (status != SF_OK) return status;
  EngineState& e = *reinterpret_cast<EngineState*>(engine);
  status = starfocus::NeedImages(e.config);
  if (status == SF_OK) status = starfocus::CheckPull(e, rows);
  if (status != SF_OK) return status;
  const int32_t first = e.stream.written, left = e.config.height - first;
  const int32_t most = starfocus::Min(rows, left);
  status = starfocus::CheckImage(*out, {0, 0, e.config.width, e.config.height}, &e.problem);
  if (status == SF_OK) {
    status = starfocus::CheckPairs(e.config, starfocus::IsYuv(out->format), first, most);
  }
  if (status != SF_OK) return status;
  starfocus::Extents memory;
  memory.Add(starfocus::Workspace(e));
  if (most > 0)
    status = starfocus::CheckImageOutput(*out, {0, 0, e.config.width, most}, memory, &e.problem);
  if (status != SF_OK) return status;
  const starfocus::Plane<uint8_t>& alpha = e.images.alpha;
  const starfocus::ImageOutput output = {&starfocus::simd::BestImageKernels(),
                                         starfocus::PlanesOf<uint8_t>(*out),
                                         {0, first, e.config.width, left},
                                         {{alpha.data, alpha.stride, alpha.rows, 0}, 1}};
  status = starfocus::PullRows(starfocus::SinkOf(output), most, &e, written);
  if (status == SF_OK && report != nullptr) *report = e.report;
  return status;
}
