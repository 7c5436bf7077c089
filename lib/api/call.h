// SPDX-License-Identifier: Apache-2.0
// A refocusing as all functions of the C ABI start it, whatever their formats.
#ifndef STARFOCUS_LIB_API_CALL_H_
#define STARFOCUS_LIB_API_CALL_H_

#include "lib/engine/driver.h"
#include "lib/engine/engine.h"
#include "lib/source/extents.h"
#include "lib/source/prepared.h"

namespace starfocus {

struct Call {
  const starfocus_params& params;
  RowSource source;
  RowSink sink;
  const Prepared* prepared = nullptr;                             // null: there is none
  const starfocus_light_field *before = nullptr, *now = nullptr;  // null: nothing to compare with
};

// Checks params, and the prepared light field (null: none) against the engine's configuration.
starfocus_status CheckCall(const starfocus_config& config, const starfocus_params& params,
                           const Prepared* prepared);

// The memory of the engine and of a prepared light field, which no output may overlap.
Extents MemoryOf(const EngineState& engine, const Prepared* prepared);

// Refocuses. The views must be set and everything checked but the values of the map.
starfocus_status RunCall(const Call& call, EngineState* engine, starfocus_report* report);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_API_CALL_H_
