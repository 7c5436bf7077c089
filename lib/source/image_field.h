// SPDX-License-Identifier: Apache-2.0
// A light field of images during a call: rows of the centre view and of disparities go into the
// engine's rings, and pixels of side views are converted where they are read.
#ifndef STARFOCUS_LIB_SOURCE_IMAGE_FIELD_H_
#define STARFOCUS_LIB_SOURCE_IMAGE_FIELD_H_

#include "lib/convert/depth_rows.h"
#include "lib/convert/image_rows.h"
#include "lib/engine/driver.h"
#include "lib/engine/engine.h"
#include "starfocus/image.h"

namespace starfocus {

struct ImageField {
  const simd::ImageKernels* kernels;
  ImageSource views[kMaxViews];
  int32_t first;  // row of the picture that the views begin with
  DepthSource depth;
  Plane<const uint8_t> coverage;  // null: there is none
  PlaneViews centre;              // view 0 alone: the engine's ring of its rows
};

// Makes *field of a field that has been checked, whose views begin with row `first` of the picture.
// The map's columns go into the engine's memory.
void MakeImageField(const sf_image_field& images, int32_t first, EngineState* engine,
                    ImageField* field);

// Returns a source of the field's rows; the field must outlive it.
RowSource SourceOf(const ImageField& field);

// Points the engine's windows at its ring of the centre view and at the field, which must stay.
void UseImageField(const ImageField& field, EngineState* engine);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_SOURCE_IMAGE_FIELD_H_
