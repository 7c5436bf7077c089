// SPDX-License-Identifier: Apache-2.0
// Makes light fields for tests of block mode, with areas for every layer.
#ifndef STARFOCUS_TESTS_SUPPORT_LAYERED_SCENE_H_
#define STARFOCUS_TESTS_SUPPORT_LAYERED_SCENE_H_

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "starfocus/starfocus.h"
#include "tests/support/test_scene.h"

namespace test {

// Sets the disparities of a slanted background and a few rectangles, with edges, and with flat
// areas that are large enough for layers 1 and 2.
inline void SetSurfaces(Scene* scene, Random* random) {
  const int width = scene->width, height = scene->height;
  const float low = scene->disparity_min, high = scene->disparity_max;
  const int pieces = random->Int(1, 5);
  for (int piece = 0; piece <= pieces; ++piece) {
    const int x0 = piece == 0 ? 0 : random->Int(0, width - 1);
    const int y0 = piece == 0 ? 0 : random->Int(0, height - 1);
    const int x1 = piece == 0 ? width : std::min(width, x0 + random->Int(1, width));
    const int y1 = piece == 0 ? height : std::min(height, y0 + random->Int(1, height));
    const double base = random->Real(low, high),
                 slant = random->Int(0, 1) * random->Real(-.05, .05);
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) {
        const float d = float(base + slant * (x - x0 + y - y0));
        scene->Disparity(x, y) = std::clamp(d, low, high);
      }
    }
  }
}

// Makes a scene of the surfaces of SetSurfaces.
inline Scene LayeredScene(int width, int height, int views, float limit, uint64_t seed) {
  Random random(seed);
  Scene scene = EmptyScene(width, height, views, -limit, limit, int(seed % 4));
  // The texture moves with the view, so the views are approximately consistent.
  for (int view = 0; view < views; ++view) {
    double u = 0, v = 0;
    starfocus_view_position(view, &u, &v, nullptr);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        for (int c = 0; c < 3; ++c) {
          const double wave = std::sin(0.4 * (x + 2 * u) + c) + std::cos(0.3 * (y + 2 * v) - c);
          scene.Pixel(view, x, y)[c] = uint8_t(127 + 50 * wave + random.Int(-20, 20));
        }
      }
    }
  }
  SetSurfaces(&scene, &random);
  return scene;
}

}  // namespace test

#endif  // STARFOCUS_TESTS_SUPPORT_LAYERED_SCENE_H_
