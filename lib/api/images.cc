// SPDX-License-Identifier: Apache-2.0
// The C ABI for whole images and regions of them.
#include "lib/api/call.h"
#include "lib/api/validate.h"
#include "lib/api/validate_image.h"
#include "lib/source/image_field.h"
#include "lib/source/image_output.h"
#include "starfocus/image.h"

namespace starfocus {
namespace {

// A refocusing as the C ABI asks for it; prepared may be null.
struct Request {
  const sf_params& params;
  const sf_image_field& field;
  const Prepared* prepared;
  const sf_image& out;
};

sf_status Refocus(const Request& request, EngineState* engine, sf_report* report) {
  const sf_config& config = engine->config;
  sf_status status = NeedImages(config);
  if (status == SF_OK) status = CheckCall(config, request.params, request.prepared);
  if (status == SF_OK) status = CheckImageField(config, request.field);
  if (status != SF_OK) return status;
  const Rect rect = RegionOf(config, request.params);
  Extents read = MemoryOf(*engine, request.prepared);
  AddImageField(config, request.field, &read);
  status = CheckImageOutput(request.out, rect, read, config.problem);
  if (status != SF_OK) return status;
  ImageField field;
  MakeImageField(request.field, 0, engine, &field);
  UseImageField(field, engine);
  const ImageOutput out = {field.kernels, PlanesOf<uint8_t>(request.out), rect,
                           AlphaOf(field.views[0])};
  Call call = {request.params, SourceOf(field), SinkOf(out), request.prepared};
  if (request.prepared != nullptr) call.source.map = nullptr;
  return RunCall(call, engine, report);
}

}  // namespace
}  // namespace starfocus

using starfocus::EngineState;

sf_status sf_refocus_images(sf_engine* engine, const sf_params* params, const sf_image_field* field,
                            const sf_image* out, sf_report* report) {
  sf_params full;
  const sf_status status = starfocus::EnterCall(
      engine, {{"params", params}, {"field", field}, {"out", out}}, params, &full);
  if (status != SF_OK) return status;
  return starfocus::Refocus({full, *field, nullptr, *out}, reinterpret_cast<EngineState*>(engine),
                            report);
}

sf_status sf_refocus_prepared_images(sf_engine* engine, const sf_params* params,
                                     const sf_prepared* prepared, const sf_image* out,
                                     sf_report* report) {
  sf_params full;
  const sf_status status = starfocus::EnterCall(
      engine, {{"params", params}, {"prepared", prepared}, {"out", out}}, params, &full);
  if (status != SF_OK) return status;
  const auto* p = reinterpret_cast<const starfocus::Prepared*>(prepared);
  if (p->images == nullptr) {
    return starfocus::Refuse(SF_ERROR_PREPARED, {"prepared"}, {"of sf_prepare_images"},
                             &reinterpret_cast<EngineState*>(engine)->problem);
  }
  return starfocus::Refocus({full, *p->images, p, *out}, reinterpret_cast<EngineState*>(engine),
                            report);
}
