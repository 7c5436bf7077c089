// SPDX-License-Identifier: Apache-2.0
#include "platform/gstreamer/settings.h"

#include <gst/gst.h>

namespace starfocus {
namespace {

// Largest absolute disparity. Blur is limited to half of this.
constexpr double kMost = 2 * STARFOCUS_MAX_BLUR;

constexpr auto kControlled =
    static_cast<GParamFlags>(G_PARAM_READWRITE | G_PARAM_STATIC_STRINGS | GST_PARAM_CONTROLLABLE |
                             GST_PARAM_MUTABLE_PLAYING);

// The properties whose values are numbers. Their identifiers are their places, counted from 1.
constexpr struct {
  const char *name, *title, *text;
  double least, most;
  double RefocusSettings::*field;
} kNumbers[] = {
    {"focus", "Focus", "Disparity in focus, pixels", -kMost, kMost, &RefocusSettings::focus},
    {"aperture", "Aperture", "Radius of the blur in pixels per pixel of disparity from the focus",
     0, 1, &RefocusSettings::aperture},
    {"disparity-black", "Disparity of black",
     "Disparity of the smallest grey value of the depth, pixels", -kMost, kMost,
     &RefocusSettings::black},
    {"disparity-white", "Disparity of white",
     "Disparity of the largest grey value of the depth, pixels", -kMost, kMost,
     &RefocusSettings::white},
};
constexpr guint kNumberCount = G_N_ELEMENTS(kNumbers);
constexpr guint kShape = kNumberCount + 1, kStabilise = kShape + 1, kThreads = kStabilise + 1;
static_assert(kThreads == kSettings, "kSettings counts the properties");

}  // namespace

GType ShapeType() {
  static const GEnumValue values[] = {
      {STARFOCUS_SHAPE_FALL_OFF, "Disc that is darker towards its rim", "fall-off"},
      {STARFOCUS_SHAPE_DISC, "Disc of constant brightness", "disc"},
      {STARFOCUS_SHAPE_POLYGON, "Polygon with 5 corners", "polygon"},
      {STARFOCUS_SHAPE_RING, "Disc with a hole", "ring"},
      {0, nullptr, nullptr}};
  static const GType type = g_enum_register_static("StarfocusShape", values);
  return type;
}

void AddSettings(GObjectClass* object) {
  const RefocusSettings defaults;
  for (guint i = 0; i < kNumberCount; ++i) {
    const auto& number = kNumbers[i];
    g_object_class_install_property(
        object, i + 1,
        g_param_spec_double(number.name, number.title, number.text, number.least, number.most,
                            defaults.*number.field, kControlled));
  }
  g_object_class_install_property(
      object, kShape,
      g_param_spec_enum("shape", "Shape", "Shape of the opening of the lens", ShapeType(),
                        defaults.shape, kControlled));
  g_object_class_install_property(
      object, kStabilise,
      g_param_spec_boolean("stabilise", "Stabilise", "Reduce the flicker of the depth",
                           defaults.stabilise, kControlled));
  g_object_class_install_property(
      object, kThreads,
      g_param_spec_int("threads", "Threads", "Number of threads; 0: as many as fast cores", 0,
                       STARFOCUS_MAX_WORKERS, defaults.threads, kControlled));
}

void SetSetting(guint id, const GValue* value, RefocusSettings* settings) {
  if (id <= kNumberCount) settings->*kNumbers[id - 1].field = g_value_get_double(value);
  if (id == kShape) settings->shape = g_value_get_enum(value);
  if (id == kStabilise) settings->stabilise = g_value_get_boolean(value);
  if (id == kThreads) settings->threads = g_value_get_int(value);
}

void GetSetting(guint id, const RefocusSettings& settings, GValue* value) {
  if (id <= kNumberCount) g_value_set_double(value, settings.*kNumbers[id - 1].field);
  if (id == kShape) g_value_set_enum(value, settings.shape);
  if (id == kStabilise) g_value_set_boolean(value, settings.stabilise);
  if (id == kThreads) g_value_set_int(value, settings.threads);
}

}  // namespace starfocus
