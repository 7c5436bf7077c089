// SPDX-License-Identifier: Apache-2.0
// Makes light fields with integer arithmetic. The light fields are equal on every machine and with
// every compiler, since neither rounding nor the order of evaluation affects them. Tests of
// checksums and the instruction bench use these light fields.
#ifndef STARFOCUS_TESTS_SUPPORT_INTEGER_SCENE_H_
#define STARFOCUS_TESTS_SUPPORT_INTEGER_SCENE_H_

#include "tests/support/test_scene.h"

namespace test {

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

#endif  // STARFOCUS_TESTS_SUPPORT_INTEGER_SCENE_H_
