// SPDX-License-Identifier: Apache-2.0
/* Light field of five views that every consumer refocuses: a near square in front of a slope. All
 * numbers of the light field are exact on every machine. The header also defines the checksum of
 * the output. */
#ifndef STARFOCUS_TESTS_BINDINGS_SCENE_H_
#define STARFOCUS_TESTS_BINDINGS_SCENE_H_

#include <starfocus/starfocus.h>

enum { kWidth = 200, kHeight = 150, kViews = 5, kStride = 3 * kWidth };

typedef struct Scene {
  uint8_t views[kViews][kHeight * kStride];
  float disparity[kHeight * kWidth];
} Scene;

static int DisparityAt(int x, int y) {
  return x >= 60 && x < 140 && y >= 40 && y < 110 ? 6 : x / 40 - 4;
}

static uint8_t TextureAt(int x, int y, int channel) {
  return (uint8_t)((x * x + 3 * x * y + 7 * y * y) / (5 + channel) & 255);
}

static starfocus_light_field MakeScene(Scene* scene) {
  starfocus_light_field field;
  int i, x, y, channel;
  starfocus_light_field_init(&field);
  for (i = 0; i < kViews; ++i) {
    double u = 0, v = 0;
    starfocus_view_position(i, &u, &v, NULL);
    for (y = 0; y < kHeight; ++y) {
      for (x = 0; x < kWidth; ++x) {
        const int d = DisparityAt(x, y);
        for (channel = 0; channel < 3; ++channel) {
          scene->views[i][y * kStride + 3 * x + channel] =
              TextureAt(x + (int)u * d + 16 * d, y + (int)v * d, channel);
        }
        if (i == 0) scene->disparity[y * kWidth + x] = (float)d;
      }
    }
    field.views[i] = starfocus_image_rgb(scene->views[i], kStride);
  }
  field.depth = starfocus_depth_float(scene->disparity, kWidth * sizeof(float), kWidth, kHeight);
  return field;
}

static void ConfigureFor(starfocus_config* config) {
  config->width = kWidth;
  config->height = kHeight;
  config->views = kViews;
  config->disparity_min = -4;
  config->disparity_max = 6;
  config->max_blur = 12;
}

/* Returns the 32-bit FNV-1a checksum. */
static uint32_t Checksum(const uint8_t* bytes, size_t count) {
  uint32_t sum = 2166136261u;
  size_t i;
  for (i = 0; i < count; ++i) sum = (sum ^ bytes[i]) * 16777619u;
  return sum;
}

#endif /* STARFOCUS_TESTS_BINDINGS_SCENE_H_ */
