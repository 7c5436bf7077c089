// SPDX-License-Identifier: Apache-2.0
#include "lib/filter/dilated_kernels.h"

#include <cmath>

namespace starfocus {
namespace {

constexpr double kOne = 1 << kDisparityBits;

// The fall-off of the default theta.
constexpr double kUsualFallOff = 0.88;

// Returns the radius in taps, kDisparityBits, of the kernel that is as wide as that of a step, in
// the mean square of a coordinate. A pixel adds 1/12 to that of the disc, a tap four times as much;
// the prefilter adds nothing.
int32_t RadiusInTaps(int32_t step, int32_t mean_square) {
  const double radius = RadiusOfStep(step) / kOne;
  const double of_disc = static_cast<double>(mean_square) / kOpeningOne;
  const double square = radius * radius - (kDilation * kDilation - 1) / 12.0 / of_disc;
  return static_cast<int32_t>(std::sqrt(square) / kDilation * kOne + 0.5);
}

}  // namespace

int32_t FirstDilatedStep(const Opening& opening) {
  double from = kDilatedFrom;
  if (opening.shape == SF_SHAPE_FALL_OFF) {
    const double fall_off = opening.fall_off / 65536.0;
    if (fall_off < kUsualFallOff) from *= std::sqrt(kUsualFallOff / fall_off);
  } else {
    from = kEvenDilatedFrom / (1 - static_cast<double>(opening.inner) / kOpeningOne);
  }
  const double most = SF_MAX_BLUR;
  return BlurStepAbove(static_cast<int32_t>((from < most ? from : most) * kOne));
}

size_t DilatedKernelCount(int32_t first, double max_blur) {
  const int32_t end = BlurStepCount(max_blur);
  return static_cast<size_t>(Max(end, first) - first);
}

size_t DilatedWeightCount(int32_t first, double max_blur) {
  size_t count = 0;
  for (int32_t step = first; step < BlurStepCount(max_blur); ++step) {
    count += BlurWeightsOf(RadiusOfStep(step) / kDilation);
  }
  return count;
}

int32_t MakeDilatedKernels(int32_t begin, int32_t first, int32_t last, const Opening& opening,
                           int32_t mean_square, Patience* patience, uint16_t* weights,
                           BlurKernel* kernels) {
  for (int32_t step = begin; step < last; ++step, ++kernels) {
    if (step >= first &&
        !MakeBlurKernel(RadiusInTaps(step, mean_square), opening, patience, weights, kernels)) {
      return step;
    }
    weights += BlurWeightsOf(RadiusOfStep(step) / kDilation);
  }
  return last;
}

}  // namespace starfocus
