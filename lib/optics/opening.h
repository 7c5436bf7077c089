// SPDX-License-Identifier: Apache-2.0
// Opening of a lens: the part of the lens disc that lets light through. The lens setup derives the
// opening from a starfocus_params, and lib/optics/view_weights.h derives the weights of the views
// from the opening. The parameters are rounded once; the weights are then computed in integers, so
// that every machine gets the same weights.
#ifndef STARFOCUS_LIB_OPTICS_OPENING_H_
#define STARFOCUS_LIB_OPTICS_OPENING_H_

#include <cstdint>

#include "lib/base/geometry.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Number of fractional bits of the coordinates that describe an opening. The unit of these
// coordinates is the radius of the lens.
inline constexpr int kOpeningBits = 14;
inline constexpr int32_t kOpeningOne = 1 << kOpeningBits;

// Returns cot^2(theta) with 16 fractional bits. The result is in [0.025, 40] for theta in [0.05 pi,
// 0.45 pi].
uint32_t ApertureFallOff(double theta);

struct ApertureShape {
  // The opening (3) of the paper. `cot_square` is a result of ApertureFallOff.
  ApertureShape(uint32_t cot_square = 1 << 16) : fall_off(cot_square) {}  // NOLINT: converts

  starfocus_shape shape = STARFOCUS_SHAPE_FALL_OFF;
  uint32_t fall_off;  // STARFOCUS_SHAPE_FALL_OFF: cot^2(theta), 16 fractional bits.
  int32_t inner = 0;  // STARFOCUS_SHAPE_RING: radius of the hole.
  // Displacement of the rim behind the lens as seen from a corner of the picture.
  int32_t cats_eye = 0;
  // A polygon consists of the points p with `bulge` |p|^2 + `slope` p * normal <= `limit` for the
  // normal of each edge. The edges are arcs through the corners.
  int32_t blades = 0;
  int32_t normals[STARFOCUS_MAX_BLADES][2] = {};
  int32_t bulge = 0, slope = 0, limit = 0;
  int32_t inscribed = 0;  // radius of an inscribed disc of the polygon: kOpeningBits, rounded down

  // True if the opening is symmetric about both axes and both diagonals, so that one octant
  // describes the opening. The result ignores cat's eyes, which are not symmetric.
  bool IsSymmetric() const { return shape != STARFOCUS_SHAPE_POLYGON; }
  // True if the centre of the lens may be dark.
  bool IsRing() const { return shape == STARFOCUS_SHAPE_RING; }
};

// Returns the opening of a valid lens.
ApertureShape ShapeOf(const starfocus_params& lens);

// Returns true if two results of ShapeOf differ at most in their cat's eyes.
bool AreAlike(ApertureShape a, const ApertureShape& b);

// Returns the mean square of one coordinate of the transmitted light, in radii of the lens
// (kOpeningBits).
int32_t MeanSquare(const ApertureShape& opening);

// Returns true if light passes at (x, y) through a lens of the given radius. All arguments are at
// most 2^14.
bool LetsThrough(const ApertureShape& opening, int64_t x, int64_t y, int64_t radius);

// Returns true only if a polygon lets no light through the square with centre (x, y) and side 2 *
// half. The test is conservative: a dark square may also give false.
bool IsDark(const ApertureShape& opening, int64_t x, int64_t y, int64_t half, int64_t radius);

// Centre of the rim behind the lens as seen from a part of the picture, in radii of the lens
// (kOpeningBits).
struct RimShift {
  int32_t x = 0, y = 0;
};

// Returns the shift of the rim for the pixels of `rect`, computed at the middle of `rect`.
RimShift ShiftOfRim(const ApertureShape& opening, const Rect& rect, int32_t width, int32_t height);

// Returns true if the point (x, y) of a lens of the given radius lies inside the rim behind the
// lens.
constexpr bool PassesRim(const RimShift& shift, int64_t x, int64_t y, int64_t radius) {
  const int64_t dx = x * kOpeningOne - shift.x * radius;
  const int64_t dy = y * kOpeningOne - shift.y * radius;
  const int64_t whole = radius * kOpeningOne;
  return dx * dx + dy * dy <= whole * whole;
}

// Calls visit(i, j) for 0 <= j <= i <= last, with the centre last. With `by_size`, points that
// represent eight points of the plane come before points that represent four.
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

// Returns the number of distinct points among (+-i, +-j) and (+-j, +-i).
constexpr int32_t PointsOfOctant(int32_t i, int32_t j) {
  if (i == 0) return 1;
  return j == 0 || i == j ? 4 : 8;
}

// Returns the portion of one point, if a point of the octant represents `points` points of the
// plane. `left` is the total portion of the represented points, plus the rounding error of earlier
// points. With `by_size` the portion is rounded down: a dark centre cannot compensate for earlier
// portions that were too large.
constexpr int64_t PortionOfPoints(int64_t left, int64_t points, bool by_size) {
  const int64_t portion = (left + (by_size ? 0 : points / 2)) / points;
  return portion < 0 ? 0 : portion;
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_OPTICS_OPENING_H_
