// SPDX-License-Identifier: Apache-2.0
// A light field of the caller's during a call. Disparities are converted as they are loaded. Views
// that are all rows of R, G, B are read in place; else rows of the centre view are converted into
// the engine's ring, and pixels of side views where they are read.
#ifndef STARFOCUS_LIB_SOURCE_LIGHT_FIELD_H_
#define STARFOCUS_LIB_SOURCE_LIGHT_FIELD_H_

#include "lib/convert/depth_rows.h"
#include "lib/convert/image_rows.h"
#include "lib/engine/driver.h"
#include "lib/engine/engine.h"
#include "starfocus/starfocus.h"

namespace starfocus {

struct LightField {
  const simd::ImageKernels* kernels;
  ImageSource views[kMaxViews];
  int32_t first;  // row of the picture that the views begin with
  bool in_place;
  DepthSource depth;
  Plane<const uint8_t> coverage;  // null: there is none
  PlaneViews planes;              // in place: the views; else view 0 alone, the engine's ring
};

// Makes *field of a light field that has been checked, whose rows begin with row `first` of the
// picture. Columns of a smaller map go into the engine's memory.
void MakeLightField(const starfocus_light_field& given, int32_t first, EngineState* engine,
                    LightField* field);

// Returns a source of the field's rows; the field must outlive it.
RowSource SourceOf(const LightField& field);

// Points the engine's windows at the field, which must stay unless it is in place.
void UseLightField(const LightField& field, EngineState* engine);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_SOURCE_LIGHT_FIELD_H_
