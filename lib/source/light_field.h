// SPDX-License-Identifier: Apache-2.0
// Light field of the caller during a call. Disparities are converted when they are loaded. If all
// views are packed RGB, they are read in place. Otherwise rows of the centre view are converted to
// the engine's ring, and pixels of side views are converted when they are read.
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
  int32_t first;  // row of the picture where the views start
  bool in_place;  // true: all views are packed RGB
  DepthSource depth;
  Plane<const uint8_t> coverage;  // null: no coverage
  PlaneViews planes;              // in place: all views; otherwise only view 0, the engine's ring
};

// Initialises *field from a valid light field whose rows start with row `first` of the picture. The
// column table for a smaller map is stored in the engine's memory.
void MakeLightField(const starfocus_light_field& given, int32_t first, EngineState* engine,
                    LightField* field);

// Returns a source of the field's rows. The field must outlive it.
RowSource SourceOf(const LightField& field);

// Makes the engine's windows read from the field. The field must stay valid unless it is in place.
void UseLightField(const LightField& field, EngineState* engine);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_SOURCE_LIGHT_FIELD_H_
