// SPDX-License-Identifier: Apache-2.0
// Compares the integer weights of views with the aperture (3) in double precision, and checks the
// sums and widths of the weights and point-spread functions of all shapes.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "lib/base/fixed.h"
#include "lib/optics/opening.h"
#include "lib/optics/psf.h"
#include "lib/optics/view_weights.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/shapes.h"

namespace openings_test {
namespace {

using starfocus::ApertureShape;
using starfocus::ViewWeights;

constexpr int kOne = 1 << starfocus::kDisparityBits;
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

TEST_CASE("aperture: cot^2 theta has 16 fractional bits") {
  for (const double theta : kThetas) {
    const double cot2 = std::pow(std::cos(theta) / std::sin(theta), 2);
    CHECK(std::fabs(starfocus::ApertureFallOff(theta) / 65536.0 - cot2) <= 0.5001 / 65536);
  }
}

TEST_CASE("aperture: weights follow equation (3), sum to a power of two and fit signed 16 bits") {
  double furthest = 0, furthest_centre = 0;
  for (int n = 1; n <= 41; ++n) {
    if (n == 41) n = 256;  // the largest N
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

TEST_CASE("aperture: with N = 0, the centre view has all the weight") {
  const Sampled sampled(0, 0.26 * kPi);
  CHECK(sampled.aperture.views == 1);
  CHECK(sampled.aperture.Weight(0, 0) == 1u << sampled.aperture.sum_bits);
  CHECK(sampled.aperture.Weight(0, 0) <= 32767);
  uint16_t weight = 0;
  const starfocus::ViewWeights subapertures = starfocus::MakeSubapertures(0, 65536, &weight);
  CHECK(subapertures.views == 1);
  CHECK(subapertures.last == 0);
  CHECK(weight == 1 << subapertures.sum_bits);
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

starfocus::Params RandomLens(test::Random* random) {
  starfocus::Params lens = test::Params(0);
  test::RandomShape(&lens, random);
  return lens;
}

template <class Weight>
int64_t Total(int n, const Weight& weight) {
  int64_t sum = 0;
  for (int i = -n; i <= n; ++i) {
    for (int j = -n; j <= n; ++j) sum += weight(i, j);
  }
  return sum;
}

TEST_CASE("opening: weights sum to a power of two, and each weight fits its type") {
  test::Random random(6);
  for (int trial = 0; trial < 150; ++trial) {
    const starfocus::Params lens = RandomLens(&random);
    const ApertureShape opening = starfocus::ShapeOf(lens);
    const int n = random.Int(0, 9) == 0 ? random.Int(60, 130) : random.Int(1, 30);
    std::vector<uint16_t> weights(starfocus::ViewWeightsSize(opening, n));
    std::vector<uint16_t> rest(starfocus::FullApertureSize(n));
    CAPTURES(test::ShapeText(lens), n);
    for (const bool wide : {false, true}) {
      const ViewWeights whole = wide ? starfocus::MakeSubapertures(n, opening, weights.data())
                                     : starfocus::MakeViewWeights(n, opening, weights.data());
      const auto check = [&](const ViewWeights& aperture) {
        const auto weight = [&](int i, int j) { return aperture.Weight(i, j); };
        CHECK(Total(n, weight) == int64_t{1} << aperture.sum_bits);
        int too_large = 0;
        Total(n, [&](int i, int j) { return too_large += aperture.Weight(i, j) > 32767; });
        CHECK(too_large == 0);
      };
      check(whole);
      // Shifts the second rim of the cat's eye by the largest distance and by smaller distances, in
      // random directions.
      for (int k = 0; k < 4; ++k) {
        const double angle = random.Real(0, 6.3), far = k < 2 ? 1 : random.Unit();
        const int one = starfocus::kOpeningOne;
        const starfocus::RimShift shift = {static_cast<int32_t>(one * far * std::cos(angle)),
                                           static_cast<int32_t>(one * far * std::sin(angle))};
        check(starfocus::MakeCatsEye(whole, opening, shift, rest.data()));
      }
    }
  }
}

// Checks the PSFs of radii up to `most`. The PSFs are made in two calls, as in an engine that later
// requires PSFs for larger radii.
void CheckPsfs(const ApertureShape& opening, double most) {
  const int count = starfocus::PsfCount(most);
  std::vector<uint16_t> weights(starfocus::BlurWeightCount(!opening.IsSymmetric(), most));
  std::vector<starfocus::Psf> psfs(static_cast<size_t>(count));
  starfocus::MakePsfs(0, count / 3, opening, nullptr, weights.data(), psfs.data());
  starfocus::MakePsfs(count / 3, count, opening, nullptr, weights.data(), psfs.data());
  int wrong = 0;
  for (const starfocus::Psf& psf : psfs) {
    uint32_t largest = 0;
    const int64_t sum = Total(psf.size, [&](int n, int m) {
      largest = std::max(largest, psf.Weight(n, m));
      return psf.Weight(n, m);
    });
    wrong += sum != int64_t{1} << psf.sum_bits || psf.sum_bits < 1 || psf.sum_bits > 24;
    wrong += largest > 32767;
    // A symmetric opening stores an eighth of its weights.
    if (!opening.IsSymmetric()) continue;
    const auto first = size_t(psf.weights - weights.data());
    wrong += first + size_t((psf.size + 1) * (psf.size + 2) / 2) > weights.size();
  }
  CHECK(wrong == 0);
}

TEST_CASE("PSF: the weights of any shape sum to exactly one and fit their types") {
  CheckPsfs(starfocus::ApertureFallOff(0.26 * kPi), STARFOCUS_MAX_BLUR);
  test::Random random(8);
  for (int trial = 0; trial < 20; ++trial) {
    const starfocus::Params lens = RandomLens(&random);
    CAPTURE(test::ShapeText(lens));
    CheckPsfs(starfocus::ShapeOf(lens), 13);
  }
}

TEST_CASE("PSF: PsfIndex rounds each radius to the nearest radius that has a PSF") {
  int last = -1;
  for (int radius = 0; radius <= int(STARFOCUS_MAX_BLUR) * kOne; ++radius) {
    const int step = starfocus::PsfIndex(radius);
    REQUIRE(step >= last);
    REQUIRE(step <= last + 1);
    last = step;
  }
  CHECK(starfocus::PsfIndex(0) == 0);
  // A radius halfway between two steps of 1/8 pixel is rounded up.
  CHECK(starfocus::PsfIndex(4) == 1);
  CHECK(starfocus::PsfIndex(3) == 0);
  CHECK(starfocus::PsfIndex(4 * kOne) == 32);
  CHECK(starfocus::PsfIndex(8 * kOne) == 64);
  CHECK(starfocus::PsfIndex(128 * kOne) == 32 + 5 * 32);
  CHECK(starfocus::PsfCount(STARFOCUS_MAX_BLUR) > starfocus::PsfIndex(128 * kOne));
}

TEST_CASE("opening: MeanSquare has the expected value for each opening") {
  starfocus::ApertureShape opening;
  const auto mean_square = [&] { return starfocus::MeanSquare(opening) / 16384.0; };
  opening.fall_off = starfocus::ApertureFallOff(0.26 * kPi);
  CHECK(mean_square() == doctest::Approx(0.1877).epsilon(0.002));
  opening.shape = STARFOCUS_SHAPE_DISC;
  CHECK(mean_square() == doctest::Approx(0.25));
  opening.shape = STARFOCUS_SHAPE_RING;
  opening.inner = 1 << 13;
  CHECK(mean_square() == doctest::Approx(0.3125));
  starfocus::Params lens = test::Params(0, 1, STARFOCUS_MODE_BLUR);
  lens.shape = STARFOCUS_SHAPE_POLYGON;
  lens.blades = 3;
  opening = starfocus::ShapeOf(lens);
  CHECK(mean_square() == doctest::Approx(0.125).epsilon(0.02));
  lens.blades = 6;
  opening = starfocus::ShapeOf(lens);
  CHECK(mean_square() == doctest::Approx(5.0 / 24).epsilon(0.02));
}

}  // namespace
}  // namespace openings_test
