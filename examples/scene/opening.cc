// SPDX-License-Identifier: Apache-2.0
#include "examples/scene/opening.h"

#include <cmath>

namespace starfocus {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kTheta = 0.26 * kPi;
constexpr double kCotSquared = 0.8818383898322281;  // of it, the same on every machine

double Square(double x) { return x * x; }

}  // namespace

SceneOpening::SceneOpening(const sf_config& config)
    : shape_(static_cast<sf_shape>(config.aperture_shape)),
      inner_(config.ring_inner),
      cats_eye_(config.cats_eye),
      curvature_(config.curvature),
      half_(kPi / config.blades) {
  if (shape_ == SF_SHAPE_FALL_OFF) {
    fall_off_ = config.theta == kTheta ? kCotSquared : 1 / Square(std::tan(config.theta));
  }
  for (int k = 0; k < config.blades; ++k) {
    const double angle = config.rotation * kPi / 180 + (2 * k + 1) * half_;
    edges_.push_back({std::sin(angle), -std::cos(angle)});
  }
}

double SceneOpening::LeastShare() const {
  // Two discs that lie s apart have 1 - 2 s / pi of each in common, or more.
  const double both = 1 - 2 / kPi * cats_eye_;
  if (shape_ == SF_SHAPE_RING) return both * (1 - inner_ * inner_);
  return shape_ == SF_SHAPE_POLYGON ? both * std::sin(2 * half_) / (2 * half_) : both;
}

bool SceneOpening::Passes(double u, double v, double x, double y) const {
  if (cats_eye_ > 0 && Square(u + cats_eye_ * x) + Square(v + cats_eye_ * y) > 1) return false;
  if (shape_ == SF_SHAPE_RING) return u * u + v * v >= inner_ * inner_;
  if (shape_ != SF_SHAPE_POLYGON) return true;
  for (const Edge& edge : edges_) {
    if (curvature_ == 0) {
      if (u * edge.x + v * edge.y > std::cos(half_)) return false;
      continue;
    }
    // A circle through both corners.
    const double radius = 1 / curvature_;
    const double centre = std::cos(half_) - std::sqrt(radius * radius - Square(std::sin(half_)));
    if (Square(u - centre * edge.x) + Square(v - centre * edge.y) > radius * radius) return false;
  }
  return true;
}

}  // namespace starfocus
