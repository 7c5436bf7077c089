// SPDX-License-Identifier: Apache-2.0
// Coverage of the hair that a map of one view has as a closed outline. Colours of the near and of
// the far surface are carried on from where they are pure, and each pixel near the outline is
// parted by them.
#ifndef STARFOCUS_LIB_DEPTH_HAIR_COVERAGE_H_
#define STARFOCUS_LIB_DEPTH_HAIR_COVERAGE_H_

#include <cstdint>

#include "lib/depth/hair_job.h"
#include "lib/depth/phases.h"

namespace starfocus {

HairMemory TakeHairMemory(const EstimatePlan& plan, Carver* carver);

// The phases that FindHairCoverage takes at most.
inline constexpr int32_t kHairPhases = 9;

// Marks the cells that have hair as a closed outline, and writes their coverage. Says whether there
// are any. SF_OK, or what Phases::Run returns.
sf_status FindHairCoverage(const ColourMap& map, const MapOutput& output, const HairCells& cells,
                           const HairMemory& memory, Phases* phases, bool* found);

// Completes a tile when its map is written: the coverage of cells without hair, which is what the
// map says, and the confidence of those with hair: how well their map and coverage agree.
void CompleteCoverage(const ColourMap& map, const MapOutput& output, const HairCells& cells,
                      const Rect& tile);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_HAIR_COVERAGE_H_
