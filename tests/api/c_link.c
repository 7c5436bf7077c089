/* SPDX-License-Identifier: Apache-2.0 */
/* A C99 program that uses only starfocus.h and links the shared library. The program refocuses a
 * tiny constant picture, which must not change. */
#include <starfocus/starfocus.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

enum { kWidth = 9, kHeight = 5, kLevel = 77 };

static int Fail(const char* what, starfocus_status status) {
  fprintf(stderr, "%s: %s\n", what, starfocus_status_string(status));
  return 1;
}

/* Returns the first address at or after `memory` with the alignment that the engine requires. */
static void* Align(void* memory) {
  const uintptr_t address = (uintptr_t)memory;
  const uintptr_t beyond = address % STARFOCUS_ALIGNMENT;
  return (char*)memory + (beyond ? STARFOCUS_ALIGNMENT - beyond : 0);
}

static int Run(const starfocus_config* config, void* workspace, size_t bytes) {
  static uint8_t picture[3 * kWidth * kHeight], out[3 * kWidth * kHeight];
  static float disparity[kWidth * kHeight];
  starfocus_light_field field;
  starfocus_light_field_init(&field);
  starfocus_engine* engine = NULL;
  starfocus_params params;
  starfocus_image result;
  starfocus_status status;
  size_t i;
  for (i = 0; i < sizeof picture; ++i) picture[i] = kLevel;
  for (i = 0; i < kWidth * kHeight; ++i) disparity[i] = (float)(i % 3);
  field.views[0] = starfocus_image_rgb(picture, 3 * kWidth);
  field.depth = starfocus_depth_float(disparity, kWidth * sizeof(float), kWidth, kHeight);
  status = starfocus_init(config, workspace, bytes, &engine, NULL);
  if (status != STARFOCUS_OK) return Fail("starfocus_init", status);
  starfocus_params_init(&params);
  params.focus = -1.0;
  result = starfocus_image_rgb(out, 3 * kWidth);
  status = starfocus_refocus(engine, &params, &field, &result, NULL);
  if (status != STARFOCUS_OK) return Fail("starfocus_refocus", status);
  for (i = 0; i < sizeof out; ++i) {
    if (out[i] != kLevel) {
      fprintf(stderr, "sample %d is %d\n", (int)i, out[i]);
      return 1;
    }
  }
  return 0;
}

int main(void) {
  starfocus_config config;
  size_t bytes = 0;
  starfocus_status status;
  void* memory;
  int result;
  uint32_t abi = 0;
  if (!starfocus_version(&abi) || abi != STARFOCUS_ABI)
    return Fail("starfocus_version", STARFOCUS_ERROR_STRUCTURE);
  starfocus_config_init(&config);
  config.width = kWidth;
  config.height = kHeight;
  config.views = 1;
  config.disparity_max = 2.0f;
  status = starfocus_workspace_size(&config, &bytes, NULL);
  if (status != STARFOCUS_OK) return Fail("starfocus_workspace_size", status);
  memory = malloc(bytes + STARFOCUS_ALIGNMENT);
  if (!memory) return Fail("malloc", STARFOCUS_ERROR_NULL);
  result = Run(&config, Align(memory), bytes);
  free(memory);
  if (result) return result;
  {
    starfocus_engine* engine = NULL;
    if (starfocus_fields("starfocus_config", NULL, NULL) != sizeof config)
      return Fail("starfocus_fields", STARFOCUS_ERROR_RANGE);
    status = starfocus_create(&config, NULL, &engine, NULL);
    if (status != STARFOCUS_OK) return Fail("starfocus_create", status);
    starfocus_destroy(engine);
  }
  return 0;
}
