// SPDX-License-Identifier: Apache-2.0
// The reference's opening of the lens: (3), and the shapes of sf_config, in double precision.
#ifndef STARFOCUS_TESTS_CONFORMANCE_REFERENCE_OPENING_H_
#define STARFOCUS_TESTS_CONFORMANCE_REFERENCE_OPENING_H_

#include <cmath>

#include "starfocus/starfocus.h"

namespace reference {

// (3) without its constant factor.
inline double ApertureDensity(double u, double v, double theta) {
  const double cot2 = 1 / (std::tan(theta) * std::tan(theta));
  const double denominator = u * u + v * v + cot2;
  return cot2 * cot2 / (denominator * denominator);
}

struct Opening {
  double theta;
  int shape = SF_SHAPE_FALL_OFF;
  int blades = 0;
  double rotation = 0, curvature = 0, inner = 0, cats_eye = 0;
  double rim_x = 0, rim_y = 0;  // where the rim behind the lens is seen

  Opening(double angle) : theta(angle) {}  // NOLINT: the plain lens is its theta
  Opening(const sf_config& config)         // NOLINT: a lens is its configuration
      : theta(config.theta),
        shape(config.aperture_shape),
        blades(config.blades),
        rotation(config.rotation),
        curvature(config.curvature),
        inner(config.ring_inner),
        cats_eye(config.cats_eye) {}

  // The same with the rim that the middle of a block sees.
  Opening At(double x, double y, double block_width, double block_height, double width,
             double height) const {
    Opening here = *this;
    const double diagonal = std::hypot(width, height);
    here.rim_x = -cats_eye * (2 * x + block_width - width) / diagonal;
    here.rim_y = -cats_eye * (2 * y + block_height - height) / diagonal;
    return here;
  }

  // Inside of the circles through two corners each, or of the lines.
  bool InPolygon(double u, double v) const {
    const double pi = 3.14159265358979323846, half = pi / blades;
    for (int k = 0; k < blades; ++k) {
      const double angle = rotation * pi / 180 + (2 * k + 1) * half;
      const double x = std::sin(angle), y = -std::cos(angle);
      if (curvature == 0) {
        if (u * x + v * y > std::cos(half)) return false;
        continue;
      }
      const double r = 1 / curvature, sine = std::sin(half);
      const double centre = std::cos(half) - std::sqrt(r * r - sine * sine);
      if (std::hypot(u - centre * x, v - centre * y) > r) return false;
    }
    return true;
  }

  double Density(double u, double v) const {
    const double square = u * u + v * v;
    if (square > 1) return 0;
    if (shape == SF_SHAPE_FALL_OFF) return ApertureDensity(u, v, theta);
    if (shape == SF_SHAPE_RING) return square >= inner * inner;
    return shape == SF_SHAPE_DISC || InPolygon(u, v) ? 1 : 0;
  }

  // The mean density over the cell around (i, j) of a lens that is `cells` of them wide, by
  // `points` squared.
  double Mean(int i, int j, double cells, int points) const {
    double sum = 0;
    ForEachPoint(i, j, cells, points, [&](double u, double v) { sum += Density(u, v); });
    return sum / (points * points);
  }

  // The part of the cell's open points that the rim behind lets through.
  double Passing(int i, int j, double cells) const {
    int open = 0, both = 0;
    ForEachPoint(i, j, cells, 16, [&](double u, double v) {
      if (Density(u, v) == 0) return;
      ++open;
      both += std::hypot(u - rim_x, v - rim_y) <= 1;
    });
    return open == 0 ? 0 : double(both) / open;
  }

 private:
  template <class Visit>
  static void ForEachPoint(int i, int j, double cells, int points, const Visit& visit) {
    for (int point = 0; point < points * points; ++point) {
      visit((i + (point % points + 0.5) / points - 0.5) / cells,
            (j + (point / points + 0.5) / points - 0.5) / cells);
    }
  }
};

}  // namespace reference

#endif  // STARFOCUS_TESTS_CONFORMANCE_REFERENCE_OPENING_H_
