// SPDX-License-Identifier: Apache-2.0
// Code shared by all functions of the C API that refocus, for all formats.
#ifndef STARFOCUS_LIB_API_CALL_H_
#define STARFOCUS_LIB_API_CALL_H_

#include "lib/base/geometry.h"
#include "lib/base/problem.h"
#include "lib/engine/driver.h"
#include "lib/engine/engine.h"
#include "lib/engine/prepared.h"

namespace starfocus {

// Checks `params` and the prepared light field, which may be null, against the configuration of
// the engine.
void CheckCall(const starfocus_config& config, const starfocus_params& params,
               const Prepared* prepared, Checker* check);

// Returns the address ranges of the engine and of a prepared light field. Outputs must not overlap
// these address ranges.
Extents MemoryOf(const EngineState& engine, const Prepared* prepared);

// Runs a refocusing. Before this call, the caller must set the engine's input and check
// all arguments except the values of the map. `previous` and `now` are the previous frame and the
// current light field of a video; `previous` is null if frames are not compared.
starfocus_status RunCall(const starfocus_params& params, const Output& out,
                         const starfocus_previous* previous, const starfocus_light_field* now,
                         EngineState* engine, starfocus_report* report);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_API_CALL_H_
