/* SPDX-License-Identifier: Apache-2.0 */
/* C99 program that knows only starfocus.h and links the shared library: refocuses a tiny constant
 * picture and expects it back. */
#include <starfocus/starfocus.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

enum { kWidth = 9, kHeight = 5, kLevel = 77 };

static int Fail(const char* what, sf_status status) {
  fprintf(stderr, "%s: %s\n", what, sf_status_string(status));
  return 1;
}

/* The first address at or after `memory` that the engine accepts. */
static void* Align(void* memory) {
  const uintptr_t address = (uintptr_t)memory;
  const uintptr_t beyond = address % SF_ALIGNMENT;
  return (char*)memory + (beyond ? SF_ALIGNMENT - beyond : 0);
}

static int Run(const sf_config* config, void* workspace, size_t bytes) {
  static uint8_t picture[3 * kWidth * kHeight], out[3 * kWidth * kHeight];
  static float disparity[kWidth * kHeight];
  sf_light_field field = {0};
  sf_engine* engine = NULL;
  sf_params params;
  sf_image result;
  sf_status status;
  size_t i;
  for (i = 0; i < sizeof picture; ++i) picture[i] = kLevel;
  for (i = 0; i < kWidth * kHeight; ++i) disparity[i] = (float)(i % 3);
  field.views[0] = sf_image_rgb(picture, 3 * kWidth);
  field.depth = sf_depth_float(disparity, kWidth * sizeof(float), kWidth, kHeight);
  status = sf_init(config, workspace, bytes, &engine);
  if (status != SF_OK) return Fail("sf_init", status);
  sf_params_init(&params);
  params.lens.focus = -1.0;
  result = sf_image_rgb(out, 3 * kWidth);
  status = sf_refocus(engine, &params, &field, &result, NULL);
  if (status != SF_OK) return Fail("sf_refocus", status);
  for (i = 0; i < sizeof out; ++i) {
    if (out[i] != kLevel) {
      fprintf(stderr, "sample %d is %d\n", (int)i, out[i]);
      return 1;
    }
  }
  return 0;
}

int main(void) {
  sf_config config;
  size_t bytes = 0;
  sf_status status;
  void* memory;
  int result;
  if (sf_abi_version() != SF_ABI_VERSION) return Fail("sf_abi_version", SF_ERROR_STRUCTURE);
  sf_config_init(&config);
  config.width = kWidth;
  config.height = kHeight;
  config.views = 1;
  config.disparity_max = 2.0f;
  status = sf_workspace_size(&config, &bytes);
  if (status != SF_OK) return Fail("sf_workspace_size", status);
  memory = malloc(bytes + SF_ALIGNMENT);
  if (!memory) return Fail("malloc", SF_ERROR_NULL);
  result = Run(&config, Align(memory), bytes);
  free(memory);
  if (result) return result;
  {
    sf_engine* engine = NULL;
    if (sf_struct_size("sf_config") != sizeof config) return Fail("sf_struct_size", SF_ERROR_RANGE);
    status = sf_create(&config, NULL, &engine);
    if (status != SF_OK) return Fail("sf_create", status);
    sf_destroy(engine);
  }
  return 0;
}
