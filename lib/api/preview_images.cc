// SPDX-License-Identifier: Apache-2.0
// Previews into images.
#include "lib/api/call.h"
#include "lib/api/preview.h"
#include "lib/api/validate.h"
#include "lib/api/validate_image.h"
#include "lib/source/image_output.h"
#include "starfocus/image.h"

sf_status sf_refocus_preview_images(sf_engine* engine, const sf_params* params,
                                    const sf_prepared* prepared, int32_t shift, const sf_image* out,
                                    sf_report* report) {
  sf_params full;
  sf_status status = starfocus::EnterCall(
      engine, {{"params", params}, {"prepared", prepared}, {"out", out}}, params, &full);
  if (status != SF_OK) return status;
  auto& e = *reinterpret_cast<starfocus::EngineState*>(engine);
  status = starfocus::NeedImages(e.config);
  if (status != SF_OK) return status;
  const starfocus::PreviewRequest request = {
      full, *reinterpret_cast<const starfocus::Prepared*>(prepared), shift};
  status = starfocus::CheckPreview(request, e);
  if (status != SF_OK) return status;
  const starfocus::Rect rect = starfocus::PreviewRect(request, e);
  status = starfocus::CheckImageOutput(*out, rect, starfocus::MemoryOf(e, &request.prepared),
                                       e.config.problem);
  if (status != SF_OK) return status;
  const starfocus::ImageOutput output = {
      &starfocus::simd::BestImageKernels(), starfocus::PlanesOf<uint8_t>(*out), rect, {{}, 1}};
  return starfocus::RefocusPreview(request, starfocus::SinkOf(output), &e, report);
}
