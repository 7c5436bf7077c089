/* SPDX-License-Identifier: Apache-2.0 */
/* A C99 program that uses only starfocus.h and links the shared library. The program refocuses a
 * tiny constant picture, which must not change. */
#include <starfocus/starfocus.h>
#include <stdint.h>
#include <stdio.h>

enum { kWidth = 9, kHeight = 5, kLevel = 77 };

static int Fail(const char* what, starfocus_status status) {
  fprintf(stderr, "%s: %s\n", what, starfocus_status_string(status));
  return 1;
}

static int Run(starfocus_engine* engine) {
  static uint8_t picture[3 * kWidth * kHeight], out[3 * kWidth * kHeight];
  static float disparity[kWidth * kHeight];
  starfocus_light_field field;
  starfocus_params params;
  starfocus_image result;
  starfocus_status status;
  size_t i;
  for (i = 0; i < sizeof picture; ++i) picture[i] = kLevel;
  for (i = 0; i < kWidth * kHeight; ++i) disparity[i] = (float)(i % 3);
  starfocus_light_field_init(&field);
  field.views[0] = starfocus_image_rgb(picture, 3 * kWidth);
  field.depth = starfocus_depth_float(disparity, kWidth * sizeof(float), kWidth, kHeight);
  starfocus_params_init(&params);
  params.focus = -1.0;
  result = starfocus_image_rgb(out, 3 * kWidth);
  status = starfocus_refocus(engine, &params, &field, &result, NULL);
  if (status != STARFOCUS_OK) return Fail("starfocus_refocus", status);
  for (i = 0; i < sizeof out; ++i) {
    if (out[i] == kLevel) continue;
    fprintf(stderr, "sample %d is %d\n", (int)i, out[i]);
    return 1;
  }
  return 0;
}

int main(void) {
  starfocus_config config;
  starfocus_engine* engine = NULL;
  starfocus_status status;
  int result;
  uint32_t abi = 0;
  if (!starfocus_version(&abi) || abi != STARFOCUS_ABI)
    return Fail("starfocus_version", STARFOCUS_ERROR_STRUCTURE);
  if (starfocus_fields("starfocus_config", NULL, NULL) != sizeof config)
    return Fail("starfocus_fields", STARFOCUS_ERROR_RANGE);
  starfocus_config_init(&config);
  config.width = kWidth;
  config.height = kHeight;
  config.views = 1;
  config.disparity_max = 2.0f;
  status = starfocus_create(&config, NULL, &engine, NULL);
  if (status != STARFOCUS_OK) return Fail("starfocus_create", status);
  result = Run(engine);
  starfocus_destroy(engine);
  return result;
}
