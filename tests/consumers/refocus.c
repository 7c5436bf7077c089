/* SPDX-License-Identifier: Apache-2.0 */
/* Refocuses the scene near and far through the C interface and prints both checksums. WITH_POOL: on
 * threads of the package's pool. */
#include <stdio.h>
#include <stdlib.h>

#include "scene.h"
#ifdef WITH_POOL
#include <starfocus/pool.h>
#endif

#if defined(HWY_COMPILE_ONLY_STATIC) || defined(HWY_COMPILE_ALL_ATTAINABLE) || \
    defined(HWY_SHARED_DEFINE) || defined(STARFOCUS_CHECK_RANGES)
#error "Definitions of starfocus or Highway leak to those who link the library."
#endif

static Scene scene;
static uint8_t out[kHeight * kStride];

int main(void) {
  const double foci[] = {6, -4};
  const sf_light_field field = MakeScene(&scene);
  sf_config config;
  sf_params params;
  const sf_image picture = sf_image_rgb(out, kStride);
  sf_engine* engine = NULL;
  sf_callbacks callbacks = {0};
  sf_status status;
  size_t bytes = 0, i;
  char* memory;
  sf_config_init(&config);
  ConfigureFor(&config);
#ifdef WITH_POOL
  sf_pool* const pool = sf_pool_create(3);
  if (!pool) return 1;
  config.max_workers = sf_pool_workers(pool);
  callbacks.runner = sf_pool_run;
  callbacks.runner_data = pool;
#endif
  status = sf_workspace_size(&config, &bytes);
  memory = (char*)malloc(bytes + SF_ALIGNMENT);
  if (!memory) return 1;
  if (status == SF_OK) {
    status = sf_init(&config, memory + (SF_ALIGNMENT - (uintptr_t)memory % SF_ALIGNMENT), bytes,
                     &engine);
  }
  if (status == SF_OK) status = sf_set_callbacks(engine, &callbacks);
  sf_params_init(&params);
  for (i = 0; status == SF_OK && i < sizeof foci / sizeof *foci; ++i) {
    params.lens.focus = foci[i];
    status = sf_refocus(engine, &params, &field, &picture, NULL);
    if (status == SF_OK) printf("%08x\n", (unsigned)Checksum(out, sizeof out));
  }
  free(memory);
#ifdef WITH_POOL
  sf_pool_destroy(pool);
#endif
  if (status != SF_OK) fprintf(stderr, "refocus: %s\n", sf_status_string(status));
  return status != SF_OK;
}
