// SPDX-License-Identifier: Apache-2.0
// The opening of a lens: where in its disc light comes through. Integers but for what is rounded
// once, so that every machine makes the same weights of it.
#ifndef STARFOCUS_LIB_BASE_APERTURE_SHAPE_H_
#define STARFOCUS_LIB_BASE_APERTURE_SHAPE_H_

#include <cstdint>

#include "lib/base/geometry.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Fractional bits of what an opening is described by, in radii of the lens.
inline constexpr int kOpeningBits = 14;
inline constexpr int32_t kOpeningOne = 1 << kOpeningBits;

// cot^2(theta) with 16 fractional bits; theta in [0.05 pi, 0.45 pi] gives [0.025, 40].
uint32_t ApertureFallOff(double theta);

struct ApertureShape {
  // The paper's (3), of what ApertureFallOff gives: an opening that is nothing else.
  ApertureShape(uint32_t cot_square = 1 << 16) : fall_off(cot_square) {}  // NOLINT: converts

  starfocus_shape shape = STARFOCUS_SHAPE_FALL_OFF;
  uint32_t fall_off;     // of STARFOCUS_SHAPE_FALL_OFF: cot^2(theta), 16 bits
  int32_t inner = 0;     // of a ring: the radius of its hole
  int32_t cats_eye = 0;  // how far the rim behind the lens moves up to a corner of the picture
  // A polygon has the points p of `bulge` |p|^2 + `slope` p * normal <= `limit` for the normal of
  // each of its edges, which are arcs through the corners.
  int32_t blades = 0;
  int32_t normals[STARFOCUS_MAX_BLADES][2] = {};
  int32_t bulge = 0, slope = 0, limit = 0;
  int32_t inscribed = 0;  // radius of a disc in it: kOpeningBits, rounded down

  // Whether the opening is its own mirror image about both axes and both diagonals, so that an
  // octant tells all of it. What cat's eyes leave of it isn't.
  bool IsSymmetric() const { return shape != STARFOCUS_SHAPE_POLYGON; }
  // Whether the octant's centre may be dark.
  bool IsRing() const { return shape == STARFOCUS_SHAPE_RING; }
};

// The opening of a valid lens.
ApertureShape ShapeOf(const starfocus_lens& lens);

// Whether two openings of ShapeOf are the same but for their cat's eyes.
bool AreAlike(ApertureShape a, const ApertureShape& b);

// The mean square of a coordinate of the light that an opening other than a polygon lets through,
// of the lens's radius: kOpeningBits.
int32_t MeanSquare(const ApertureShape& opening);

// Whether light comes through at (x, y), of a lens whose radius is `radius`; all at most 2^14.
bool LetsThrough(const ApertureShape& opening, int64_t x, int64_t y, int64_t radius);

// Whether a polygon surely lets no light through the square of points up to `half` beside (x, y)
// and above and below it.
bool IsDark(const ApertureShape& opening, int64_t x, int64_t y, int64_t half, int64_t radius);

// The centre of the rim behind the lens, as it is seen from a part of the picture: kOpeningBits.
struct RimShift {
  int32_t x = 0, y = 0;
};

// That of the pixels of `rect`: of those in its middle.
RimShift ShiftOfRim(const ApertureShape& opening, const Rect& rect, int32_t width, int32_t height);

// Whether a point that the opening lets through passes the rim behind it as well.
constexpr bool PassesRim(const RimShift& shift, int64_t x, int64_t y, int64_t radius) {
  const int64_t dx = x * kOpeningOne - shift.x * radius;
  const int64_t dy = y * kOpeningOne - shift.y * radius;
  const int64_t whole = radius * kOpeningOne;
  return dx * dx + dy * dy <= whole * whole;
}

// Calls visit(i, j) for 0 <= j <= i <= last, the centre last; `by_size`: those that stand for eight
// points of the plane before those that stand for four.
template <class Visit>
void ForEachOfOctant(int32_t last, bool by_size, const Visit& visit) {
  for (int32_t i = by_size ? last : 0; i > 1; --i) {
    for (int32_t j = i - 1; j > 0; --j) visit(i, j);
  }
  for (int32_t i = last; i >= 0; --i) {
    if (by_size) {
      visit(i, i);
      if (i > 0) visit(i, 0);
      continue;
    }
    for (int32_t j = i; j >= 0; --j) visit(i, j);
  }
}

// Returns how many different points (+-i, +-j), (+-j, +-i) are.
constexpr int32_t PointsOfOctant(int32_t i, int32_t j) {
  if (i == 0) return 1;
  return j == 0 || i == j ? 4 : 8;
}

// What is left of a whole for the points of an octant's (i, j), `points` of them, when `left` is
// the share of these and what is owed from those before. An opening whose centre may be dark owes
// only: nothing must be left for the centre to take back.
constexpr int64_t ShareOfPoints(int64_t left, int64_t points, bool by_size) {
  const int64_t share = (left + (by_size ? 0 : points / 2)) / points;
  return share < 0 ? 0 : share;
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_BASE_APERTURE_SHAPE_H_
