// SPDX-License-Identifier: Apache-2.0
// Light fields of images, prepared.
#include "lib/api/prepare.h"
#include "lib/api/validate.h"
#include "lib/api/validate_image.h"
#include "lib/source/image_field.h"
#include "lib/source/prepared.h"
#include "starfocus/image.h"

sf_status sf_prepare_images(sf_engine* engine, const sf_image_field* field, void* memory,
                            size_t bytes, sf_prepared** prepared) {
  if (prepared != nullptr) *prepared = nullptr;
  sf_status status = starfocus::EnterEngine(engine, {{"field", field}, {"prepared", prepared}});
  if (status != SF_OK) return status;
  auto& e = *reinterpret_cast<starfocus::EngineState*>(engine);
  const starfocus::PrepareCall call = {memory, bytes};
  status = starfocus::NeedImages(e.config);
  if (status == SF_OK) status = starfocus::CheckImageField(e.config, *field);
  if (status != SF_OK) return status;
  starfocus::Extents read;
  starfocus::AddImageField(e.config, *field, &read);
  status = starfocus::CheckPreparedMemory(e, call, &read);
  if (status != SF_OK) return status;
  starfocus::ImageField images;
  starfocus::MakeImageField(*field, 0, &e, &images);
  starfocus::UseImageField(images, &e);
  starfocus::Prepared* made = nullptr;
  status = starfocus::Prepare(call, starfocus::SourceOf(images), &e, &made);
  if (status != SF_OK) return status;
  *made->images = *field;
  *prepared = reinterpret_cast<sf_prepared*>(made);
  return SF_OK;
}
