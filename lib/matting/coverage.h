// SPDX-License-Identifier: Apache-2.0
// Computes the coverage map of the rows that a stripe reads, in passes over tiles.
#ifndef STARFOCUS_LIB_MATTING_COVERAGE_H_
#define STARFOCUS_LIB_MATTING_COVERAGE_H_

#include "lib/base/arena.h"
#include "lib/base/geometry.h"
#include "lib/base/jobs.h"
#include "lib/matting/coverage_map.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Returns the distance in pixels from a split pixel to the farthest pixels that the passes read.
// Returns 0 if the engine has no memory for coverage.
int32_t CoverageBorder(const starfocus_config& config);

// Allocates the coverage map for stripes that read `border` rows above and below.
void TakeCoverage(const starfocus_config& config, int32_t border, Arena* arena, CoverageMap* map);

// Forgets the rows that were computed, so that FindCoverage starts anew.
void ForgetCoverage(CoverageMap* map);

// Computes the coverage of `rows` of the picture in `map`, which must be input.coverage. Rows
// beyond the picture are ignored. Stripes must follow each other from top to bottom. Returns
// STARFOCUS_OK, STARFOCUS_ERROR_RUNNER or STARFOCUS_ERROR_CANCELLED.
starfocus_status FindCoverage(const starfocus_config& config, const Input& input, const Range& rows,
                              Jobs* jobs, CoverageMap* map);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_MATTING_COVERAGE_H_
