// SPDX-License-Identifier: Apache-2.0
// The opening of a thin lens, in double precision. This class shares no code with the engine.
#ifndef STARFOCUS_EXAMPLES_SCENE_OPENING_H_
#define STARFOCUS_EXAMPLES_SCENE_OPENING_H_

#include <vector>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"

namespace starfocus {

class SceneOpening {
 public:
  // @param lens a valid lens
  explicit SceneOpening(const starfocus::Params& lens);

  // Returns cot^2(theta) of the density (3), or 0 if the opening is equally bright everywhere.
  double fall_off() const { return fall_off_; }

  // Returns approximately the fraction of the disc through which light reaches a corner of the
  // picture.
  double LeastShare() const;

  // Returns true if the ray through point (u, v) of the unit disc passes the opening. (x, y) is the
  // position of the pixel relative to the centre of the picture, in half diagonals.
  bool Passes(double u, double v, double x, double y) const;

 private:
  struct Edge {
    double x, y;  // normal of the edge
  };

  starfocus_shape shape_;
  double fall_off_ = 0, inner_, cats_eye_;
  // Curvature of a polygon's edges, and half the angle between two corners.
  double curvature_, half_;
  std::vector<Edge> edges_;
};

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_SCENE_OPENING_H_
