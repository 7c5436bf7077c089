// SPDX-License-Identifier: Apache-2.0
// Checks of what is prepared, whatever its format.
#ifndef STARFOCUS_LIB_API_PREPARE_H_
#define STARFOCUS_LIB_API_PREPARE_H_

#include "lib/engine/engine.h"
#include "lib/source/extents.h"
#include "lib/source/prepared.h"

namespace starfocus {

// Checks the memory that a prepared light field is to be made in, which must not overlap what is
// `read`.
sf_status CheckPreparedMemory(const EngineState& engine, const PrepareCall& call, Extents* read);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_API_PREPARE_H_
