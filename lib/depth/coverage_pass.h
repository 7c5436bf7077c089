// SPDX-License-Identifier: Apache-2.0
// Finds the coverage of a whole picture, in job sets over tiles. Thin structure, such as hair, is
// sought in a wide band inside of the outlines of the map. Elsewhere only pixels near the outlines
// may be mixtures.
#ifndef STARFOCUS_LIB_DEPTH_COVERAGE_PASS_H_
#define STARFOCUS_LIB_DEPTH_COVERAGE_PASS_H_

#include <cstdint>

#include "lib/base/jobs.h"
#include "lib/depth/coverage.h"

namespace starfocus {

// Side of the cells that are thin or not, in pixels.
inline constexpr int32_t kThinCell = 16;

// Pixels of a tile whose colours decide without the map.
struct EdgeCount {
  int32_t agrees;   // beside a step, on the side of the map
  int32_t differs;  // beside a step, on the other side
  int32_t steps, ramps;
  int32_t trusted;  // beside a step, with colours that tell the surfaces apart
};

struct CoverageMemory {
  MapLevels levels;
  uint8_t *first, *wide, *narrow;  // coverage
  uint8_t *trust, *narrow_trust;
  int16_t* alike[2];  // disparities of the far and the near pixel around that are most alike
  uint8_t* thin;      // of each cell: 1 if it holds thin structure
  uint8_t* mixed;     // of each cell: mean of 4 a (1 - a) over its pixels
  EdgeCount* counts;  // of each tile
  bool exact;         // no colours contradict the steps of the map
  bool sure;          // colours decide on many of its steps
  LevelsScratch* level_scratch;  // of each worker
  CoverageScratch* scratch;      // of each worker
};

// Carves the memory of the planes and of `max_workers` workers.
CoverageMemory TakeCoverage(const EstimatePlan& plan, int32_t max_workers, Carver* carver);

// Coverage of one pixel of the result.
struct PixelCoverage {
  bool is_mixed;  // colours decide; otherwise the map does
  bool is_thin;
  uint8_t coverage, trust;
};

// Returns whether a pixel lies near much thin structure.
bool IsNearThin(const EstimatePlan& plan, const CoverageMemory& memory, int32_t x, int32_t y);

PixelCoverage CoverageAt(const EstimatePlan& plan, const CoverageMemory& memory, int32_t x,
                         int32_t y);

// Number of job sets that FindAllCoverage runs.
inline constexpr int32_t kCoverageParts = 5;

// Fills the memory from a map. Parts [first_part, ...) of `parts` are reported to the watch.
sf_status FindAllCoverage(const ColourMap& map, const Runner& runner, int32_t first_part,
                          int32_t parts, JobSet* jobs, CoverageMemory* memory);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_COVERAGE_PASS_H_
