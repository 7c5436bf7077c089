/* SPDX-License-Identifier: Apache-2.0 */
/* Minimal program: refocuses a chequered picture whose disparity rises from left to right. Writes
 * the picture minimal.ppm and prints the status of the refocusing. */
#include <starfocus/starfocus.h>
#include <stdio.h>
#include <stdlib.h>
enum { W = 320, H = 200 };
static uint8_t view[W * H * 3], out[W * H * 3];
static float disparity[W * H];

int main(void) {
  for (int i = 0; i < W * H; ++i) disparity[i] = (float)(i % W) / W * 16 - 8;
  for (int i = 0; i < W * H * 3; ++i) view[i] = (i / 3 % W / 8 + i / 3 / W / 8) % 2 ? 60 : 240;
  starfocus_config config; /* one view of W x H pixels, blur radius at most 8 pixels */
  starfocus_config_init(&config);
  config.width = W, config.height = H, config.views = 1;
  config.disparity_min = -8, config.disparity_max = 8, config.max_blur = 8;
  size_t bytes = 0;
  starfocus_status status = starfocus_workspace_size(&config, &bytes, NULL);
  char* memory = malloc(bytes + STARFOCUS_ALIGNMENT); /* with room to align the workspace */
  void* workspace =
      memory ? memory + (STARFOCUS_ALIGNMENT - (uintptr_t)memory % STARFOCUS_ALIGNMENT) : NULL;
  starfocus_engine* engine = NULL;
  if (!status) status = starfocus_init(&config, workspace, bytes, &engine, NULL);
  starfocus_params params; /* defaults: focus 0, which is the middle column, and aperture 1 */
  starfocus_params_init(&params);
  starfocus_light_field field = {.size = sizeof field, .views = {starfocus_image_rgb(view, W * 3)}};
  field.depth = starfocus_depth_float(disparity, W * sizeof(float), W, H);
  starfocus_image picture = starfocus_image_rgb(out, W * 3);
  if (!status) status = starfocus_refocus(engine, &params, &field, &picture, NULL);
  FILE* file = status ? NULL : fopen("minimal.ppm", "wb");
  if (file) fprintf(file, "P6 %d %d 255\n", W, H), fwrite(out, 3, W * H, file), fclose(file);
  free(memory);
  return puts(starfocus_status_string(status)), !file;
}
