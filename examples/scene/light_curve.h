// SPDX-License-Identifier: Apache-2.0
// Converts codes to light and back. The range of codes and light extends far above white, because
// lamps are brighter than white.
#ifndef STARFOCUS_EXAMPLES_SCENE_LIGHT_CURVE_H_
#define STARFOCUS_EXAMPLES_SCENE_LIGHT_CURVE_H_

#include <vector>

#include "examples/scene/scene.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Pictures of a scene are averages of light. Codes up to kMostCode, where 255 is white, are
// converted to light in units of 1/255 of white. The tables use only IEEE 754 arithmetic, so that
// they are equal on all machines.
class LightCurve {
 public:
  explicit LightCurve(starfocus_transfer transfer);

  Color Decode(const Color& codes) const;
  Color Encode(const Color& light) const;

 private:
  // Largest code of the table, and number of table entries per code.
  static constexpr int kMostCode = 2048, kSteps = 4;

  double LightOf(double code) const;
  double CodeOf(double light) const;

  std::vector<double> light_;  // light of every table entry; empty if light equals the code
};

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_SCENE_LIGHT_CURVE_H_
