// SPDX-License-Identifier: Apache-2.0
// What dilated kernels and the prefilter show together, against the ideal kernel (4).
#include "lib/filter/dilated_kernels.h"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "lib/analysis/aperture.h"
#include "lib/analysis/ideal.h"
#include "lib/analysis/kernel.h"
#include "lib/base/opening.h"
#include "lib/base/rules.h"
#include "lib/plan/block_stats.h"
#include "tests/support/inside.h"

namespace starfocus {
namespace {

using namespace analysis;

// The kernels of an opening from its first dilated one on.
struct Kernels {
  explicit Kernels(const Opening& of, double max_blur = kMaxGather)
      : opening(of), first(FirstDilatedStep(of)), end(BlurStepCount(max_blur)) {
    kernels.resize(DilatedKernelCount(first, max_blur));
    weights.resize(DilatedWeightCount(first, max_blur));
    CHECK(MakeDilatedKernels(first, first, end, opening, MeanSquare(opening), nullptr,
                             weights.data(), kernels.data()) == end);
  }

  // What a step shows of a point.
  Kernel Shown(int32_t step) const {
    constexpr double kTaps[5] = {-1 / 16., 4 / 16., 10 / 16., 4 / 16., -1 / 16.};
    const BlurKernel& kernel = kernels[static_cast<size_t>(step - first)];
    Kernel shown(kDilation * kernel.size + 2);
    for (int m = -kernel.size; m <= kernel.size; ++m) {
      for (int n = -kernel.size; n <= kernel.size; ++n) {
        const double weight = std::ldexp(kernel.Weight(n, m), -kernel.sum_bits);
        for (int k = 0; k < 25; ++k) {
          shown.at(kDilation * n + k % 5 - 2, kDilation * m + k / 5 - 2) +=
              weight * kTaps[k % 5] * kTaps[k / 5];
        }
      }
    }
    return shown;
  }

  Opening opening;
  int32_t first, end;
  std::vector<BlurKernel> kernels;
  std::vector<uint16_t> weights;
};

// The sum and the mean square of a coordinate.
struct Moments {
  double sum = 0, square = 0;
  explicit Moments(const Kernel& kernel) {
    for (int m = -kernel.radius(); m <= kernel.radius(); ++m) {
      for (int n = -kernel.radius(); n <= kernel.radius(); ++n) {
        sum += kernel(n, m);
        square += kernel(n, m) * n * n;
      }
    }
  }
};

TEST_CASE("dilated kernels: as wide as the ideal kernel, and close to it") {
  const Kernels made(Opening(ApertureFallOff(kDefaultTheta)));
  double worst = 0;
  for (int32_t step = made.first; step < made.end; ++step) {
    const double radius = RadiusOfStep(step) / double(1 << kDisparityBits);
    CAPTURE(radius);
    const Kernel shown = made.Shown(step), ideal = IdealKernel(radius, kDefaultTheta);
    const Moments of_shown(shown), of_ideal(ideal);
    CHECK(of_shown.sum == doctest::Approx(1).epsilon(1e-12));
    CHECK(of_shown.square / of_shown.sum ==
          doctest::Approx(of_ideal.square / of_ideal.sum).epsilon(0.01));
    worst = std::max(worst, SquaredError(shown, ideal));
  }
  MESSAGE("largest squared error: ", worst);
  CHECK(worst < 1e-4);
}

TEST_CASE("dilated kernels: from where their taps are enough for the rim") {
  const auto from = [](const Opening& opening) {
    return RadiusOfStep(FirstDilatedStep(opening)) / double(1 << kDisparityBits);
  };
  CHECK(from(Opening(ApertureFallOff(kDefaultTheta))) == kDilatedFrom);
  CHECK(from(Opening(ApertureFallOff(0.1 * kPi))) == kDilatedFrom);
  CHECK(from(Opening(ApertureFallOff(0.4 * kPi))) > 2 * kDilatedFrom);
  Opening disc(0);
  disc.shape = SF_SHAPE_DISC;
  CHECK(from(disc) == kEvenDilatedFrom);
  Opening ring(0);
  ring.shape = SF_SHAPE_RING;
  ring.inner = kOpeningOne / 2;
  CHECK(from(ring) == 2 * kEvenDilatedFrom);
  ring.inner = kOpeningOne - 1;
  CHECK(from(ring) == SF_MAX_BLUR);
  CHECK(DilatedKernelCount(FirstDilatedStep(ring), kMaxGather) == 0);
}

TEST_CASE("dilated kernels: none reads farther than it may, and those made before stay") {
  const Kernels whole(Opening(ApertureFallOff(kDefaultTheta)));
  for (int32_t step = whole.first; step < whole.end; ++step) {
    const BlurKernel& kernel = whole.kernels[static_cast<size_t>(step - whole.first)];
    const int32_t pixels = (RadiusOfStep(step) + (1 << kDisparityBits) - 1) >> kDisparityBits;
    CHECK(kDilation * kernel.size + simd::kPrefilterReach <= DilatedReach(pixels));
    CHECK(kDilation * kernel.size <= simd::kMaxDisc);
  }
  std::vector<BlurKernel> kernels(whole.kernels.size());
  std::vector<uint16_t> weights(whole.weights.size());
  const int32_t middle = (whole.first + whole.end) / 2;
  MakeDilatedKernels(whole.first, whole.first, middle, whole.opening, MeanSquare(whole.opening),
                     nullptr, weights.data(), kernels.data());
  MakeDilatedKernels(whole.first, middle, whole.end, whole.opening, MeanSquare(whole.opening),
                     nullptr, weights.data(), kernels.data());
  const bool same = weights == whole.weights;
  CHECK(same);
}

TEST_CASE("dilated kernels: the rows that they read of a layer are kept") {
  const Kernels made(Opening(ApertureFallOff(kDefaultTheta)));
  for (int32_t blur = 1; blur <= SF_MAX_BLUR * 4; ++blur) {
    const double max_blur = blur / 4.0;
    CAPTURE(max_blur);
    const Reach reach = test::BordersOf(max_blur);
    for (int layer = 1; layer < SF_LAYERS; ++layer) {
      const int32_t end = BlurStepCount(LargestGather(max_blur / (1 << layer)));
      for (int32_t step = made.first; step < end; ++step) {
        const BlurKernel& kernel = made.kernels[static_cast<size_t>(step - made.first)];
        const int32_t read = kDilation * kernel.size + simd::kPrefilterReach;
        CHECK(LayerMargin(layer) + read <= reach.layer_rows[layer]);
      }
    }
  }
}

}  // namespace
}  // namespace starfocus
