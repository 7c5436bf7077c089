// SPDX-License-Identifier: Apache-2.0
// Codes and the light that they stand for, far beyond white as lamps are.
#ifndef STARFOCUS_EXAMPLES_SCENE_LIGHT_CURVE_H_
#define STARFOCUS_EXAMPLES_SCENE_LIGHT_CURVE_H_

#include <vector>

#include "examples/scene/scene.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Rays bring light: it is what pictures of a scene average. Codes up to kMostCode, where 255 is
// white, become light of as many units of a 255th of white; tables of IEEE arithmetic alone make it
// the same on every machine.
class LightCurve {
 public:
  explicit LightCurve(starfocus_transfer transfer);

  Color Decode(const Color& codes) const;
  Color Encode(const Color& light) const;

 private:
  static constexpr int kMostCode = 2048, kSteps = 4;  // of a code

  double LightOf(double code) const;
  double CodeOf(double light) const;

  std::vector<double> light_;  // of every step; empty: light is the code
};

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_SCENE_LIGHT_CURVE_H_
