// SPDX-License-Identifier: Apache-2.0
// The opening that a thin lens's rays pass, in double precision and by nothing of the engine's.
#ifndef STARFOCUS_EXAMPLES_SCENE_OPENING_H_
#define STARFOCUS_EXAMPLES_SCENE_OPENING_H_

#include <vector>

#include "starfocus/starfocus.h"

namespace starfocus {

class SceneOpening {
 public:
  // The opening of a valid lens.
  explicit SceneOpening(const starfocus_lens& lens);

  // cot^2(theta) of the density (3), or 0: as bright everywhere.
  double fall_off() const { return fall_off_; }

  // The part of the disc that lets light through to a corner of the picture, roughly.
  double LeastShare() const;

  // Whether the ray through (u, v) of the unit disc passes, for a pixel at (x, y) in half diagonals
  // of the picture from its middle.
  bool Passes(double u, double v, double x, double y) const;

 private:
  struct Edge {
    double x, y;  // its normal
  };

  starfocus_shape shape_;
  double fall_off_ = 0, inner_, cats_eye_;
  double curvature_, half_;  // of a polygon: half of the angle between two corners
  std::vector<Edge> edges_;
};

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_SCENE_OPENING_H_
