// SPDX-License-Identifier: Apache-2.0
// Compares openings of lenses with the same shapes in double precision, and checks the weights and
// PSFs of all shapes.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "lib/optics/opening.h"
#include "lib/optics/psf.h"
#include "lib/optics/view_weights.h"
#include "starfocus/starfocus.hpp"
#include "tests/conformance/reference_line.h"
#include "tests/support/shapes.h"

namespace aperture_shape_slow_test {
namespace {

using starfocus::ApertureShape;
using starfocus::ViewWeights;

starfocus::Params LensOf(const test::NamedShape& shape) {
  starfocus::Params lens = test::Params(0);
  shape.Set(&lens);
  return lens;
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

TEST_CASE("opening: points inside the shape pass light, and points outside the shape do not") {
  constexpr int kRadius = 1000;
  test::Random random(5);
  for (int trial = 0; trial < 200; ++trial) {
    const starfocus::Params lens = RandomLens(&random);
    const ApertureShape opening = starfocus::ShapeOf(lens);
    const reference::ApertureShape exact(lens);
    int wrong = 0;
    for (int k = 0; k < 2000; ++k) {
      const int x = random.Int(-1050, 1050), y = random.Int(-1050, 1050);
      const bool open = starfocus::LetsThrough(opening, x, y, kRadius);
      // Points close to an edge may count as inside or outside.
      bool near_edge = false, inside = exact.Density(x / 1000.0, y / 1000.0) > 0;
      for (const double turn : {0.0, 1.6, 3.1, 4.7}) {
        const double u = x / 1000.0 + 5e-4 * std::cos(turn), v = y / 1000.0 + 5e-4 * std::sin(turn);
        near_edge |= (exact.Density(u, v) > 0) != inside;
      }
      wrong += open != inside && !near_edge;
    }
    CHECK_MESSAGE(wrong == 0, test::ShapeText(lens));
  }
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

TEST_CASE("opening: a second rim that is not shifted removes no light") {
  for (const test::NamedShape& shape : test::kShapes) {
    const ApertureShape opening = starfocus::ShapeOf(LensOf(shape));
    for (const int n : {4, 6, 11}) {
      std::vector<uint16_t> weights(starfocus::ViewWeightsSize(opening, n));
      std::vector<uint16_t> rest(starfocus::FullApertureSize(n));
      const ViewWeights whole = starfocus::MakeSubapertures(n, opening, weights.data());
      const ViewWeights same = starfocus::MakeCatsEye(whole, opening, {}, rest.data());
      CHECK(same.sum_bits == whole.sum_bits);
      int apart = 0;
      Total(n, [&](int i, int j) {
        return apart = std::max(apart, std::abs(int(same.Weight(i, j)) - int(whole.Weight(i, j))));
      });
      CHECK_MESSAGE(apart <= 1, shape.name);
    }
  }
}

TEST_CASE("opening: the cat's-eye shift is mirrored with the block and is largest in the corners") {
  ApertureShape opening;
  opening.cats_eye = starfocus::kOpeningOne;
  const auto shift = [&](int x, int y) {
    return starfocus::ShiftOfRim(opening, {x, y, 32, 32}, 640, 480);
  };
  CHECK(shift(304, 224).x == 0);
  CHECK(shift(304, 224).y == 0);
  CHECK(shift(0, 0).x == -shift(608, 0).x);
  CHECK(shift(0, 0).y == -shift(0, 448).y);
  CHECK(shift(0, 0).x > 0);
  const double far = std::hypot(shift(0, 0).x, shift(0, 0).y) / starfocus::kOpeningOne;
  CHECK(far == doctest::Approx(std::hypot(304, 224) / 400).epsilon(1e-3));
}

TEST_CASE("opening: PSFs of the blur mode sum to exactly one for any shape") {
  test::Random random(8);
  constexpr double kMost = 13;
  const int steps = starfocus::PsfCount(kMost);
  for (int trial = 0; trial < 60; ++trial) {
    const starfocus::Params lens = RandomLens(&random);
    const ApertureShape opening = starfocus::ShapeOf(lens);
    std::vector<uint16_t> weights(starfocus::BlurWeightCount(!opening.IsSymmetric(), kMost));
    std::vector<starfocus::Psf> kernels(static_cast<size_t>(steps));
    starfocus::MakePsfs(0, steps, opening, nullptr, weights.data(), kernels.data());
    int wrong = 0;
    for (const starfocus::Psf& kernel : kernels) {
      wrong += Total(kernel.size, [&](int n, int m) { return kernel.Weight(n, m); }) !=
               int64_t{1} << kernel.sum_bits;
    }
    CHECK_MESSAGE(wrong == 0, test::ShapeText(lens));
  }
}

}  // namespace
}  // namespace aperture_shape_slow_test
