/* SPDX-License-Identifier: Apache-2.0 */
#include "platform/web/src/fields.h"

#include <string.h>

typedef enum FieldType { kInt16, kInt32, kUint32, kFloat, kDouble } FieldType;

typedef struct Field {
  const char* name;
  uint16_t offset;
  uint16_t type;
} Field;

#define CONFIG(name, type) \
  { #name, offsetof(sf_config, name), type }
#define PARAMS(name, type) \
  { #name, offsetof(sf_params, name), type }

static const Field kConfigFields[] = {
    CONFIG(width, kInt32),         CONFIG(height, kInt32),
    CONFIG(views, kInt32),         CONFIG(disparity_min, kFloat),
    CONFIG(disparity_max, kFloat), CONFIG(max_blur, kDouble),
    CONFIG(largest_block, kInt32), CONFIG(theta, kDouble),
    CONFIG(max_layer, kInt32),     CONFIG(deblocking, kInt32),
    CONFIG(timing.block, kUint32), CONFIG(timing.field, kUint32),
    CONFIG(timing.a, kUint32),     CONFIG(timing.b, kUint32),
    CONFIG(timing.c, kUint32),     CONFIG(timing.upsample, kUint32),
    CONFIG(timing.span, kUint32),  CONFIG(timing.hole, kUint32),
    CONFIG(n_scale, kDouble),      CONFIG(skips, kInt32),
    CONFIG(gather, kInt32),        CONFIG(aperture_shape, kInt16),
    CONFIG(blades, kInt16),        CONFIG(rotation, kFloat),
    CONFIG(curvature, kFloat),     CONFIG(ring_inner, kFloat),
    CONFIG(cats_eye, kFloat),      CONFIG(transfer, kInt32),
    CONFIG(highlights, kFloat),    CONFIG(fill_unknown, kInt32),
    CONFIG(previews, kInt32),
};

static const Field kParamsFields[] = {
    PARAMS(mode, kInt32),         PARAMS(focus, kDouble),        PARAMS(aperture, kDouble),
    PARAMS(rule, kInt32),         PARAMS(region.x, kInt32),      PARAMS(region.y, kInt32),
    PARAMS(region.width, kInt32), PARAMS(region.height, kInt32),
};

/* Returns `value`, or `wrong` if it is not a whole number in [low, high]. `wrong` is outside the
 * range of every field, so that the library rejects it. */
static int64_t Whole(double value, int64_t low, int64_t high, int64_t wrong) {
  if (!(value >= (double)low && value <= (double)high)) return wrong;
  const int64_t whole = (int64_t)value;
  return (double)whole == value ? whole : wrong;
}

static void Store(void* to, FieldType type, double value) {
  switch (type) {
    case kInt16:
      *(int16_t*)to = (int16_t)Whole(value, INT16_MIN, INT16_MAX, INT16_MIN);
      break;
    case kInt32:
      *(int32_t*)to = (int32_t)Whole(value, INT32_MIN, INT32_MAX, INT32_MIN);
      break;
    case kUint32:
      *(uint32_t*)to = (uint32_t)Whole(value, 0, UINT32_MAX, UINT32_MAX);
      break;
    case kFloat:
      *(float*)to = (float)value;
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

int SetConfigField(sf_config* config, const char* name, double value) {
  return Set(config, kConfigFields, sizeof(kConfigFields) / sizeof(kConfigFields[0]), name, value);
}

int SetParamsField(sf_params* params, const char* name, double value) {
  return Set(params, kParamsFields, sizeof(kParamsFields) / sizeof(kParamsFields[0]), name, value);
}
