// SPDX-License-Identifier: Apache-2.0
// Computes the coverage map (lib/matting) for the rows that a stripe reads.
#ifndef STARFOCUS_LIB_ENGINE_STRIPE_COVERAGE_H_
#define STARFOCUS_LIB_ENGINE_STRIPE_COVERAGE_H_

#include <cstdint>

#include "lib/base/arena.h"
#include "lib/engine/engine.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Allocates the coverage map for stripes that read `border` rows above and below.
void TakeCoverage(const starfocus_config& config, int32_t border, Arena* arena,
                  CoverageState* state);

// Computes the coverage of the rows that the blocks of the stripe read.
starfocus_status FindCoverage(const Stripe& stripe, EngineState* engine);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_STRIPE_COVERAGE_H_
