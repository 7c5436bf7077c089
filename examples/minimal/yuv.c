/* SPDX-License-Identifier: Apache-2.0 */
/* Refocuses a camera frame in NV12. The depth map has a quarter of the frame's width and height,
 * and contains distances in millimetres. Writes the luma of the result to yuv.pgm and prints the
 * status. */
#include <starfocus/starfocus.h>
#include <stdio.h>
#include <stdlib.h>
enum { W = 320, H = 200, MW = W / 4, MH = H / 4 };
static uint8_t luma[W * H], chroma[W * H / 2], out_luma[W * H], out_chroma[W * H / 2];
static uint16_t millimetres[MW * MH]; /* distances; 0: unknown */

int main(void) {
  for (int i = 0; i < W * H; ++i) luma[i] = (i % W / 8 + i / W / 8) % 2 ? 60 : 220;
  for (int i = 0; i < W * H / 2; ++i) chroma[i] = i % 2 ? 110 : 140;
  for (int i = 0; i < MW * MH; ++i) millimetres[i] = i % 37 ? (uint16_t)(500 + 40 * (i % MW)) : 0;
  starfocus_config config; /* distances 3660 mm to 500 mm: disparities 8000 / 3660 to 8000 / 500 */
  starfocus_config_init(&config);
  config.width = W, config.height = H, config.views = 1,
  config.features |= STARFOCUS_FEATURE_IMAGES;
  config.disparity_min = 2, config.disparity_max = 16, config.max_blur = 14;
  config.unknown = STARFOCUS_UNKNOWN_FILL;
  size_t bytes = 0;
  starfocus_status status = starfocus_workspace_size(&config, &bytes, NULL);
  char* memory = malloc(bytes + STARFOCUS_ALIGNMENT); /* with room to align the workspace */
  void* workspace =
      memory ? memory + (STARFOCUS_ALIGNMENT - (uintptr_t)memory % STARFOCUS_ALIGNMENT) : NULL;
  starfocus_engine* engine = NULL;
  if (!status) status = starfocus_init(&config, workspace, bytes, &engine, NULL);
  starfocus_light_field field = {.size = sizeof field};
  field.views[0] = (starfocus_image){
      .format = STARFOCUS_FORMAT_NV12, .planes = {luma, chroma}, .strides = {W, W}};
  field.depth = (starfocus_depth_map){.data = millimetres,
                                      .stride = 2 * MW,
                                      .width = MW,
                                      .height = MH,
                                      .type = STARFOCUS_DEPTH_U16,
                                      .meaning = STARFOCUS_DEPTH_RECIPROCAL,
                                      .scale = 8000,
                                      .has_invalid = 1,
                                      .invalid = 0};
  starfocus_image out = {
      .format = STARFOCUS_FORMAT_NV12, .planes = {out_luma, out_chroma}, .strides = {W, W}};
  starfocus_params params; /* focus 8000 / 1000 mm: objects at a distance of 1 m are sharp */
  starfocus_params_init(&params);
  params.focus = 8;
  if (!status) status = starfocus_refocus(engine, &params, &field, &out, NULL);
  FILE* file = status ? NULL : fopen("yuv.pgm", "wb");
  if (file) fprintf(file, "P5 %d %d 255\n", W, H), fwrite(out_luma, 1, W * H, file), fclose(file);
  free(memory);
  return puts(starfocus_status_string(status)), !file;
}
