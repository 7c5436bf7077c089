// SPDX-License-Identifier: Apache-2.0
#include "lib/optics/view_weights.h"

#include <initializer_list>

#include "lib/base/fixed.h"

namespace starfocus {
namespace {

// Returns the value of (3) relative to its value at the centre, (c / (rho^2 + c))^2 with rho^2 =
// square / n^2, with 20 fractional bits. The computation uses only integers, so every machine gets
// the same weights.
uint64_t Relative(uint64_t square, uint64_t n_square, uint64_t fall_off) {
  const uint64_t denominator = (square << 16) + fall_off * n_square;   // Less than 2^40.
  const uint64_t ratio = ((fall_off * n_square) << 24) / denominator;  // Equals 2^24 at the centre.
  return (ratio * ratio) >> 28;
}

// Returns the index of the weight of view (i, j).
size_t IndexOf(const ViewWeights& aperture, int32_t i, int32_t j) {
  const int32_t n = aperture.n;
  return static_cast<size_t>(aperture.full ? (i + n) * (2 * n + 1) + j + n : i * (i + 1) / 2 + j);
}

// Calls visit(i, j, views) for each stored weight of a view (i, j) with i^2 + j^2 <= most and |i|,
// |j| <= last. `views` is the number of views that share the weight.
template <class Visit>
void ForEachWeight(const ViewWeights& aperture, bool by_size, const Visit& visit) {
  const int32_t last = aperture.last, most = aperture.most;
  if (!aperture.full) {
    ForEachOfOctant(last, by_size, [&](int32_t i, int32_t j) {
      if (i * i + j * j <= most) visit(i, j, PointsOfOctant(i, j));
    });
    return;
  }
  for (int32_t i = -last; i <= last; ++i) {
    for (int32_t j = -last; j <= last; ++j) {
      if (i * i + j * j <= most) visit(i, j, 1);
    }
  }
}

void Clear(const ViewWeights& aperture, uint16_t* weights) {
  const size_t size = aperture.full ? FullApertureSize(aperture.n) : ViewWeightsSize(aperture.n);
  for (size_t index = 0; index < size; ++index) weights[index] = 0;
}

// Computes weights that are proportional to light(i, j), which returns a fixed-point number of 20
// bits. Weights outside the disc must be 0 on entry. `light` may read the old contents of
// `weights`.
template <class Light>
void Weigh(bool by_size, const Light& light, uint16_t* weights, ViewWeights* aperture) {
  aperture->weights = weights;
  uint64_t total = 0, largest = 0;
  aperture->views = 0;
  ForEachWeight(*aperture, by_size, [&](int32_t i, int32_t j, int32_t views) {
    const uint64_t one = light(i, j);
    total += static_cast<uint64_t>(views) * one;
    largest = one > largest ? one : largest;
    aperture->views += views;
  });
  // The weights sum to the largest power of two for which the largest weight fits 15 bits, with a
  // margin for the rounding of the other weights.
  int bits = aperture->most_bits;
  while (bits > 1 && (largest << bits) / total > static_cast<uint64_t>(kMaxWeight - 8)) --bits;
  aperture->sum_bits = bits;
  // Symmetric views share a weight. The weight of each group of symmetric views also corrects the
  // rounding errors of all earlier weights. A group of a single view, such as the centre view,
  // leaves no rounding error.
  uint64_t wanted = 0;
  int64_t given = 0;
  ForEachWeight(*aperture, by_size, [&](int32_t i, int32_t j, int32_t views) {
    wanted += static_cast<uint64_t>(views) * light(i, j);
    const auto target = static_cast<int64_t>((wanted << bits) / total);  // < 2^63
    const int64_t weight = PortionOfPoints(target - given, views, by_size);
    weights[IndexOf(*aperture, i, j)] = static_cast<uint16_t>(Checked(ranges::kWeight, weight));
    given += weight * views;
  });
  Checked(ranges::kRemainder, given - (int64_t{1} << bits));
}

// Distance between sampling points, and number of sampling points along each side of a subaperture.
constexpr int32_t kStep = 2, kPoints = kSubapertureUnits / kStep;

// Calls visit(x, y) for the sampling points of the subaperture around (i, j), in units of 1 /
// kSubapertureUnits.
template <class Visit>
void ForEachPoint(int32_t i, int32_t j, const Visit& visit) {
  for (int32_t a = 0; a < kPoints; ++a) {
    for (int32_t b = 0; b < kPoints; ++b) {
      visit(int64_t{kSubapertureUnits} * i + kStep * a + 1 - kSubapertureUnits / 2,
            int64_t{kSubapertureUnits} * j + kStep * b + 1 - kSubapertureUnits / 2);
    }
  }
}

// Returns the light, 20 bits, that passes through the subaperture around (i, j): the mean over the
// sampling points. `radius` is the radius of the lens in kSubapertureUnits.
uint64_t LightOfSubaperture(int32_t i, int32_t j, int32_t radius, uint32_t fall_off) {
  const auto lens = static_cast<uint64_t>(radius) * static_cast<uint64_t>(radius);
  int bits = 0;  // number of low bits that are dropped so that Relative does not overflow
  while (lens >> bits >= uint64_t{1} << 18) ++bits;
  uint64_t light = 0;
  ForEachPoint(i, j, [&](int64_t x, int64_t y) {
    const auto square = static_cast<uint64_t>(x * x + y * y);
    if (square <= lens) light += Relative(square >> bits, lens >> bits, fall_off);
  });
  return light / (kPoints * kPoints);
}

// Returns the number of sampling points in the subaperture that an evenly bright opening lets
// through.
uint32_t OpenPoints(int32_t i, int32_t j, int32_t radius, const ApertureShape& opening) {
  uint32_t open = 0;
  ForEachPoint(i, j,
               [&](int64_t x, int64_t y) { open += LetsThrough(opening, x, y, radius) ? 1 : 0; });
  return open;
}

// Faster version of OpenPoints for polygons. A polygon is convex: if all corners of a subaperture
// lie inside the polygon, the whole subaperture lies inside.
uint32_t OpenPointsOfPolygon(int32_t i, int32_t j, int32_t radius, const ApertureShape& opening) {
  constexpr int32_t kHalf = kSubapertureUnits / 2;
  const int64_t x = kSubapertureUnits * (i < 0 ? -i : i) + kHalf;
  const int64_t y = kSubapertureUnits * (j < 0 ? -j : j) + kHalf;
  const int64_t inscribed = int64_t{opening.inscribed} * radius;
  if ((x * x + y * y) * kOpeningOne * kOpeningOne <= inscribed * inscribed) {
    return kPoints * kPoints;
  }
  const int32_t middle_x = kSubapertureUnits * i, middle_y = kSubapertureUnits * j;
  if (IsDark(opening, middle_x, middle_y, kHalf, radius)) return 0;
  for (const int32_t column : {middle_x - kHalf, middle_x + kHalf}) {
    for (const int32_t row : {middle_y - kHalf, middle_y + kHalf}) {
      if (!LetsThrough(opening, column, row, radius)) return OpenPoints(i, j, radius, opening);
    }
  }
  return kPoints * kPoints;
}

void WeighSubapertures(const ApertureShape& opening, uint16_t* weights, ViewWeights* aperture) {
  Clear(*aperture, weights);
  const int32_t radius = aperture->radius;
  if (opening.shape == STARFOCUS_SHAPE_FALL_OFF) {
    const auto light = [&](int32_t i, int32_t j) {
      return LightOfSubaperture(i, j, radius, opening.fall_off);
    };
    return Weigh(false, light, weights, aperture);
  }
  ForEachWeight(*aperture, false, [&](int32_t i, int32_t j, int32_t) {
    const uint32_t open = opening.shape == STARFOCUS_SHAPE_POLYGON
                              ? OpenPointsOfPolygon(i, j, radius, opening)
                              : OpenPoints(i, j, radius, opening);
    weights[IndexOf(*aperture, i, j)] = static_cast<uint16_t>(open);
  });
  Weigh(
      opening.IsRing(),
      [&](int32_t i, int32_t j) -> uint64_t { return weights[IndexOf(*aperture, i, j)]; }, weights,
      aperture);
}

// Upper bound of the distance of sampling points from the middle of a subaperture: half the
// diagonal of the subaperture.
constexpr int64_t kNear = 23;
static_assert(2 * kNear * kNear >= kSubapertureUnits * kSubapertureUnits / 2, "half a diagonal");

// Returns the fraction of the light through the subaperture around (i, j) that passes the rim
// behind the opening, times kPoints^2.
uint32_t PassingPoints(int32_t i, int32_t j, int32_t lens, const ApertureShape& opening,
                       const RimShift& shift) {
  constexpr uint32_t kAll = kPoints * kPoints;
  const int64_t radius = lens, outer = radius + kNear + 2, inner = radius - kNear - 2;
  const int64_t x = int64_t{kSubapertureUnits} * i, y = int64_t{kSubapertureUnits} * j;
  const int64_t dx = x - shift.x * radius / kOpeningOne, dy = y - shift.y * radius / kOpeningOne;
  const int64_t square = dx * dx + dy * dy;
  if (square > outer * outer) return 0;
  if (inner > 0 && square < inner * inner) return kAll;
  // In openings without inner edges, light passes through every point of the disc.
  const bool plain =
      opening.shape == STARFOCUS_SHAPE_FALL_OFF || opening.shape == STARFOCUS_SHAPE_DISC;
  const bool all = plain && inner > 0 && x * x + y * y < inner * inner;
  uint32_t inside = 0, both = 0;
  ForEachPoint(i, j, [&](int64_t a, int64_t b) {
    const uint32_t open = all || LetsThrough(opening, a, b, radius) ? 1 : 0;
    inside += open;
    both += PassesRim(shift, a, b, radius) ? open : 0;
  });
  return inside == 0 ? 0 : kAll * both / inside;
}

}  // namespace

ViewWeights MakeViewWeights(int32_t n, const ApertureShape& opening, uint16_t* weights) {
  ViewWeights aperture;
  aperture.n = aperture.last = n;
  aperture.most = n * n;
  aperture.radius = kSubapertureUnits * n;
  aperture.full = !opening.IsSymmetric();
  if (n > 0 && opening.shape != STARFOCUS_SHAPE_FALL_OFF) {
    WeighSubapertures(opening, weights, &aperture);
    return aperture;
  }
  Clear(aperture, weights);
  const uint64_t n_square = static_cast<uint64_t>(n) * static_cast<uint64_t>(n);
  const auto light = [&](int32_t i, int32_t j) {
    if (n == 0) return uint64_t{1} << 20;  // all light comes from the centre view
    return Relative(static_cast<uint64_t>(i * i + j * j), n_square, opening.fall_off);
  };
  Weigh(false, light, weights, &aperture);
  return aperture;
}

ViewWeights MakeSubapertures(int32_t n, const ApertureShape& opening, uint16_t* weights) {
  if (n == 0) return MakeViewWeights(n, opening, weights);
  ViewWeights aperture;
  aperture.n = n;
  aperture.last = LastSubaperture(n);
  aperture.most = MostOfSubapertures(n);
  aperture.most_bits = kMaxWeightBits;
  aperture.extent = SubapertureExtent(n);
  aperture.radius = LensInSubapertures(n);
  aperture.full = !opening.IsSymmetric();
  WeighSubapertures(opening, weights, &aperture);
  return aperture;
}

ViewWeights MakeCatsEye(const ViewWeights& whole, const ApertureShape& opening,
                        const RimShift& shift, uint16_t* weights) {
  ViewWeights aperture = whole;
  aperture.full = true;
  Clear(aperture, weights);
  ForEachWeight(aperture, false, [&](int32_t i, int32_t j, int32_t) {
    weights[IndexOf(aperture, i, j)] = static_cast<uint16_t>(
        2 * whole.Weight(i, j) * PassingPoints(i, j, whole.radius, opening, shift) /
        (kPoints * kPoints));
  });
  Weigh(
      false, [&](int32_t i, int32_t j) { return weights[IndexOf(aperture, i, j)]; }, weights,
      &aperture);
  return aperture;
}

}  // namespace starfocus
