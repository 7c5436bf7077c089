// SPDX-License-Identifier: Apache-2.0
// The plan of a stripe: which superblocks it needs, what their cells know, and the blocks each
// is split into.
#ifndef STARFOCUS_LIB_ENGINE_STRIPE_PLAN_H_
#define STARFOCUS_LIB_ENGINE_STRIPE_PLAN_H_

#include <cstdint>

#include "lib/engine/engine.h"
#include "lib/engine/jobs.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Marks in the stripe's plan the columns that are refocused and those whose cells they need.
// Returns whether there are any.
bool ChooseColumns(const Stripe& rows, EngineState* engine);

// Measures cells, splits the superblocks, drops blocks that nothing asked for depends on, and
// tells the caller of the others. Returns STARFOCUS_OK, STARFOCUS_ERROR_RUNNER or
// STARFOCUS_ERROR_CANCELLED.
starfocus_status PlanStripe(const Stripe& rows, EngineState* engine);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_STRIPE_PLAN_H_
