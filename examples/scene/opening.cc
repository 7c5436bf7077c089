// SPDX-License-Identifier: Apache-2.0
#include "examples/scene/opening.h"

#include <cmath>

#include "starfocus/starfocus.hpp"

namespace starfocus {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kTheta = 0.26 * kPi;
constexpr double kCotSquared = 0.8818383898322281;  // cot^2 of kTheta, equal on all machines

double Square(double x) { return x * x; }

}  // namespace

SceneOpening::SceneOpening(const starfocus::Params& lens)
    : shape_(static_cast<starfocus_shape>(lens.shape)),
      inner_(lens.ring_inner),
      cats_eye_(lens.cats_eye),
      curvature_(lens.curvature),
      half_(kPi / lens.blades) {
  if (shape_ == STARFOCUS_SHAPE_FALL_OFF) {
    fall_off_ = lens.theta == kTheta ? kCotSquared : 1 / Square(std::tan(lens.theta));
  }
  for (int k = 0; k < lens.blades; ++k) {
    const double angle = lens.rotation * kPi / 180 + (2 * k + 1) * half_;
    edges_.push_back({std::sin(angle), -std::cos(angle)});
  }
}

double SceneOpening::LeastShare() const {
  // Two unit discs at distance s overlap in at least 1 - 2 s / pi of their area.
  const double both = 1 - 2 / kPi * cats_eye_;
  if (shape_ == STARFOCUS_SHAPE_RING) return both * (1 - inner_ * inner_);
  return shape_ == STARFOCUS_SHAPE_POLYGON ? both * std::sin(2 * half_) / (2 * half_) : both;
}

bool SceneOpening::Passes(double u, double v, double x, double y) const {
  if (cats_eye_ > 0 && Square(u + cats_eye_ * x) + Square(v + cats_eye_ * y) > 1) return false;
  if (shape_ == STARFOCUS_SHAPE_RING) return u * u + v * v >= inner_ * inner_;
  if (shape_ != STARFOCUS_SHAPE_POLYGON) return true;
  for (const Edge& edge : edges_) {
    if (curvature_ == 0) {
      if (u * edge.x + v * edge.y > std::cos(half_)) return false;
      continue;
    }
    // The edge is an arc of the circle with radius 1 / `curvature_` through the two corners of the
    // edge.
    const double radius = 1 / curvature_;
    const double centre = std::cos(half_) - std::sqrt(radius * radius - Square(std::sin(half_)));
    if (Square(u - centre * edge.x) + Square(v - centre * edge.y) > radius * radius) return false;
  }
  return true;
}

}  // namespace starfocus
