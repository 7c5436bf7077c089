// SPDX-License-Identifier: Apache-2.0
// Reference of deblocking, as in the paper (V-C), for a whole picture at once.
#ifndef STARFOCUS_TESTS_LIB_DEBLOCK_REFERENCE_H_
#define STARFOCUS_TESTS_LIB_DEBLOCK_REFERENCE_H_

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "tests/support/transfer_curve.h"

namespace test {

constexpr int kUnit = 16;

// A picture and the layers of its smallest blocks.
struct LayeredPicture {
  LayeredPicture(int w, int h)
      : width(w),
        height(h),
        columns((w + kUnit - 1) / kUnit),
        rows((h + kUnit - 1) / kUnit),
        rgb(3 * size_t(w) * size_t(h)),
        layers(size_t(columns) * size_t(rows)) {}

  uint8_t* Pixel(int x, int y) { return rgb.data() + 3 * (size_t(y) * size_t(width) + size_t(x)); }
  uint8_t& Layer(int column, int row) {
    return layers[size_t(row) * size_t(columns) + size_t(column)];
  }
  int LayerOf(int x, int y) { return Layer(x / kUnit, y / kUnit); }

  int width, height, columns, rows;
  std::vector<uint8_t> rgb;
  std::vector<uint8_t> layers;
};

// Returns true if the condition of equations (16) and (17) holds.
inline bool Artificial(const uint8_t* a, const uint8_t* b, int beta) {
  bool all = true;
  for (int c = 0; c < 3; ++c) all = all && std::abs(int(a[c]) - int(b[c])) < beta;
  return all;
}

// Filters a line of pixels p0, q0, q1, q2, q3. The line starts with p0 at (x, y) and runs in
// direction (dx, dy) within the picture. Interpolates linearly between p0 and q3 if p0 is at layer
// 2 and the strong condition holds, otherwise between p0 and q1.
inline void FilterLine(LayeredPicture* picture, int x, int y, int dx, int dy, int beta,
                       int transfer) {
  const auto inside = [&](int k) {
    const int qx = x + dx * (k + 1), qy = y + dy * (k + 1);
    return qx >= 0 && qx < picture->width && qy >= 0 && qy < picture->height;
  };
  const auto q = [&](int k) { return picture->Pixel(x + dx * (k + 1), y + dy * (k + 1)); };
  const uint8_t* p0 = picture->Pixel(x, y);
  const bool strong = picture->LayerOf(x, y) == 2;
  int last = 0;  // q[last] does not change
  if (strong && inside(3) && Artificial(p0, q(3), beta)) {
    last = 3;
  } else if (inside(1) && Artificial(p0, q(1), beta)) {
    last = 1;
  }
  for (int c = 0; c < 3; ++c) {
    // Rounds samples to the engine's grid of light, since the conditions of later lines depend on
    // the result.
    const auto light = [&](int code) { return std::floor(128 * LightOf(code, transfer) + 0.5); };
    const double from = light(p0[c]), to = last > 0 ? light(q(last)[c]) : 0;
    for (int k = 0; k < last; ++k) {
      const double mixed = std::floor((from * (last - k) + to * (k + 1)) / (last + 1) + 0.5);
      q(k)[c] = uint8_t(CodeOf(mixed / 128, transfer) + 0.5);
    }
  }
}

// Filters the side of the lower layer at two adjacent pixels of a boundary.
inline void FilterPair(LayeredPicture* picture, int x0, int y0, int x1, int y1, int beta,
                       int transfer) {
  const int before = picture->LayerOf(x0, y0), after = picture->LayerOf(x1, y1);
  if (before > after) FilterLine(picture, x0, y0, x1 - x0, y1 - y0, beta, transfer);
  if (before < after) FilterLine(picture, x1, y1, x0 - x1, y0 - y1, beta, transfer);
}

// Filters all horizontal boundaries of the picture, then all vertical boundaries.
inline void DeblockPicture(LayeredPicture* picture, int beta, int transfer) {
  for (int y = kUnit; y < picture->height; y += kUnit) {
    for (int x = 0; x < picture->width; ++x) {
      FilterPair(picture, x, y - 1, x, y, beta, transfer);
    }
  }
  for (int y = 0; y < picture->height; ++y) {
    for (int x = kUnit; x < picture->width; x += kUnit) {
      FilterPair(picture, x - 1, y, x, y, beta, transfer);
    }
  }
}

}  // namespace test

#endif  // STARFOCUS_TESTS_LIB_DEBLOCK_REFERENCE_H_
