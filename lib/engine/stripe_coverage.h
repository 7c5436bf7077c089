// SPDX-License-Identifier: Apache-2.0
// Finds the coverage map (lib/coverage) of the rows that a stripe needs, pass by pass.
#ifndef STARFOCUS_LIB_ENGINE_STRIPE_COVERAGE_H_
#define STARFOCUS_LIB_ENGINE_STRIPE_COVERAGE_H_

#include <cstdint>

#include "lib/base/arena.h"
#include "lib/engine/engine.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Takes the memory of a coverage map for stripes that need `border` rows around them.
void TakeCoverage(const starfocus_config& config, int32_t border, Arena* arena,
                  CoverageState* state);

// Finds the coverage of the rows that the stripe's blocks read.
starfocus_status FindCoverage(const Stripe& stripe, EngineState* engine);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_STRIPE_COVERAGE_H_
