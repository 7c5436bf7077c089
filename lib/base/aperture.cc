// SPDX-License-Identifier: Apache-2.0
#include "lib/base/aperture.h"

#include <cmath>

#include "lib/base/fixed.h"

namespace starfocus {
namespace {

// (3) relative to its centre, (c / (rho^2 + c))^2 with rho^2 = square / n^2, with 20 fractional
// bits. Integers only, so that every machine makes the same weights.
uint64_t Relative(uint64_t square, uint64_t n_square, uint64_t fall_off) {
  const uint64_t denominator = (square << 16) + fall_off * n_square;   // < 2^40
  const uint64_t ratio = ((fall_off * n_square) << 24) / denominator;  // 2^24 at the centre
  return (ratio * ratio) >> 28;
}

constexpr int64_t Max64(int64_t a, int64_t b) { return a > b ? a : b; }

// Returns how many different views (+-i, +-j), (+-j, +-i) are.
uint32_t Orbit(int32_t i, int32_t j) {
  if (i == 0) return 1;
  return j == 0 || i == j ? 4 : 8;
}

// Calls visit(i, j) for the views 0 <= j <= i <= last, i^2 + j^2 <= most, the centre last.
template <class Visit>
void ForEachOrbit(int32_t last, int32_t most, const Visit& visit) {
  for (int32_t i = last; i >= 0; --i) {
    for (int32_t j = i; j >= 0; --j) {
      if (i * i + j * j <= most) visit(i, j);
    }
  }
}

// Makes the weights of the views (i, j), i^2 + j^2 <= most and i <= last, in proportion to their
// light `light(i, j)`, 20 bits.
template <class Light>
Aperture Weigh(int32_t n, int32_t last, int32_t most, const Light& light, uint16_t* weights) {
  for (size_t index = 0; index < ApertureSize(n); ++index) weights[index] = 0;
  Aperture aperture;
  aperture.n = n;
  aperture.last = last;
  aperture.most = most;
  aperture.weights = weights;
  uint64_t total = 0;
  aperture.views = 0;
  ForEachOrbit(last, most, [&](int32_t i, int32_t j) {
    total += Orbit(i, j) * light(i, j);
    aperture.views += static_cast<int32_t>(Orbit(i, j));
  });
  // The largest sum for which the centre's weight, with a margin for the rounding of the others,
  // fits 15 bits.
  const uint64_t centre = light(0, 0);
  int bits = kMaxWeightBits;
  while (bits > 1 && (centre << bits) / total > static_cast<uint64_t>(kMaxWeight - 8)) --bits;
  aperture.sum_bits = bits;
  // Each orbit takes up the rounding error of those before it; the centre, alone in its orbit,
  // leaves none.
  uint64_t wanted = 0;
  int64_t given = 0;
  ForEachOrbit(last, most, [&](int32_t i, int32_t j) {
    const int64_t orbit = Orbit(i, j);
    wanted += static_cast<uint64_t>(orbit) * light(i, j);
    const auto target = static_cast<int64_t>((wanted << bits) / total);  // < 2^63
    const int64_t weight = Max64(0, (target - given + orbit / 2) / orbit);
    weights[i * (i + 1) / 2 + j] = static_cast<uint16_t>(Checked(ranges::kWeight, weight));
    given += weight * orbit;
  });
  Checked(ranges::kRemainder, given - (int64_t{1} << bits));
  return aperture;
}

// Returns the light, 20 bits, that goes through the subaperture around (i, j) of a lens whose
// radius is `radius` (kSubapertureUnits): summed over the points of a square grid.
uint64_t LightOfSubaperture(int32_t i, int32_t j, int32_t radius, uint32_t fall_off) {
  constexpr int32_t kStep = 2, kPoints = kSubapertureUnits / kStep;
  const auto lens = static_cast<uint64_t>(radius) * static_cast<uint64_t>(radius);
  int bits = 0;  // that (3) does without
  while (lens >> bits >= uint64_t{1} << 18) ++bits;
  uint64_t light = 0;
  for (int32_t a = 0; a < kPoints; ++a) {
    for (int32_t b = 0; b < kPoints; ++b) {
      const int64_t x = kSubapertureUnits * i + kStep * a + 1 - kSubapertureUnits / 2;
      const int64_t y = kSubapertureUnits * j + kStep * b + 1 - kSubapertureUnits / 2;
      const auto square = static_cast<uint64_t>(x * x + y * y);
      if (square <= lens) light += Relative(square >> bits, lens >> bits, fall_off);
    }
  }
  return light / (kPoints * kPoints);
}

}  // namespace

uint32_t ApertureFallOff(double theta) {
  const double tangent = std::tan(theta);
  return static_cast<uint32_t>(65536.0 / (tangent * tangent) + 0.5);
}

Aperture MakeAperture(int32_t n, uint32_t fall_off, uint16_t* weights) {
  const uint64_t n_square = n == 0 ? 1 : static_cast<uint64_t>(n) * static_cast<uint64_t>(n);
  return Weigh(
      n, n, n * n,
      [&](int32_t i, int32_t j) {
        return Relative(static_cast<uint64_t>(i * i + j * j), n_square, fall_off);
      },
      weights);
}

Aperture MakeSubapertures(int32_t n, uint32_t fall_off, uint16_t* weights) {
  if (n == 0) return MakeAperture(n, fall_off, weights);
  const int32_t radius = LensInSubapertures(n), last = LastSubaperture(n);
  Aperture aperture = Weigh(
      n, last, MostOfSubapertures(n),
      [&](int32_t i, int32_t j) { return LightOfSubaperture(i, j, radius, fall_off); }, weights);
  aperture.extent = SubapertureExtent(n);
  return aperture;
}

}  // namespace starfocus
