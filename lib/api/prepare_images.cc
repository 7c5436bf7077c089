// SPDX-License-Identifier: Apache-2.0
// Light fields of images, prepared.
#include <new>

#include "lib/api/image_field.h"
#include "lib/api/prepared.h"
#include "lib/api/validate_image.h"
#include "starfocus/image.h"

namespace starfocus {
namespace {

sf_status ReadRows(const void* field, const RowRange& rows, const Plane<int16_t>& disparity,
                   const Runner& runner, EngineState* engine) {
  return ReadImageRows(*static_cast<const ImageField*>(field), rows, &disparity, runner, engine);
}

Prepared* MakePrepared(const sf_config& config, const sf_image_field& images, void* memory) {
  new (memory) Prepared();
  Prepared* made = nullptr;
  LayOutPrepared(config, memory, &made);
  made->config = config;
  *made->images = images;
  return made;
}

}  // namespace
}  // namespace starfocus

sf_status sf_prepare_images(sf_engine* engine, const sf_image_field* field, void* memory,
                            size_t bytes, sf_progress progress, void* progress_data,
                            sf_runner runner, void* runner_data, sf_prepared** prepared) {
  if (prepared == nullptr) return SF_ERROR_NULL;
  *prepared = nullptr;
  if (engine == nullptr || field == nullptr) return SF_ERROR_NULL;
  auto& e = *reinterpret_cast<starfocus::EngineState*>(engine);
  if (e.config.images == 0) return SF_ERROR_STATE;
  sf_status status = starfocus::CheckImageField(e.config, *field);
  starfocus::Extent extent;
  if (status == SF_OK) status = starfocus::CheckPreparedMemory(e, memory, bytes, &extent);
  if (status != SF_OK) return status;
  if (starfocus::OverlapsField(extent, e.config, *field)) return SF_ERROR_OVERLAP;
  e.stream.active = false;
  starfocus::Watch& watch = e.crew.jobs.watch;
  watch.Begin(progress, progress_data, 0, e.config.height);
  starfocus::ImageField images;
  starfocus::MakeImageField(*field, &e, &images);
  starfocus::UseImageField(images, &e);
  // The caller's memory stays as it is when a row is bad.
  status = starfocus::CheckDepths({0, e.config.height}, &e, &images);
  if (status != SF_OK) return status;
  starfocus::Prepared* made = starfocus::MakePrepared(e.config, *field, memory);
  status = starfocus::MakeLayers(*made, {starfocus::ReadRows, &images}, {runner, runner_data}, &e);
  if (status != SF_OK) return status;
  watch.SetRows(e.config.height);
  if (!watch.Ask()) return SF_ERROR_CANCELLED;
  *prepared = reinterpret_cast<sf_prepared*>(made);
  return SF_OK;
}
