// SPDX-License-Identifier: Apache-2.0
// Makes light fields: of surfaces for every layer, and with integer arithmetic only. The latter are
// equal on every machine and with every compiler, since neither rounding nor the order of
// evaluation affects them. Tests of checksums and the instruction bench use them.
#ifndef STARFOCUS_TESTS_SUPPORT_SCENES_H_
#define STARFOCUS_TESTS_SUPPORT_SCENES_H_

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

enum class Depth { kLayers, kSlanted, kNoise, kRoom };

// Returns a multiple of 1/64, 1/160, 1/20 or 1/7 as the disparity. Each disparity is computed with
// a single division, so the result is equal on every machine.
inline float DisparityAt(Depth depth, int x, int y, Random* random) {
  switch (depth) {
    case Depth::kLayers: {
      const bool near = (x / 19 + y / 23) % 3 == 0, middle = (x * 2 + y) % 71 < 24;
      return static_cast<float>(near ? 250 : middle ? 37 : -130) / 64.0f;
    }
    case Depth::kSlanted:
      return static_cast<float>(3 * x - 2 * y) / 160.0f;
    case Depth::kNoise:
      return static_cast<float>(random->Int(-21, 21)) / 7.0f;
    // The room consists of a wall, a floor that comes nearer towards the bottom, and a disc and a
    // pole in front.
    case Depth::kRoom: {
      const int dx = x - 120, dy = y - 90;
      if (dx * dx + dy * dy < 56 * 56) return 3.5f;
      if (x >= 290 && x < 302) return 1.25f;
      return y < 150 ? -3.0f : static_cast<float>(y - 150) / 20.0f - 3.0f;
    }
  }
  return 0;
}

// Makes pictures of smooth shading with noise and hard edges. Views have different shifts and
// shading, so that samples of a wrong view are detected.
inline Scene IntegerScene(int width, int height, int views, Depth depth) {
  Scene scene = EmptyScene(width, height, views, -4, 4);
  Random random(static_cast<uint64_t>(views) * 10 + static_cast<uint64_t>(depth));
  for (int view = 0; view < views; ++view) {
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        for (int c = 0; c < 3; ++c) {
          const int shade = 5 * x + 3 * y * (c + 1) + 29 * view;
          const int edge = ((x + 2 * view) / 9 + y / 7) % 2 * 90;
          const int noise = random.Int(0, 40);
          scene.Pixel(view, x, y)[c] = static_cast<uint8_t>(shade / 4 % 126 + edge + noise);
        }
      }
    }
  }
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) scene.Disparity(x, y) = DisparityAt(depth, x, y, &random);
  }
  return scene;
}

// Makes a picture of noise, in which each pixel has one of `levels` random disparities within
// +-range. Each of the `levels` disparities requires a slice. If `levels` exceeds the limit of
// slices in a block, the slices become wider.
inline Scene LevelScene(int side, int levels, int range) {
  Scene scene = EmptyScene(side, side, 1, static_cast<float>(-range), static_cast<float>(range));
  Random random(static_cast<uint64_t>(1000 * range + levels));
  std::vector<float> disparities;
  for (int level = 0; level < levels; ++level) {
    disparities.push_back(static_cast<float>(random.Int(-64 * range, 64 * range)) / 64.0f);
  }
  for (uint8_t& sample : scene.pictures[0]) sample = random.Byte();
  for (float& disparity : scene.disparity) {
    disparity = disparities[static_cast<size_t>(random.Int(0, levels - 1))];
  }
  return scene;
}

}  // namespace test

#endif  // STARFOCUS_TESTS_SUPPORT_SCENES_H_
