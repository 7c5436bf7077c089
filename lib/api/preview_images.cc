// SPDX-License-Identifier: Apache-2.0
// Previews into images.
#include "lib/api/image_output.h"
#include "lib/api/preview.h"
#include "lib/api/validate_image.h"
#include "lib/engine/layout.h"
#include "starfocus/image.h"

namespace starfocus {
namespace {

sf_status WriteRows(const void* out, const Plane<uint8_t>& from, const RowRange& rows,
                    const Runner& runner, EngineState* engine) {
  return WriteImageRows(*static_cast<const ImageOutput*>(out), from, rows, runner, engine);
}

sf_status CheckOut(const sf_image& out, const Rect& rect, const Prepared& prepared,
                   const EngineState& engine) {
  const sf_status status = CheckImage(out, rect.width, rect.height);
  if (status != SF_OK) return status;
  const bool overlaps = OverlapsImage(Workspace(engine), out, rect.width, rect.height) ||
                        OverlapsImage(PreparedMemory(prepared), out, rect.width, rect.height);
  return overlaps ? SF_ERROR_OVERLAP : SF_OK;
}

}  // namespace
}  // namespace starfocus

sf_status sf_refocus_preview_images(sf_engine* engine, const sf_params* params,
                                    const sf_prepared* prepared, int32_t shift,
                                    const sf_image_out* out, sf_runner runner, void* runner_data,
                                    sf_report* report) {
  if (engine == nullptr || params == nullptr || prepared == nullptr || out == nullptr) {
    return SF_ERROR_NULL;
  }
  auto& e = *reinterpret_cast<starfocus::EngineState*>(engine);
  if (e.config.images == 0) return SF_ERROR_STATE;
  const starfocus::PreviewRequest request = {
      *params, *reinterpret_cast<const starfocus::Prepared*>(prepared), shift};
  sf_status status = starfocus::CheckPreview(request, e);
  if (status != SF_OK) return status;
  const starfocus::Rect rect = starfocus::PreviewRect(request, e);
  status = starfocus::CheckOut(starfocus::AsImage(*out), rect, request.prepared, e);
  if (status != SF_OK) return status;
  const starfocus::ImageOutput output = {
      &starfocus::simd::BestImageKernels(), starfocus::PlanesOf(*out), rect, {{}, 1}};
  return starfocus::RefocusPreview(request, {starfocus::WriteRows, &output}, {runner, runner_data},
                                   &e, report);
}
