/* SPDX-License-Identifier: Apache-2.0 */
#include "platform/web/src/fields.h"

#include <string.h>

typedef enum FieldType { kInt32, kUint32, kDouble } FieldType;

typedef struct Field {
  const char* name;
  uint16_t offset;
  uint16_t type;
} Field;

#define CONFIG(name, type) \
  { #name, offsetof(starfocus_config, name), type }
#define TUNING(name, type) \
  { #name, offsetof(starfocus_config, tuning.name), type }
#define PARAMS(name, type) \
  { #name, offsetof(starfocus_params, name), type }
#define LENS(name, type) \
  { #name, offsetof(starfocus_params, lens.name), type }

static const Field kConfigFields[] = {
    CONFIG(width, kInt32),          CONFIG(height, kInt32),           CONFIG(views, kInt32),
    CONFIG(disparity_min, kDouble), CONFIG(disparity_max, kDouble),   CONFIG(max_blur, kDouble),
    CONFIG(superblock, kInt32),     CONFIG(previews, kInt32),         CONFIG(transfer, kInt32),
    CONFIG(highlights, kDouble),    TUNING(max_layer, kInt32),        TUNING(deblocking, kInt32),
    TUNING(gather, kInt32),         TUNING(n_scale, kDouble),         TUNING(timing.block, kUint32),
    TUNING(timing.field, kUint32),  TUNING(timing.a, kUint32),        TUNING(timing.b, kUint32),
    TUNING(timing.c, kUint32),      TUNING(timing.upsample, kUint32), TUNING(timing.span, kUint32),
    TUNING(timing.hole, kUint32),
};

static const Field kParamsFields[] = {
    PARAMS(mode, kInt32),      PARAMS(renderer, kInt32),     PARAMS(region.x, kInt32),
    PARAMS(region.y, kInt32),  PARAMS(region.width, kInt32), PARAMS(region.height, kInt32),
    LENS(focus, kDouble),      LENS(focus_nearer, kDouble),  LENS(focus_farther, kDouble),
    LENS(aperture, kDouble),   LENS(shape, kInt32),          LENS(blades, kInt32),
    LENS(theta, kDouble),      LENS(rotation, kDouble),      LENS(curvature, kDouble),
    LENS(ring_inner, kDouble), LENS(cats_eye, kDouble),
};

/* Returns `value`, or `wrong` if it is not an integer in [low, high]. `wrong` is outside the valid
 * range of every field, so the library rejects it. */
static int64_t Whole(double value, int64_t low, int64_t high, int64_t wrong) {
  if (!(value >= (double)low && value <= (double)high)) return wrong;
  const int64_t whole = (int64_t)value;
  return (double)whole == value ? whole : wrong;
}

static void Store(void* to, FieldType type, double value) {
  switch (type) {
    case kInt32:
      *(int32_t*)to = (int32_t)Whole(value, INT32_MIN, INT32_MAX, INT32_MIN);
      break;
    case kUint32:
      *(uint32_t*)to = (uint32_t)Whole(value, 0, UINT32_MAX, UINT32_MAX);
      break;
    case kDouble:
      *(double*)to = value;
      break;
  }
}

static int Set(void* structure, const Field* fields, size_t count, const char* name, double value) {
  for (size_t i = 0; i < count; ++i) {
    if (strcmp(fields[i].name, name) != 0) continue;
    Store((char*)structure + fields[i].offset, (FieldType)fields[i].type, value);
    return 1;
  }
  return 0;
}

static int SetFeature(starfocus_config* config, uint32_t feature, double value) {
  /* A value other than 0 and 1 sets all bits, which the library rejects. */
  const uint32_t bits = value == 0 || value == 1 ? feature : UINT32_MAX;
  config->features = value == 0 ? config->features & ~bits : config->features | bits;
  return 1;
}

int SetConfigField(starfocus_config* config, const char* name, double value) {
  if (strcmp(name, "fill_unknown") == 0)
    return SetFeature(config, STARFOCUS_FEATURE_FILL_UNKNOWN, value);
  if (strcmp(name, "shapes") == 0) return SetFeature(config, STARFOCUS_FEATURE_SHAPES, value);
  return Set(config, kConfigFields, sizeof(kConfigFields) / sizeof(kConfigFields[0]), name, value);
}

int SetParamsField(starfocus_params* params, const char* name, double value) {
  return Set(params, kParamsFields, sizeof(kParamsFields) / sizeof(kParamsFields[0]), name, value);
}
