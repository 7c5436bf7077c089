// SPDX-License-Identifier: Apache-2.0
// Random refocusings for the stress families.
#ifndef STARFOCUS_TESTS_OPERATIONS_SETUP_H_
#define STARFOCUS_TESTS_OPERATIONS_SETUP_H_

#include <cstdint>
#include <string>
#include <vector>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/test_scene.h"

namespace starfocus::stress {

enum class Depth { kFlat, kSlanted, kPiecewise, kNoisy, kAlternating, kSparse, kFramed };
enum class Colours { kNoise, kExtreme, kSmooth, kPlainCentre };

struct Setup {
  test::Scene scene;
  test::Config config;
  starfocus::Params params;
  bool strands = false;  // true if SetStrands made the scene

  double Radius() const;     // Returns the largest blur radius of the configured disparities.
  std::string Text() const;  // Returns a readable description of one line.
};

// Bounds of a random setup.
struct Bounds {
  int size = 40;        // Width and height are in [1, size].
  double radius = 6;    // Largest blur radius; most radii are much smaller.
  int modes = 4;        // The mode is in [0, modes - 1].
  float disparity = 8;  // Largest absolute disparity.
};

// Returns a radius below, at or above a threshold of the rules, or a random radius.
double RandomRadius(double largest, test::Random* random);

void SetDepth(Depth depth, test::Scene* scene, test::Random* random);
// Makes strands in front of a farther surface, in all views. Some scenes include coverage.
void SetStrands(test::Scene* scene, test::Random* random);
void SetColours(Colours colours, test::Scene* scene, test::Random* random);

// Makes a scene of flat disparity 0 in any mode, with a blur radius of exactly `radius`. The caller
// sets the colours.
Setup FlatSetup(int width, int height, double radius, test::Random* random);

// Makes any setup within the bounds.
Setup RandomSetup(const Bounds& bounds, test::Random* random);

// Sets the focus. Half of the lenses have a range in focus, which extends from `end` to larger
// disparities if `in_front` is true, otherwise to smaller disparities.
void SetFocus(double end, bool in_front, starfocus_params* lens, test::Random* random);

// Sets a random configuration for setup->scene, and a lens whose largest blur radius is
// approximately `radius`.
void RandomLens(double radius, int modes, Setup* setup, test::Random* random);
void RandomMode(int modes, Setup* setup, test::Random* random);

// Sets max_blur to the smallest value that suits the lens.
void FitBlur(Setup* setup);

}  // namespace starfocus::stress

#endif  // STARFOCUS_TESTS_OPERATIONS_SETUP_H_
