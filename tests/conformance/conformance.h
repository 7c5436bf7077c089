// SPDX-License-Identifier: Apache-2.0
// Shared code of the conformance tests: trials, which are light fields with lenses and
// configurations, and the distance of the engine's bytes from the reference.
#ifndef STARFOCUS_TESTS_CONFORMANCE_CONFORMANCE_H_
#define STARFOCUS_TESTS_CONFORMANCE_CONFORMANCE_H_

#include <doctest/doctest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/conformance/reference.h"
#include "tests/support/config.h"
#include "tests/support/test_scene.h"

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

  // Number of pixels of blocks at each layer, and of pixels that are blurred by a filter, without
  // rendering views.
  int64_t at_layer[STARFOCUS_LAYERS] = {}, gathered = 0;

  void Add(const Distance& other);
  // Prints all values, and checks the mean of all samples.
  void Report(const char* name) const;
};

enum class Depth { kConstant, kPiecewise, kSlanted, kNoisy };
enum class Colours { kRandom, kExtreme, kSmooth, kAny };

struct Range {
  float low, high;
};

test::Scene MakeScene(int width, int height, int views, const Range& range, Depth depth,
                      test::Random* random, Colours colours = Colours::kAny);

struct Trial {
  test::Scene scene;
  starfocus::Params params;
  test::Config config;

  std::string Text() const;
};

// Returns a trial of a scene. The blocks are at layers up to `max_layer`, and the largest blur
// radius is at most `max_blur` pixels.
Trial MakeTrial(const test::Scene& scene, double focus, starfocus_mode mode,
                starfocus_renderer renderer, int max_layer, double max_blur = 24);

// Kinds of random trials. Trials of the kind kAnywhere that render slices have any number of views
// at any positions; the other kinds have the views of a star. The light fields of the kinds kLarge
// and kPaper are larger, and the kind kPaper renders whole pictures by line scans.
enum class Kind { kStar, kAnywhere, kLarge, kPaper };

// Makes the random trial that `seed` identifies.
Trial RandomTrial(uint64_t seed, Kind kind);

// Checks that the engine and the reference, which gets the engine's partition, differ by at most
// one grey level, and returns their distance.
Distance Check(const Trial& trial);

// Checks the random trials of the seeds from `first` to `last`.
Distance CheckRandom(uint64_t first, uint64_t last, Kind kind);

}  // namespace conformance

#endif  // STARFOCUS_TESTS_CONFORMANCE_CONFORMANCE_H_
