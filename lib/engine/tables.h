// SPDX-License-Identifier: Apache-2.0
// Tables that an engine makes once, by N.
#ifndef STARFOCUS_LIB_ENGINE_TABLES_H_
#define STARFOCUS_LIB_ENGINE_TABLES_H_

#include <cstdint>

#include "lib/base/aperture.h"
#include "lib/base/watch.h"
#include "lib/filter/blur.h"
#include "lib/plan/timing.h"
#include "starfocus/starfocus.h"

namespace starfocus {

struct Tables {
  Opening opening;
  // There are apertures of every N up to max_n by the paper's rule, and up to max_subaperture_n by
  // the rule of subapertures.
  int32_t max_n, max_subaperture_n;
  Aperture *apertures, *subapertures;
  uint16_t* aperture_weights;  // of both
  ViewCounts *view_counts, *subaperture_view_counts;
  uint16_t* benchmark_weights;  // of the one aperture of the benchmark mode
  BlurKernel* blur_kernels;
  uint16_t* blur_weights;
  int32_t blur_steps;   // kernels made so far
  int32_t mean_square;  // MeanSquare of the opening
};

// Makes all but the blur kernels; the arrays must be set.
void MakeTables(const sf_config& config, Tables* tables);

// Makes the blur kernels of steps up to `steps` that are not there yet. Returns SF_OK or
// SF_ERROR_CANCELLED; those that were made stay.
sf_status MakeBlurKernels(int32_t steps, Watch* watch, Tables* tables);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_TABLES_H_
