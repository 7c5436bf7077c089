// SPDX-License-Identifier: Apache-2.0
// The symmetries of the square, applied to pixels, captured views and light fields.
#ifndef STARFOCUS_TESTS_SUPPORT_SYMMETRY_H_
#define STARFOCUS_TESTS_SUPPORT_SYMMETRY_H_

#include <algorithm>
#include <cstdint>
#include <utility>

#include "starfocus/starfocus.h"
#include "tests/support/test_scene.h"

namespace test {

// A symmetry of the square: an optional transposition, followed by optional mirroring.
struct Symmetry {
  bool transpose, mirror_x, mirror_y;
};

// Returns the position to which a symmetry moves pixel (x, y) of a width x height picture.
inline std::pair<int, int> Move(const Symmetry& s, int width, int height, int x, int y) {
  if (s.transpose) {
    std::swap(x, y);
    std::swap(width, height);
  }
  return {s.mirror_x ? width - 1 - x : x, s.mirror_y ? height - 1 - y : y};
}

// Returns the index of the position that captured view `index` moves to.
inline int MoveView(const Symmetry& s, int index) {
  double u = 0, v = 0;
  starfocus_view_position(index, &u, &v, nullptr);
  if (s.transpose) std::swap(u, v);
  if (s.mirror_x) u = -u;
  if (s.mirror_y) v = -v;
  int to = 0;
  for (int i = 0; i < STARFOCUS_MAX_VIEWS; ++i) {
    double other_u = 0, other_v = 0;
    starfocus_view_position(i, &other_u, &other_v, nullptr);
    if (other_u == u && other_v == v) to = i;
  }
  return to;
}

inline Scene Move(const Symmetry& s, const Scene& scene) {
  Scene moved =
      EmptyScene(s.transpose ? scene.height : scene.width, s.transpose ? scene.width : scene.height,
                 scene.views(), scene.disparity_min, scene.disparity_max);
  for (int y = 0; y < scene.height; ++y) {
    for (int x = 0; x < scene.width; ++x) {
      const auto [mx, my] = Move(s, scene.width, scene.height, x, y);
      moved.Disparity(mx, my) = scene.Disparity(x, y);
      for (int view = 0; view < scene.views(); ++view) {
        std::copy_n(scene.Pixel(view, x, y), 3, moved.Pixel(MoveView(s, view), mx, my));
      }
    }
  }
  return moved;
}

// Difference between the picture `plain`, moved by a symmetry, and the picture `moved`, both packed
// RGB.
struct Distance {
  int samples = 0;  // number of samples that differ
  int largest = 0;
  double mean = 0;
};

inline Distance Compare(const Symmetry& s, int width, int height, const uint8_t* plain,
                        const uint8_t* moved) {
  const int moved_width = s.transpose ? height : width;
  Distance distance;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto [mx, my] = Move(s, width, height, x, y);
      for (int c = 0; c < 3; ++c) {
        const int a = plain[3 * (y * width + x) + c], b = moved[3 * (my * moved_width + mx) + c];
        distance.samples += a != b;
        distance.largest = std::max(distance.largest, a < b ? b - a : a - b);
        distance.mean += (a < b ? b - a : a - b) / (3.0 * width * height);
      }
    }
  }
  return distance;
}

}  // namespace test

#endif  // STARFOCUS_TESTS_SUPPORT_SYMMETRY_H_
