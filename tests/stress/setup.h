// A random refocusing and the ways of running it: what the stress families are made of.
#ifndef STARFOCUS_TESTS_STRESS_SETUP_H_
#define STARFOCUS_TESTS_STRESS_SETUP_H_

#include <cstdint>
#include <string>
#include <vector>

#include "simd/kernels.h"
#include "starfocus/starfocus.h"
#include "tests/support/test_scene.h"

namespace starfocus::stress {

enum class Depth { kFlat, kSlanted, kPiecewise, kNoisy, kAlternating };
enum class Colours { kNoise, kExtreme, kSmooth };

struct Setup {
  test::Scene scene;
  sf_config config;
  sf_params params;

  double Radius() const;     // largest blur radius of the configured disparities
  std::string Text() const;  // one line for a person
};

// The bounds of a random setup.
struct Bounds {
  int size = 40;        // width and height in [1, size]
  double radius = 6;    // of the blur, mostly much less
  int modes = 4;        // sf_mode below this
  float disparity = 8;  // |d|
};

// How the engine is run; the bytes must not depend on it.
struct Variant {
  const simd::Kernels* kernels = nullptr;  // null: the best of this machine
  int workers = 1;
  bool stream = false;
  int push_rows = 1, pull_rows = 1;
  uint64_t order = 0;  // of the jobs; 0: no runner
  int skips = 1;       // sf_config.skips
  int poison = -1;     // byte that fills the workspace before; -1: as the heap gave it

  std::string Text() const;
};

// Tables of kernels of every SIMD target of this machine, and the plain reference.
const std::vector<const simd::Kernels*>& AllKernels();

Variant RandomVariant(test::Random* random);

// Radii below, at and above the thresholds of the rules, and at random.
double RandomRadius(double largest, test::Random* random);

void SetDepth(Depth depth, test::Scene* scene, test::Random* random);
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

// Bytes of the picture without row padding; empty, with a line in *failure, when the engine failed
// or wrote where it must not.
std::vector<uint8_t> Refocused(const Setup& setup, const Variant& variant, std::string* failure,
                               sf_report* report = nullptr);

}  // namespace starfocus::stress

#endif  // STARFOCUS_TESTS_STRESS_SETUP_H_
