// SPDX-License-Identifier: Apache-2.0
// Opening of the lens in the reference: (3), and the shapes of starfocus::Params, in double
// precision.
#ifndef STARFOCUS_TESTS_CONFORMANCE_REFERENCE_OPENING_H_
#define STARFOCUS_TESTS_CONFORMANCE_REFERENCE_OPENING_H_

#include <array>
#include <cmath>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"

namespace reference {

// Returns the aperture density of equation (3) without its constant factor. `cot2` is the squared
// cotangent of theta.
inline double ApertureDensity(double u, double v, double cot2) {
  const double denominator = u * u + v * v + cot2;
  return cot2 * cot2 / (denominator * denominator);
}

struct ApertureShape {
  double theta;
  int shape = STARFOCUS_SHAPE_FALL_OFF;
  int blades = 0;
  double rotation = 0, curvature = 0, inner = 0, cats_eye = 0;
  double rim_x = 0, rim_y = 0;  // position of the rim behind the lens, seen from a block

  // Edge of a polygon: the direction (x, y) of its normal, and the centre of the edge's arc as a
  // distance along the normal.
  struct Edge {
    double x, y, centre;
  };
  std::array<Edge, STARFOCUS_MAX_BLADES> edges = {};
  double cot2;  // squared cotangent of theta

  ApertureShape(double angle)  // NOLINT: theta alone defines a fall-off
      : theta(angle), cot2(1 / (std::tan(theta) * std::tan(theta))) {}
  ApertureShape(const starfocus::Params& lens)  // NOLINT: converts
      : theta(lens.theta),
        shape(lens.shape),
        blades(lens.blades),
        rotation(lens.rotation),
        curvature(lens.curvature),
        inner(lens.ring_inner),
        cats_eye(lens.cats_eye),
        cot2(1 / (std::tan(theta) * std::tan(theta))) {
    const double half = Half(), r = 1 / curvature, sine = std::sin(half);
    for (int k = 0; k < blades; ++k) {
      const double angle = rotation * kPi / 180 + (2 * k + 1) * half;
      edges[size_t(k)] = {std::sin(angle), -std::cos(angle),
                          std::cos(half) - std::sqrt(r * r - sine * sine)};
    }
  }

  static constexpr double kPi = 3.14159265358979323846;
  // Returns half of the angle between two adjacent corners of the polygon, in radians.
  double Half() const { return kPi / blades; }

  // Returns the opening as seen from the middle of a block, which determines the position of the
  // rim behind the lens.
  ApertureShape At(double x, double y, double block_width, double block_height, double width,
                   double height) const {
    ApertureShape here = *this;
    const double diagonal = std::hypot(width, height);
    here.rim_x = -cats_eye * (2 * x + block_width - width) / diagonal;
    here.rim_y = -cats_eye * (2 * y + block_height - height) / diagonal;
    return here;
  }

  // Returns true if (u, v) is inside all edges of the polygon; edges are straight or arcs of
  // circles.
  bool InPolygon(double u, double v) const {
    const double straight = curvature == 0 ? std::cos(Half()) : 0;
    for (int k = 0; k < blades; ++k) {
      const Edge& edge = edges[size_t(k)];
      if (curvature == 0) {
        if (u * edge.x + v * edge.y > straight) return false;
        continue;
      }
      const double across = u - edge.centre * edge.x, down = v - edge.centre * edge.y;
      if (across * across + down * down > 1 / (curvature * curvature)) return false;
    }
    return true;
  }

  double Density(double u, double v) const {
    const double square = u * u + v * v;
    if (square > 1) return 0;
    if (shape == STARFOCUS_SHAPE_FALL_OFF) return ApertureDensity(u, v, cot2);
    if (shape == STARFOCUS_SHAPE_RING) return square >= inner * inner;
    return shape == STARFOCUS_SHAPE_DISC || InPolygon(u, v) ? 1 : 0;
  }

  // Returns the mean density of the subaperture around (i, j), sampled at `points` x `points`
  // points. The radius of the lens is `width` subapertures.
  double Mean(int i, int j, double width, int points) const {
    double sum = 0;
    ForEachPoint(i, j, width, points, [&](double u, double v) { sum += Density(u, v); });
    return sum / (points * points);
  }

  // Returns the share of the subaperture's open points that the rim behind the lens lets through.
  double Passing(int i, int j, double width) const {
    int open = 0, both = 0;
    ForEachPoint(i, j, width, 16, [&](double u, double v) {
      if (Density(u, v) == 0) return;
      ++open;
      both += std::hypot(u - rim_x, v - rim_y) <= 1;
    });
    return open == 0 ? 0 : double(both) / open;
  }

 private:
  template <class Visit>
  static void ForEachPoint(int i, int j, double width, int points, const Visit& visit) {
    for (int point = 0; point < points * points; ++point) {
      visit((i + (point % points + 0.5) / points - 0.5) / width,
            (j + (point / points + 0.5) / points - 0.5) / width);
    }
  }
};

}  // namespace reference

#endif  // STARFOCUS_TESTS_CONFORMANCE_REFERENCE_OPENING_H_
