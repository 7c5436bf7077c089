// SPDX-License-Identifier: Apache-2.0
// A random refocusing: what the stress families are made of.
#ifndef STARFOCUS_TESTS_STRESS_SETUP_H_
#define STARFOCUS_TESTS_STRESS_SETUP_H_

#include <cstdint>
#include <string>
#include <vector>

#include "starfocus/starfocus.h"
#include "tests/support/test_scene.h"

namespace starfocus::stress {

enum class Depth { kFlat, kSlanted, kPiecewise, kNoisy, kAlternating, kSparse, kFramed };
enum class Colours { kNoise, kExtreme, kSmooth, kPlainCentre };

struct Setup {
  test::Scene scene;
  starfocus_config config;
  starfocus_params params;
  bool strands = false;  // SetStrands made it

  double Radius() const;     // largest blur radius of the configured disparities
  std::string Text() const;  // one line for a person
};

// The bounds of a random setup.
struct Bounds {
  int size = 40;        // width and height in [1, size]
  double radius = 6;    // of the blur, mostly much less
  int modes = 4;        // starfocus_mode below this
  float disparity = 8;  // |d|
};

// Radii below, at and above the thresholds of the rules, and at random.
double RandomRadius(double largest, test::Random* random);

void SetDepth(Depth depth, test::Scene* scene, test::Random* random);
// Strands before a farther surface, as each view sees them, with coverage now and then.
void SetStrands(test::Scene* scene, test::Random* random);
void SetColours(Colours colours, test::Scene* scene, test::Random* random);

// A scene of flat disparity 0 seen with blur radius `radius` exactly, in any mode; colours are left
// to the caller.
Setup FlatSetup(int width, int height, double radius, test::Random* random);

// Anything within bounds.
Setup RandomSetup(const Bounds& bounds, test::Random* random);

// Random configuration for setup->scene and a lens whose largest blur radius is about `radius`.
void RandomLens(double radius, int modes, Setup* setup, test::Random* random);
void RandomMode(int modes, Setup* setup, test::Random* random);

// Configures the smallest max_blur that the lens fits.
void FitBlur(Setup* setup);

}  // namespace starfocus::stress

#endif  // STARFOCUS_TESTS_STRESS_SETUP_H_
