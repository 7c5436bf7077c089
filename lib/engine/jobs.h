// SPDX-License-Identifier: Apache-2.0
// Typed jobs of an engine. Each job receives the scratch memory of its worker.
#ifndef STARFOCUS_LIB_ENGINE_JOBS_H_
#define STARFOCUS_LIB_ENGINE_JOBS_H_

#include <cstdint>

#include "starfocus/starfocus.h"

namespace starfocus {

// Returns the largest number of jobs in any set of an engine.
int32_t MaxJobs(const starfocus_config& config);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_JOBS_H_
