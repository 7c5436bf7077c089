// SPDX-License-Identifier: Apache-2.0
// Shared code of the conformance tests: the distance of the engine's bytes from the reference, and
// random scenes.
#ifndef STARFOCUS_TESTS_CONFORMANCE_CONFORMANCE_H_
#define STARFOCUS_TESTS_CONFORMANCE_CONFORMANCE_H_

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/shapes.h"
#include "tests/support/test_scene.h"
#ifdef STARFOCUS_PROGRAM
#include "platform/light_field.h"
#endif

namespace conformance {

inline constexpr double kMeanLimit = 0.3;
// Smallest number of samples of a picture whose mean difference is checked. A mean over fewer
// samples is not meaningful: one level in one sample of a single pixel is already a mean of 1/3.
inline constexpr size_t kEnoughSamples = 300;

struct Distance {
  int largest = 0;       // Largest difference between bytes of the engine and the reference.
  double unrounded = 0;  // Largest difference of an engine's byte from the unrounded reference.
  double sum = 0;        // Sum of all differences between bytes.
  double samples = 0;
  // Largest mean difference of all pictures with at least kEnoughSamples samples.
  double worst_mean = 0;

  double mean() const { return samples == 0 ? 0 : sum / samples; }

  void Add(const Distance& other) {
    largest = std::max(largest, other.largest);
    unrounded = std::max(unrounded, other.unrounded);
    if (other.samples >= kEnoughSamples) worst_mean = std::max(worst_mean, other.mean());
    sum += other.sum;
    samples += other.samples;
  }

  void Print(const char* name) const {
    std::printf("%s: %.0f samples, largest difference %d (%.3f unrounded), mean %.4f, worst %.4f\n",
                name, samples, largest, unrounded, mean(), worst_mean);
  }
};

inline Distance Compare(const std::vector<uint8_t>& bytes, const std::vector<double>& exact) {
  REQUIRE(bytes.size() == exact.size());
  Distance distance;
  for (size_t i = 0; i < bytes.size(); ++i) {
    const int difference = std::abs(int(bytes[i]) - int(std::floor(exact[i] + 0.5)));
    distance.largest = std::max(distance.largest, difference);
    distance.unrounded = std::max(distance.unrounded, std::fabs(bytes[i] - exact[i]));
    distance.sum += difference;
  }
  distance.samples = double(bytes.size());
  return distance;
}

enum class Depth { kConstant, kPiecewise, kSlanted, kNoisy };
enum class Colours { kRandom, kExtreme, kSmooth, kAny };

inline void SetDepth(Depth depth, test::Scene* scene, test::Random* random) {
  const double low = scene->disparity_min, high = scene->disparity_max;
  if (depth == Depth::kPiecewise) return test::RandomDisparity(scene, random);
  if (depth == Depth::kNoisy) return test::NoisyDisparity(scene, random);
  const double base = random->Real(low, high);
  const double dx = depth == Depth::kConstant ? 0 : random->Real(-0.3, 0.3);
  const double dy = depth == Depth::kConstant ? 0 : random->Real(-0.3, 0.3);
  for (int y = 0; y < scene->height; ++y) {
    for (int x = 0; x < scene->width; ++x) {
      scene->Disparity(x, y) =
          std::clamp(float(base + dx * x + dy * y), scene->disparity_min, scene->disparity_max);
    }
  }
}

inline void SetColours(Colours colours, test::Scene* scene, test::Random* random) {
  if (colours == Colours::kAny) colours = Colours(random->Int(0, 2));
  for (auto& picture : scene->pictures) {
    int level = random->Int(0, 255);
    for (uint8_t& sample : picture) {
      level = std::clamp(level + random->Int(-9, 9), 0, 255);
      sample = colours == Colours::kRandom    ? random->Byte()
               : colours == Colours::kExtreme ? uint8_t(random->Int(0, 1) * 255)
                                              : uint8_t(level);
    }
  }
}

struct Range {
  float low, high;
};

inline constexpr int kStars[] = {1, 5, 9, 17};
inline constexpr Depth kDepths[] = {Depth::kConstant, Depth::kPiecewise, Depth::kSlanted,
                                    Depth::kNoisy};

inline test::Scene MakeScene(int width, int height, int views, const Range& range, Depth depth,
                             test::Random* random, Colours colours = Colours::kAny) {
  test::Scene scene = test::EmptyScene(width, height, views, range.low, range.high);
  SetDepth(depth, &scene, random);
  SetColours(colours, &scene, random);
  return scene;
}

// Describes a scene, its parameters and its configuration in one line.
inline std::string TextOf(const test::Scene& scene, const starfocus::Params& params,
                          const test::Config& config) {
  char text[600];
  std::snprintf(text, sizeof(text),
                "%dx%d, %d views, mode %d, rule %d, disparity [%.9g, %.9g], focus %.9g + %.9g "
                "- %.9g, aperture %.9g, block %d, layers %d, theta %.9g, n_scale %.9g, gather %d, "
                "block cost %u, "
                "transfer %d, highlights %.9g, %s",
                scene.width, scene.height, scene.views(), params.study.mode, params.study.renderer,
                double{scene.disparity_min}, double{scene.disparity_max}, params.focus,
                params.focus_nearer, params.focus_farther, params.aperture, config.superblock,
                config.tuning.max_layer, params.theta, config.tuning.n_scale, config.tuning.gather,
                config.tuning.timing.block, config.transfer, double{config.highlights},
                test::ShapeText(params).c_str());
  return text;
}

#ifdef STARFOCUS_PROGRAM
// Returns the part of a data set's light field at (x0, y0).
inline test::Scene Crop(const starfocus::LightField& field, int x0, int y0, int width, int height) {
  float low = field.disparity.at(x0, y0), high = low;
  test::Scene scene = test::EmptyScene(width, height, int(field.views.size()), low, high);
  for (int y = 0; y < height; ++y) {
    for (int view = 0; view < scene.views(); ++view) {
      const starfocus::Image& picture = field.views[size_t(view)];
      std::copy_n(picture.pixels.data() + size_t(y0 + y) * picture.stride() + size_t(3 * x0),
                  3 * width, scene.Pixel(view, 0, y));
    }
    for (int x = 0; x < width; ++x) {
      const float disparity = field.disparity.at(x0 + x, y0 + y);
      scene.Disparity(x, y) = disparity;
      low = std::min(low, disparity);
      high = std::max(high, disparity);
    }
  }
  scene.disparity_min = low;
  scene.disparity_max = high;
  return scene;
}

#endif

}  // namespace conformance

#endif  // STARFOCUS_TESTS_CONFORMANCE_CONFORMANCE_H_
