/* SPDX-License-Identifier: Apache-2.0 */
#include "tap_to_focus.h"

starfocus_status TapToFocus(const Frame* frame, int32_t x, int32_t y, uint8_t* out[2]) {
  const int32_t width = frame->width, height = frame->height;
  const size_t row = (size_t)width;
  starfocus_image view = {STARFOCUS_FORMAT_NV12, 0, 0, 0, {frame->luma, frame->chroma}, {row, row}};
  starfocus_image picture = {STARFOCUS_FORMAT_NV12, 0, 0, 0, {out[0], out[1]}, {row, row}};
  starfocus_depth_map map = {.data = frame->millimetres, .stride = row / 2, .has_invalid = 1};
  map.width = width / 4, map.height = height / 4, map.type = STARFOCUS_DEPTH_U16;
  map.meaning = STARFOCUS_DEPTH_RECIPROCAL, map.scale = 8000; /* disparity = 8000 / distance */
  const starfocus_light_field field = {.size = sizeof field, .views = {view}, .depth = map};
  starfocus_config config;
  starfocus_config_init(&config);
  starfocus_params params;
  starfocus_params_init(&params);
  starfocus_engine* engine = NULL;
  starfocus_prepared* prepared = NULL;
  starfocus_disparity_stats range = {0, 0, 0};
  starfocus_status status = starfocus_measure_disparity(&map, &range, NULL);
  config.width = width, config.height = height, config.views = 1;
  config.disparity_min = range.min, config.disparity_max = range.max;
  config.features |= STARFOCUS_FEATURE_IMAGES, config.unknown = STARFOCUS_UNKNOWN_FILL;
  if (!status) status = starfocus_create(&config, NULL, &engine, NULL);
  if (!status) status = starfocus_prepare(engine, &field, NULL, 0, &prepared);
  if (!status) status = starfocus_focus_at(&map, width, height, x, y, &params.focus, NULL);
  if (!status) status = starfocus_largest_aperture(engine, &params, &params.aperture);
  if (!status) status = starfocus_refocus_prepared(engine, &params, prepared, &picture, NULL);
  starfocus_destroy_prepared(prepared);
  starfocus_destroy(engine);
  return status;
}
