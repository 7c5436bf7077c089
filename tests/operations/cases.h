// SPDX-License-Identifier: Apache-2.0
// Random light fields, configurations and lenses.
#ifndef STARFOCUS_TESTS_OPERATIONS_CASES_H_
#define STARFOCUS_TESTS_OPERATIONS_CASES_H_

#include <string>

#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/test_scene.h"

namespace properties {

enum class Depth {
  kFlat,
  kSlanted,
  kPiecewise,
  kNoisy,
  kAlternating,
  kSparse,
  kFramed,
  kSurfaces,  // a few large rectangles, with areas for every layer
  kLevels     // a few values, chosen for each pixel, that need more slices than the memory holds
};
enum class Colours { kNoise, kExtreme, kSmooth, kPlainCentre };

// A light field and the way to refocus it.
struct Case {
  test::Scene scene;
  test::Config config;
  starfocus::Params params;
  bool strands = false;  // true if SetStrands made the scene

  double Radius() const;     // Returns the largest blur radius of the configured disparities.
  std::string Text() const;  // Returns a readable description of one line.
};

// Bounds of a random case.
struct Bounds {
  int size = 40;        // Width and height are in [least, size].
  double radius = 6;    // Largest blur radius; most radii are much smaller.
  float disparity = 8;  // Largest absolute disparity.
  int least = 1;        // If 1, most sizes are at most 20.
};

// Returns a radius below, at or above a threshold of the rules, or a random radius.
double RandomRadius(double largest, test::Random* random);

void SetDepth(Depth depth, test::Scene* scene, test::Random* random);
// Makes strands in front of a farther surface, in all views. Some scenes include coverage.
void SetStrands(test::Scene* scene, test::Random* random);
void SetColours(Colours colours, test::Scene* scene, test::Random* random);
// Sets every pixel of all views to one colour.
void SetColour(const uint8_t rgb[3], test::Scene* scene);

// Makes a scene of flat disparity 0 in any mode, with a blur radius of exactly `radius`. The caller
// sets the colours.
Case FlatCase(int width, int height, double radius, test::Random* random);

// Makes any case within the bounds.
Case RandomCase(const Bounds& bounds, test::Random* random);

// Makes a case for comparisons of calls: of any size, blur, block size, timing, set of views, or
// with unknown disparities.
Case RandomCase(test::Random* random);

// Sets the focus. Half of the lenses have a range in focus, which extends from `end` to larger
// disparities if `in_front` is true, otherwise to smaller disparities.
void SetFocus(double end, bool in_front, starfocus_params* lens, test::Random* random);

// Sets a random configuration for the scene, and a lens whose largest blur radius is approximately
// `radius`.
void RandomLens(double radius, Case* of, test::Random* random);
void RandomMode(Case* of, test::Random* random);

// Sets max_blur to the smallest value that suits the lens.
void FitBlur(Case* of);

}  // namespace properties

#endif  // STARFOCUS_TESTS_OPERATIONS_CASES_H_
