// SPDX-License-Identifier: Apache-2.0
// A light field of RGB rows and float disparities in the caller's memory, and RGB pictures.
#ifndef STARFOCUS_LIB_SOURCE_LIGHT_FIELD_H_
#define STARFOCUS_LIB_SOURCE_LIGHT_FIELD_H_

#include "lib/engine/driver.h"
#include "lib/engine/engine.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Rows of a light field, of which the first is row `first` of the picture.
class LightFieldRows {
 public:
  LightFieldRows(const sf_light_field& light_field, int32_t first, const EngineState& engine);

  // Returns a source of the rows; this object must outlive it.
  RowSource Source() const;

  // Points the engine's windows at the rows, which are those of a whole light field.
  void Use(EngineState* engine) const;

 private:
  static uint32_t ReadMap(const void* self, int32_t y, int16_t* out, uint64_t* bytes);
  static void ReadCoverage(const void* self, int32_t y, uint8_t* out);

  const EngineState& engine_;
  Plane<const float> disparity_;
  Plane<const uint8_t> coverage_;  // null: there is none
  PlaneViews planes_;
};

// An RGB picture of the caller's for `rect` of the picture. What has not changed since `previous`
// (null: none) comes from there.
struct Picture {
  uint8_t* data;
  size_t stride;
  Rect rect;
  const sf_previous* previous = nullptr;
};

// Returns a sink that writes to `picture`, which must outlive it.
RowSink SinkOf(const Picture& picture);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_SOURCE_LIGHT_FIELD_H_
