/* SPDX-License-Identifier: Apache-2.0 */
/* Refocuses the light field of scene.h at a near and a far focus through the C API, and prints both
 * checksums. With WITH_POOL, the thread pool of the package runs the jobs. */
#include <stdio.h>
#include <stdlib.h>

#include "scene.h"
#ifdef WITH_POOL
#include <starfocus/pool.h>
#endif

#if defined(HWY_COMPILE_ONLY_STATIC) || defined(HWY_COMPILE_ALL_ATTAINABLE) || \
    defined(HWY_SHARED_DEFINE) || defined(STARFOCUS_CHECK_RANGES)
#error "Definitions of starfocus or Highway leak to programs that link the library."
#endif

static Scene scene;
static uint8_t out[kHeight * kStride];

int main(void) {
  const double foci[] = {6, -4};
  const starfocus_light_field field = MakeScene(&scene);
  starfocus_config config;
  starfocus_params params;
  const starfocus_image picture = starfocus_image_rgb(out, kStride);
  starfocus_engine* engine = NULL;
  starfocus_callbacks callbacks = {0};
  starfocus_status status;
  size_t bytes = 0, i;
  char* memory;
  starfocus_config_init(&config);
  ConfigureFor(&config);
#ifdef WITH_POOL
  starfocus_pool* const pool = starfocus_pool_create(3);
  if (!pool) return 1;
  config.max_workers = starfocus_pool_workers(pool);
  callbacks.runner = starfocus_pool_run;
  callbacks.runner_data = pool;
#endif
  status = starfocus_workspace_size(&config, &bytes, NULL);
  memory = (char*)malloc(bytes + STARFOCUS_ALIGNMENT);
  if (!memory) return 1;
  if (status == STARFOCUS_OK) {
    status = starfocus_init(
        &config, memory + (STARFOCUS_ALIGNMENT - (uintptr_t)memory % STARFOCUS_ALIGNMENT), bytes,
        &engine, NULL);
  }
  if (status == STARFOCUS_OK) status = starfocus_set_callbacks(engine, &callbacks);
  starfocus_params_init(&params);
  for (i = 0; status == STARFOCUS_OK && i < sizeof foci / sizeof *foci; ++i) {
    params.focus = foci[i];
    status = starfocus_refocus(engine, &params, &field, &picture, NULL);
    if (status == STARFOCUS_OK) printf("%08x\n", (unsigned)Checksum(out, sizeof out));
  }
  free(memory);
#ifdef WITH_POOL
  starfocus_pool_destroy(pool);
#endif
  if (status != STARFOCUS_OK) fprintf(stderr, "refocus: %s\n", starfocus_status_string(status));
  return status != STARFOCUS_OK;
}
