// SPDX-License-Identifier: Apache-2.0
#include "lib/optics/opening.h"

#include <cmath>
#include <cstring>

namespace starfocus {
namespace {

constexpr double kPi = 3.14159265358979323846;

// The last digit of a tangent may differ between machines, here and in ApertureFallOff. The rounded
// result differs only if the exact value is almost halfway between two integers.
int32_t Round(double value) { return static_cast<int32_t>(std::floor(value * kOpeningOne + 0.5)); }

// Computes the sine and cosine of an angle from the tangent of half the angle.
void FindDirection(double angle, double* sine, double* cosine) {
  const double tangent = std::tan(angle / 2), square = tangent * tangent;
  *sine = 2 * tangent / (1 + square);
  *cosine = (1 - square) / (1 + square);
}

// Each edge is an arc of radius 1 / `curvature` through two corners on the unit circle. `half` is
// half the angle between the two corners. The centre of the arc lies on the edge's normal, at
// cos(half) - sqrt(1 / curvature^2 - sin(half)^2). The product of the centre's position and the
// curvature remains finite as the curvature approaches 0 (straight edges).
void SetPolygon(const starfocus_params& lens, ApertureShape* opening) {
  opening->blades = lens.blades;
  const double half = kPi / lens.blades;
  double sine = 0, cosine = 0;
  FindDirection(half, &sine, &cosine);
  const double curvature = lens.curvature, turn = lens.rotation * (kPi / 180);
  const double root = std::sqrt(1 - curvature * curvature * sine * sine);
  opening->bulge = Round(curvature);
  opening->slope = Round(2 * (root - curvature * cosine));
  opening->limit = Round(2 * cosine * root - curvature * (cosine * cosine - sine * sine));
  for (int32_t edge = 0; edge < lens.blades; ++edge) {
    FindDirection(turn + (2 * edge + 1) * half, &sine, &cosine);
    opening->normals[edge][0] = Round(sine);
    opening->normals[edge][1] = Round(-cosine);
  }
  // Returns true if points at distance `radius` along a normal are inside the polygon. Rounding may
  // make a normal longer than 1 by one unit.
  const auto is_inside = [&](int64_t radius) {
    return opening->bulge * radius * radius + opening->slope * radius * (kOpeningOne + 1) <=
           int64_t{opening->limit} * kOpeningOne * kOpeningOne;
  };
  for (int32_t bit = kOpeningOne / 2; bit > 0; bit /= 2) {
    if (is_inside(opening->inscribed + bit)) opening->inscribed += bit;
  }
}

}  // namespace

uint32_t ApertureFallOff(double theta) {
  const double tangent = std::tan(theta);
  return static_cast<uint32_t>(65536.0 / (tangent * tangent) + 0.5);
}

ApertureShape ShapeOf(const starfocus_params& lens) {
  ApertureShape opening;
  opening.shape = static_cast<starfocus_shape>(lens.shape);
  if (opening.shape == STARFOCUS_SHAPE_FALL_OFF) opening.fall_off = ApertureFallOff(lens.theta);
  if (opening.shape == STARFOCUS_SHAPE_POLYGON) SetPolygon(lens, &opening);
  if (opening.shape == STARFOCUS_SHAPE_RING) opening.inner = Round(lens.ring_inner);
  opening.cats_eye = Round(lens.cats_eye);
  return opening;
}

bool AreAlike(ApertureShape a, const ApertureShape& b) {
  static_assert(std::has_unique_object_representations_v<ApertureShape>, "compared as bytes");
  a.cats_eye = b.cats_eye;
  return std::memcmp(&a, &b, sizeof a) == 0;
}

int32_t MeanSquare(const ApertureShape& opening) {
  if (opening.shape == STARFOCUS_SHAPE_POLYGON) {
    // The mean square of a regular polygon is equal along all axes.
    constexpr int64_t kHalf = 128;
    int64_t points = 0, sum = 0;
    for (int64_t y = 1 - kHalf; y < kHalf; ++y) {
      for (int64_t x = 1 - kHalf; x < kHalf; ++x) {
        if (!LetsThrough(opening, x, y, kHalf)) continue;
        ++points;
        sum += x * x + y * y;
      }
    }
    return Round(static_cast<double>(sum) / static_cast<double>(2 * kHalf * kHalf * points));
  }
  if (opening.shape != STARFOCUS_SHAPE_FALL_OFF) {
    const double inner = static_cast<double>(opening.inner) / kOpeningOne;
    return Round((1 + inner * inner) / 4);
  }
  // Divides the disc into rings of equal area and evaluates the light of each ring at its middle.
  // The mean square of one coordinate is half the mean square distance.
  constexpr int kRings = 256;
  const double fall_off = opening.fall_off / 65536.0;
  double light = 0, sum = 0;
  for (int ring = 0; ring < kRings; ++ring) {
    const double square = (ring + 0.5) / kRings, ratio = fall_off / (square + fall_off);
    light += ratio * ratio;
    sum += ratio * ratio * square;
  }
  return Round(sum / light / 2);
}

bool LetsThrough(const ApertureShape& opening, int64_t x, int64_t y, int64_t radius) {
  const int64_t square = x * x + y * y;
  if (square > radius * radius) return false;
  if (opening.shape == STARFOCUS_SHAPE_RING) {
    const int64_t inner = opening.inner * radius;
    return square * kOpeningOne * kOpeningOne >= inner * inner;
  }
  if (opening.shape != STARFOCUS_SHAPE_POLYGON) return true;
  const int64_t limit = (opening.limit * radius * radius - opening.bulge * square) * kOpeningOne;
  for (int32_t edge = 0; edge < opening.blades; ++edge) {
    const int64_t along = x * opening.normals[edge][0] + y * opening.normals[edge][1];
    if (opening.slope * radius * along > limit) return false;
  }
  return true;
}

bool IsDark(const ApertureShape& opening, int64_t x, int64_t y, int64_t half, int64_t radius) {
  const auto nearest = [&](int64_t at) {
    const int64_t distance = (at < 0 ? -at : at) - half;
    return distance > 0 ? distance : 0;
  };
  const int64_t square = nearest(x) * nearest(x) + nearest(y) * nearest(y);
  if (square > radius * radius) return true;
  const int64_t limit = (opening.limit * radius * radius - opening.bulge * square) * kOpeningOne;
  for (int32_t edge = 0; edge < opening.blades; ++edge) {
    const int64_t across = opening.normals[edge][0], down = opening.normals[edge][1];
    const int64_t less = half * ((across < 0 ? -across : across) + (down < 0 ? -down : down));
    if (opening.slope * radius * (x * across + y * down - less) > limit) return true;
  }
  return false;
}

RimShift ShiftOfRim(const ApertureShape& opening, const Rect& rect, int32_t width, int32_t height) {
  const double diagonal =
      std::sqrt(static_cast<double>(width) * width + static_cast<double>(height) * height);
  // The shift is an odd function of the distance from the picture's middle, so mirrored rectangles
  // get mirrored rims.
  const auto shift = [&](int32_t doubled) {
    return static_cast<int32_t>(-opening.cats_eye * (doubled / diagonal));
  };
  return {shift(2 * rect.x + rect.width - width), shift(2 * rect.y + rect.height - height)};
}

}  // namespace starfocus
