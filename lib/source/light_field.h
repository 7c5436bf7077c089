// SPDX-License-Identifier: Apache-2.0
// Light field of the caller during a call. Disparities are converted when they are loaded. Views
// are read in place if all views are packed RGB. Otherwise the engine converts rows of the centre
// view to its ring, and converts pixels of side views when it reads them.
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
  // All views if in place; otherwise only view 0, in the engine's ring.
  PlaneViews planes;
};

// Initialises *field from a valid light field whose rows start with row `first` of the picture. The
// column table for a smaller map is stored in the engine's memory.
void MakeLightField(const starfocus_light_field& given, int32_t first, EngineState* engine,
                    LightField* field);

// Returns a source of the rows of the field, which must outlive the source.
RowSource SourceOf(const LightField& field);

// Sets the field as the source of the engine's windows. The field must remain valid unless it is in
// place.
void UseLightField(const LightField& field, EngineState* engine);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_SOURCE_LIGHT_FIELD_H_
