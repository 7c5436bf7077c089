// SPDX-License-Identifier: Apache-2.0
// The settings of the element starfocus and their GObject properties.
#ifndef STARFOCUS_PLATFORM_GSTREAMER_SETTINGS_H_
#define STARFOCUS_PLATFORM_GSTREAMER_SETTINGS_H_

#include <glib-object.h>

#include "starfocus/starfocus.h"

namespace starfocus {

struct RefocusSettings {
  double focus = 0, aperture = 1;
  double black = -8, white = 8;  // Disparities of the smallest and the largest grey value.
  int shape = STARFOCUS_SHAPE_FALL_OFF;
  gboolean stabilise = FALSE;
  int threads = 0;  // 0: as many as the machine has fast cores.
};

// Number of settings. Their properties have the identifiers from 1 to kSettings.
inline constexpr guint kSettings = 7;

GType ShapeType();
void AddSettings(GObjectClass* object);
void SetSetting(guint id, const GValue* value, RefocusSettings* settings);
void GetSetting(guint id, const RefocusSettings& settings, GValue* value);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_GSTREAMER_SETTINGS_H_
