// SPDX-License-Identifier: Apache-2.0
// Mattes, and planes that receive maps and coverage.
#ifndef STARFOCUS_TESTS_DEPTH_MATTE_PLANES_H_
#define STARFOCUS_TESTS_DEPTH_MATTE_PLANES_H_

#include <cstdint>
#include <vector>

#include "starfocus/matte.h"
#include "tests/support/test_scene.h"

namespace test {

// Value of samples that no call has written.
inline constexpr uint8_t kUnset = 77;

struct Matte {
  Matte(int w, int h, int pixel_stride = 1, int padding = 0)
      : width(w),
        height(h),
        step(pixel_stride),
        row(w * step + padding),
        bytes(size_t(row) * size_t(h), kUnset) {}
  uint8_t& At(int x, int y) { return bytes[size_t(y * row + x * step + step - 1)]; }
  starfocus_matte Get() const {
    return {bytes.data() + step - 1, size_t(row), step == 1 ? 0 : step, width, height};
  }

  int width, height, step, row;
  std::vector<uint8_t> bytes;
};

inline Matte RandomMatte(int width, int height, int pixel_stride = 1, int padding = 0) {
  Matte matte(width, height, pixel_stride, padding);
  Random random(uint64_t(width + 1000 * height));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) matte.At(x, y) = uint8_t(random.Int(0, 255));
  }
  return matte;
}

// Planes of a result, with padding after each row.
struct Planes {
  static constexpr int kPadding = 3;
  Planes(int w, int h)
      : width(w),
        height(h),
        row(w + kPadding),
        map(size_t(row * h), kUnset),
        coverage(size_t(row * h), kUnset) {}
  starfocus_disparity_output Out() {
    starfocus_disparity_output out = {};
    out.disparity = map.data();
    out.disparity_stride = sizeof(float) * size_t(row);
    out.coverage = coverage.data();
    out.coverage_stride = size_t(row);
    return out;
  }
  float Map(int x, int y) const { return map[size_t(y * row + x)]; }
  int Coverage(int x, int y) const { return coverage[size_t(y * row + x)]; }
  bool PaddingIsUnset() const {
    for (int y = 0; y < height; ++y) {
      for (int x = width; x < row; ++x) {
        if (Map(x, y) != kUnset || Coverage(x, y) != kUnset) return false;
      }
    }
    return true;
  }

  int width, height, row;
  std::vector<float> map;
  std::vector<uint8_t> coverage;
};

inline constexpr starfocus_matte_depth kFlatSurfaces = {9.5, -2, 0, 0};

}  // namespace test

#endif  // STARFOCUS_TESTS_DEPTH_MATTE_PLANES_H_
