// SPDX-License-Identifier: Apache-2.0
// Compares the integer weights with the aperture (3) in double precision.
#include "lib/optics/view_weights.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "lib/base/fixed.h"
#include "starfocus/starfocus.h"

namespace view_weights_test {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kThetas[] = {STARFOCUS_MIN_THETA, 0.1 * kPi, 0.26 * kPi, 0.4 * kPi,
                              STARFOCUS_MAX_THETA};

// Returns (3): a(u, v) = cot^4 / (pi cos^2 (u^2 + v^2 + cot^2)^2) inside the unit disc.
double Density(double u, double v, double theta) {
  const double cot2 = std::pow(std::cos(theta) / std::sin(theta), 2);
  return cot2 * cot2 / (kPi * std::pow(std::cos(theta), 2) * std::pow(u * u + v * v + cot2, 2));
}

struct Sampled {
  explicit Sampled(int n, double theta)
      : storage(starfocus::ViewWeightsSize(n)),
        aperture(starfocus::MakeViewWeights(n, starfocus::ApertureFallOff(theta), storage.data())) {
  }

  std::vector<uint16_t> storage;
  starfocus::ViewWeights aperture;
};

template <class Visit>
void ForEachView(int n, const Visit& visit) {
  for (int j = -n; j <= n; ++j) {
    for (int i = -n; i <= n; ++i) visit(i, j, i * i + j * j <= n * n);
  }
}

TEST_CASE(
    "aperture: the density of equation (3) falls to cos^4 theta at the rim and integrates to 1") {
  for (const double theta : kThetas) {
    CAPTURE(theta);
    CHECK(Density(0.6, 0.8, theta) / Density(0, 0, theta) ==
          doctest::Approx(std::pow(std::cos(theta), 4)));
    double light = 0;
    constexpr int kRings = 4000;
    for (int ring = 0; ring < kRings; ++ring) {
      const double rho = (ring + 0.5) / kRings;
      light += Density(rho, 0, theta) * 2 * kPi * rho / kRings;
    }
    CHECK(light == doctest::Approx(1).epsilon(1e-5));
  }
}

TEST_CASE("aperture: cot^2 theta has 16 fractional bits") {
  for (const double theta : kThetas) {
    const double cot2 = std::pow(std::cos(theta) / std::sin(theta), 2);
    CHECK(std::fabs(starfocus::ApertureFallOff(theta) / 65536.0 - cot2) <= 0.5001 / 65536);
  }
}

TEST_CASE("aperture: the number of views in the disc equals a table for each N") {
  constexpr int kViews[][2] = {{0, 1},    {1, 5},    {2, 13},    {3, 29},    {4, 49},
                               {5, 81},   {7, 149},  {8, 197},   {10, 317},  {13, 529},
                               {16, 797}, {17, 901}, {19, 1129}, {22, 1517}, {26, 2121}};
  for (const auto& row : kViews) CHECK(Sampled(row[0], 0.26 * kPi).aperture.views == row[1]);
  for (int n = 0; n <= 40; ++n) {
    int views = 0;
    ForEachView(n, [&](int, int, bool inside) { views += inside; });
    CHECK(Sampled(n, 1).aperture.views == views);
  }
}

TEST_CASE("aperture: weights follow equation (3), sum to a power of two and fit signed 16 bits") {
  double furthest = 0, furthest_centre = 0;
  for (int n = 1; n <= 40; ++n) {
    for (const double theta : kThetas) {
      CAPTURE(n);
      CAPTURE(theta);
      const Sampled sampled(n, theta);
      const starfocus::ViewWeights& aperture = sampled.aperture;
      CHECK(aperture.n == n);
      REQUIRE(aperture.sum_bits >= 1);
      REQUIRE(aperture.sum_bits <= 24);
      double total = 0;
      ForEachView(n, [&](int i, int j, bool inside) {
        if (inside) total += Density(double(i) / n, double(j) / n, theta);
      });
      int64_t sum = 0;
      int outside = 0, too_large = 0;
      const double unit = std::ldexp(1.0, aperture.sum_bits);
      ForEachView(n, [&](int i, int j, bool inside) {
        const uint32_t weight = aperture.Weight(i, j);
        sum += weight;
        too_large += weight > 32767;
        outside += !inside && weight != 0;
        if (!inside) return;
        const double wanted = Density(double(i) / n, double(j) / n, theta) / total * unit;
        double& worst = i == 0 && j == 0 ? furthest_centre : furthest;
        worst = std::fmax(worst, std::fabs(weight - wanted));
      });
      CHECK(sum == int64_t{1} << aperture.sum_bits);
      CHECK(outside == 0);
      CHECK(too_large == 0);
      // The largest weight exceeds half of the range of weights, so that rounding errors are small.
      if (aperture.sum_bits < starfocus::kMaxLightBits) CHECK(aperture.Weight(0, 0) > 16000);
    }
  }
  MESSAGE("largest difference from equation (3): " << furthest
                                                   << ", at the centre: " << furthest_centre);
  // Each set of mirrored and transposed views takes the rounding remainder of the previous set. The
  // remainder is at most 4 units: one unit for each of 4 views, or up to 4 units for the centre
  // alone. Rounding the weight adds half a unit, and another half unit on the diagonals, where
  // weights are even. Aperture densities have 20 bits.
  CHECK(furthest < 2);
  CHECK(furthest_centre < 4.6);
}

TEST_CASE("aperture: mirrored and transposed views have the same weight") {
  for (const int n : {1, 2, 7, 18}) {
    const Sampled sampled(n, 0.26 * kPi);
    int different = 0;
    ForEachView(n, [&](int i, int j, bool) {
      const uint32_t weight = sampled.aperture.Weight(i, j);
      different += weight != sampled.aperture.Weight(-i, j);
      different += weight != sampled.aperture.Weight(i, -j);
      different += weight != sampled.aperture.Weight(j, i);
    });
    CHECK(different == 0);
  }
}

TEST_CASE("aperture: a single centre view has all the weight") {
  const Sampled sampled(0, 0.26 * kPi);
  CHECK(sampled.aperture.views == 1);
  CHECK(sampled.aperture.Weight(0, 0) == 1u << sampled.aperture.sum_bits);
  CHECK(sampled.aperture.Weight(0, 0) <= 32767);
}

TEST_CASE("aperture: with the largest N (256), weights have the exact sum and fit 16 bits") {
  for (const double theta : kThetas) {
    const Sampled sampled(256, theta);
    int64_t sum = 0, largest = 0;
    ForEachView(256, [&](int i, int j, bool) {
      sum += sampled.aperture.Weight(i, j);
      largest = std::max<int64_t>(largest, sampled.aperture.Weight(i, j));
    });
    CHECK(sum == int64_t{1} << sampled.aperture.sum_bits);
    CHECK(largest <= 32767);
  }
}

TEST_CASE("aperture: the weight of a subaperture is the light of its part of the lens") {
  for (const double theta : {0.1 * kPi, 0.26 * kPi, 0.4 * kPi}) {
    for (const int n : {1, 2, 3, 4, 5, 6, 7, 9, 13, 40, 256}) {
      std::vector<uint16_t> storage(starfocus::ViewWeightsSize(n));
      const starfocus::ViewWeights subapertures =
          starfocus::MakeSubapertures(n, starfocus::ApertureFallOff(theta), storage.data());
      const double lens = starfocus::LensInSubapertures(n) / 32.0,
                   c = std::pow(std::tan(theta), -2);
      CAPTURE(n);
      CHECK(subapertures.n == n);
      CHECK(subapertures.extent == doctest::Approx(subapertures.last / lens));
      int views = 0;
      double sum = 0, light = 0, squares = 0, exact = 0;
      for (int i = -n; i <= n; ++i) {
        for (int j = -n; j <= n; ++j) {
          const double weight = subapertures.Weight(i, j);
          const bool inside = i * i + j * j <= subapertures.most;
          CHECK((inside || weight == 0));
          views += inside;
          sum += weight;
          squares += weight * (i * i + j * j + 1.0 / 6) / (lens * lens);
        }
      }
      // Integrates the light over rings of the lens. `exact` / `light` is the mean square of the
      // radius.
      for (double rho = 0.5e-3; rho < 1; rho += 1e-3) {
        const double ring = rho * std::pow(c / (rho * rho + c), 2);
        light += ring;
        exact += ring * rho * rho;
      }
      CHECK(subapertures.last > 0);
      CHECK(views == subapertures.views);
      CHECK(sum == std::ldexp(1.0, subapertures.sum_bits));
      // The box of a subaperture at the rim spreads light beyond the rim of the lens.
      CHECK(squares / sum == doctest::Approx(exact / light)
                                 .epsilon(n < 4    ? 0.25
                                          : n < 13 ? 0.06
                                                   : 0.02));
    }
  }
}

TEST_CASE("aperture: with N = 0, the centre view is the only view") {
  uint16_t weight = 0;
  const starfocus::ViewWeights subapertures = starfocus::MakeSubapertures(0, 65536, &weight);
  CHECK(subapertures.views == 1);
  CHECK(subapertures.last == 0);
  CHECK(weight == 1 << subapertures.sum_bits);
}

}  // namespace
}  // namespace view_weights_test
