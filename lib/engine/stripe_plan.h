// SPDX-License-Identifier: Apache-2.0
// Plans a stripe: selects the superblocks to refocus, measures their cells, and splits each
// superblock into blocks.
#ifndef STARFOCUS_LIB_ENGINE_STRIPE_PLAN_H_
#define STARFOCUS_LIB_ENGINE_STRIPE_PLAN_H_

#include <cstdint>

#include "lib/engine/engine.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Allocates the cells and blocks of a stripe, and the map of their layers.
void TakePlan(const starfocus_config& config, Arena* arena, StripeState* stripe);

// Marks the columns of superblocks to refocus, and the columns whose cells must be measured to plan
// these superblocks. Returns false if no column has to be refocused.
bool ChooseColumns(const Stripe& rows, EngineState* engine);

// Measures cells, splits superblocks, and drops blocks that do not affect the requested pixels.
// Reports the remaining blocks to the caller's visitor. Returns STARFOCUS_OK,
// STARFOCUS_ERROR_RUNNER or STARFOCUS_ERROR_CANCELLED.
starfocus_status PlanStripe(const Stripe& rows, EngineState* engine);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_STRIPE_PLAN_H_
