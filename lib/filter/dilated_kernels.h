// SPDX-License-Identifier: Apache-2.0
// Kernels (4) whose taps lie two pixels apart, on a prefiltered picture (simd/prefilter.h): a disc
// of half the radius in taps, with a fourth of the taps (docs/method.md, Gathering).
#ifndef STARFOCUS_LIB_FILTER_DILATED_KERNELS_H_
#define STARFOCUS_LIB_FILTER_DILATED_KERNELS_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/watch.h"
#include "lib/filter/blur.h"
#include "simd/kernels.h"

namespace starfocus {

inline constexpr int32_t kDilation = 2;

// The smallest blur radius, in pixels, that has a dilated kernel: smaller ones would have too few
// taps for their rim (docs/constants.md). Light that falls off faster than (3) does with the
// default theta takes larger radii, and of even light it is what the ring is wide that counts.
inline constexpr double kDilatedFrom = 7, kEvenDilatedFrom = 10;

// The step of the first dilated kernel of an opening that an octant tells.
int32_t FirstDilatedStep(const Opening& opening);

// What kernels of steps [first, BlurStepCount(max_blur)) are and hold together.
size_t DilatedKernelCount(int32_t first, double max_blur);
size_t DilatedWeightCount(int32_t first, double max_blur);

// How far around a cell pixels are read, for blur of so many whole pixels at most.
constexpr int32_t DilatedReach(int32_t radius) {
  return radius / kDilation * kDilation + simd::kPrefilterReach;
}

// Makes the kernels of steps [first, last) behind those of [begin, first), which must have been
// made; kernels[0] and weights[0] belong to `begin`. `mean_square` is the opening's (MeanSquare).
// Returns the step that patience (null: it lasts) ended at, or `last`.
int32_t MakeDilatedKernels(int32_t begin, int32_t first, int32_t last, const Opening& opening,
                           int32_t mean_square, Patience* patience, uint16_t* weights,
                           BlurKernel* kernels);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_FILTER_DILATED_KERNELS_H_
