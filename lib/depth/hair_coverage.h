// SPDX-License-Identifier: Apache-2.0
// Finds the coverage of hair whose outline a map has closed, as maps of monocular networks have.
// Pyramids extend the pure colours of foreground and background to each pixel near an outline. The
// coverage is the position of the pixel's colour between the two. Called by RepairByColour.
#ifndef STARFOCUS_LIB_DEPTH_HAIR_COVERAGE_H_
#define STARFOCUS_LIB_DEPTH_HAIR_COVERAGE_H_

#include <cstdint>

#include "lib/depth/hair_job.h"
#include "lib/depth/phases.h"

namespace starfocus {

HairMemory TakeHairMemory(const EstimatePlan& plan, Arena* arena);

// Number of phases that FindHairCoverage runs or skips.
inline constexpr int32_t kHairPhases = 9;

// Marks the cells with hair and writes their coverage. *found is true if there are any. Returns the
// status of Phases::Run.
starfocus_status FindHairCoverage(const ColourMap& map, const MapOutput& output,
                                  const HairCells& cells, const HairMemory& memory, Phases* phases,
                                  bool* found);

// Completes a tile after its map is written. In cells without hair the coverage is 0 or 255,
// according to the map. In cells with hair the confidence is 255 minus the difference of the
// coverage from the map's 0 or 255.
void CompleteCoverage(const ColourMap& map, const MapOutput& output, const HairCells& cells,
                      const Rect& tile);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_HAIR_COVERAGE_H_
