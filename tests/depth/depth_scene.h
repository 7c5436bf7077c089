// SPDX-License-Identifier: Apache-2.0
// Light fields of planes with known disparities, for tests of maps.
#ifndef STARFOCUS_TESTS_DEPTH_DEPTH_SCENE_H_
#define STARFOCUS_TESTS_DEPTH_DEPTH_SCENE_H_

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <new>
#include <vector>

#include "starfocus/depth.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/symmetry.h"
#include "tests/support/test_scene.h"

namespace test {

// Views of a near plane that faces the camera, and of a far plane that may be slanted. Each pixel
// shows the plane with the highest disparity.
struct PlaneScene {
  int width = 96, height = 64, views = 17;
  std::vector<starfocus_position> positions = {};  // Positions of the views; empty: a star.
  // `lean` is the change of the disparity of the far plane per pixel of x.
  double near_left = 30, near_right = 62, near = 5, far = -3, lean = 0;

  // Returns an aperiodic texture, 0 to 255.
  static double Texture(double x, double y, int surface, int c) {
    const double a = std::sin(0.9 * x + 0.31 * y + surface + c) + std::sin(0.37 * x - 0.83 * y + c);
    const double b = std::sin(0.171 * x * (1 + 0.01 * y) + 1.3 * y) * std::cos(0.53 * y - c);
    return std::clamp(128 + 50 * a + 40 * b, 0.0, 255.0);
  }
  bool IsNear(double x) const { return x >= near_left && x < near_right; }
  double DisparityAt(int x) const { return IsNear(x) ? near : far + lean * x; }

  uint8_t Pixel(double u, double v, int x, int y, int c) const {
    double at = x + u * near;
    if (IsNear(at)) return uint8_t(Texture(at, y + v * near, 1, c) + 0.5);
    at = (x + u * far) / (1 - u * lean);  // solution of at - u * (far + lean * at) = x
    return uint8_t(Texture(at, y + v * (far + lean * at), 2, c) + 0.5);
  }
};

struct PlaneField {
  int width = 0, height = 0;
  std::vector<std::vector<uint8_t>> views;
  std::vector<starfocus_position> positions = {};  // Empty: a star.

  starfocus_light_field Get() const {
    starfocus_light_field field = starfocus::NewLightField();
    for (size_t k = 0; k < views.size(); ++k) {
      field.views[k] = starfocus_image_rgb(views[k].data(), 3 * size_t(width));
    }
    return field;
  }
};

// Renders views whose samples are pixel(u, v, x, y, c): a star of `views` views, or the views at
// the given positions.
template <class Pixel>
PlaneField RenderViews(int width, int height, int views, const Pixel& pixel,
                       const std::vector<starfocus_position>& positions = {}) {
  PlaneField field = {width, height, {}, positions};
  if (!positions.empty()) views = int(positions.size());
  field.views.resize(size_t(views));
  for (int k = 0; k < views; ++k) {
    double u = 0, v = 0;
    starfocus_view_position(k, &u, &v, nullptr);
    if (!positions.empty()) u = positions[size_t(k)].u, v = positions[size_t(k)].v;
    for (int at = 0; at < 3 * width * height; ++at) {
      field.views[size_t(k)].push_back(pixel(u, v, at / 3 % width, at / 3 / width, at % 3));
    }
  }
  return field;
}

inline PlaneField RenderPlanes(const PlaneScene& scene) {
  const auto pixel = [&](double u, double v, int x, int y, int c) {
    return scene.Pixel(u, v, x, y, c);
  };
  return RenderViews(scene.width, scene.height, scene.views, pixel, scene.positions);
}

// Returns the map of the scene, with a near plane that is wider by `grown` pixels on both sides.
inline std::vector<float> MapOf(PlaneScene scene, int grown = 0) {
  scene.near_left -= grown;
  scene.near_right += grown;
  std::vector<float> map;
  for (int at = 0; at < scene.width * scene.height; ++at) {
    map.push_back(float(scene.DisparityAt(at % scene.width)));
  }
  return map;
}

inline std::vector<PlaneScene> ScenesOfAnySize() {
  std::vector<PlaneScene> scenes;
  for (const int width : {1, 2, 17, 33}) {
    for (const int height : {1, 3, 30}) scenes.push_back({width, height, 5});
  }
  return scenes;
}

inline test::Config ConfigOf(const PlaneField& field, float low, float high) {
  test::Config config;
  config.width = field.width;
  config.height = field.height;
  config.views = int32_t(field.views.size());
  std::copy(field.positions.begin(), field.positions.end(), config.positions);
  config.disparity_min = low;
  config.disparity_max = high;
  return config;
}

// Owns aligned memory that is filled with one value.
struct Memory {
  explicit Memory(size_t size, int fill = kPoison)
      : bytes(size), data(::operator new (size, std::align_val_t{STARFOCUS_ALIGNMENT})) {
    std::memset(data, fill, size);
  }
  ~Memory() { ::operator delete (data, std::align_val_t{STARFOCUS_ALIGNMENT}); }
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;

  size_t bytes;
  void* data;
};

// Value of samples of confidence and coverage that no call has written; such disparities are NaN.
constexpr uint8_t kUnset = 77;

// All outputs of a call, and the problem that the call reported.
struct MadeMap {
  std::vector<float> disparity;
  std::vector<uint8_t> confidence, coverage;
  int32_t has_coverage = -1;
  starfocus_status status = STARFOCUS_OK;
  starfocus_problem problem = {};

  // Returns true if no call has written disparities or confidence.
  bool IsUnset() const {
    return std::all_of(disparity.begin(), disparity.end(), [](float d) { return std::isnan(d); }) &&
           confidence == std::vector<uint8_t>(confidence.size(), kUnset);
  }
};

enum class Makes { kEstimate, kRepair, kRepairWithCoverage };

// Estimates or repairs the map of a light field, with memory that lacks `missing` bytes and is
// filled with `fill`.
inline MadeMap TryMap(const test::Config& config, const starfocus_light_field& field, Makes makes,
                      const starfocus_callbacks* callbacks = nullptr, size_t missing = 0,
                      int fill = kPoison) {
  const bool estimates = makes == Makes::kEstimate;
  size_t bytes = 0;
  REQUIRE(starfocus_map_workspace_size(&config, estimates ? 0 : 1, &bytes, nullptr) ==
          STARFOCUS_OK);
  const Memory memory(bytes - missing, fill);
  const auto width = size_t(config.width), pixels = width * size_t(config.height);
  MadeMap made = {std::vector<float>(pixels, NAN), std::vector<uint8_t>(pixels, kUnset),
                  std::vector<uint8_t>(pixels, kUnset)};
  starfocus_disparity_output out = {
      made.disparity.data(), sizeof(float) * width, made.confidence.data(), width, nullptr, width,
      made.has_coverage};
  if (makes == Makes::kRepairWithCoverage) out.coverage = made.coverage.data();
  made.status = (estimates ? starfocus_estimate_disparity : starfocus_repair_disparity)(
      &config, callbacks, &field, &out, memory.data, memory.bytes, &made.problem);
  made.has_coverage = out.has_coverage;
  return made;
}

// Returns the estimated map, or the repaired map if `given` is not empty.
inline MadeMap MakeMap(const PlaneField& field, const test::Config& config,
                       const std::vector<float>& given = {}, bool covers = false) {
  starfocus_light_field light_field = field.Get();
  light_field.depth = starfocus_depth_float(given.data(), sizeof(float) * size_t(field.width),
                                            field.width, field.height);
  MadeMap made = TryMap(config, light_field,
                        given.empty() ? Makes::kEstimate
                        : covers      ? Makes::kRepairWithCoverage
                                      : Makes::kRepair);
  REQUIRE(made.status == STARFOCUS_OK);
  return made;
}

inline void CheckWithin(const std::vector<float>& disparity, float low, float high) {
  for (const float value : disparity) REQUIRE((value >= low && value <= high));
}

inline double ShareOff(const PlaneScene& scene, const std::vector<float>& disparity, double by) {
  int off = 0;
  for (int y = 0; y < scene.height; ++y) {
    for (int x = 0; x < scene.width; ++x) {
      const float found = disparity[size_t(y) * size_t(scene.width) + size_t(x)];
      off += !(std::fabs(found - scene.DisparityAt(x)) <= by);
    }
  }
  return double(off) / (scene.width * scene.height);
}

// Returns the light field `field`, mirrored as in `mirror`.
inline PlaneField MirroredField(const PlaneField& field, const Symmetry& mirror) {
  PlaneField mirrored = field;
  for (int k = 0; k < int(field.views.size()); ++k) {
    const std::vector<uint8_t>& from = field.views[size_t(k)];
    const bool star = field.positions.empty();
    std::vector<uint8_t>& to = mirrored.views[size_t(star ? MoveView(mirror, k) : k)];
    if (!star && mirror.mirror_x) mirrored.positions[size_t(k)].u *= -1;
    if (!star && mirror.mirror_y) mirrored.positions[size_t(k)].v *= -1;
    for (int at = 0; at < field.width * field.height; ++at) {
      const auto [x, y] =
          Move(mirror, field.width, field.height, at % field.width, at / field.width);
      std::copy_n(from.begin() + 3 * at, 3, to.begin() + 3 * (y * field.width + x));
    }
  }
  return mirrored;
}

}  // namespace test

#endif  // STARFOCUS_TESTS_DEPTH_DEPTH_SCENE_H_
