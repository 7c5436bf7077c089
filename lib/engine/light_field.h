// SPDX-License-Identifier: Apache-2.0
// Describes the caller's light field during an API call. Disparities are converted when they are
// loaded. Views are read in place if all views are packed RGB. If a view has another format, the
// engine converts rows of the centre view into a ring buffer. Pixels of side views are then
// converted when the pixels are read.
#ifndef STARFOCUS_LIB_ENGINE_LIGHT_FIELD_H_
#define STARFOCUS_LIB_ENGINE_LIGHT_FIELD_H_

#include "lib/engine/driver.h"
#include "lib/engine/engine.h"
#include "lib/io/depth_rows.h"
#include "lib/io/image_rows.h"
#include "starfocus/starfocus.h"

namespace starfocus {

struct LightField {
  const simd::ImageKernels* kernels;
  ImageSource views[kMaxViews];
  int32_t first;  // Row of the picture at which the rows of the views start.
  bool in_place;  // True if all views are packed RGB.
  DepthSource depth;
  Plane<const uint8_t> coverage;  // null: no coverage
  // Planes of all views if in_place is true; otherwise only the plane of view 0, in the engine's
  // ring buffer.
  PlaneViews planes;
};

// Initialises *field from a valid light field whose rows start with row `first` of the picture. If
// the depth map is smaller than the picture, the table of the map's columns is stored in the
// engine's memory.
void MakeLightField(const starfocus_light_field& given, int32_t first, EngineState* engine,
                    LightField* field);

// Returns a source of the rows of a light field. The light field must outlive the source.
RowSource SourceOf(const LightField& field);

// Makes the engine's windows read from `field`. If field.in_place is false, `field` must remain
// valid.
void UseLightField(const LightField& field, EngineState* engine);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_LIGHT_FIELD_H_
