// SPDX-License-Identifier: Apache-2.0
// Repairs the disparity map of a single view by its colours. The paper's section VII-A uses a
// bilateral weighted median for this purpose. Near steps and on ramps of the map, the surrounding
// surfaces compete for each pixel by hue, saturation and brightness. Noise is averaged within
// surfaces. Finally nearer surfaces are widened where edges of the picture are soft, and outlines
// are smoothed.
#ifndef STARFOCUS_LIB_DEPTH_COLOUR_REPAIR_H_
#define STARFOCUS_LIB_DEPTH_COLOUR_REPAIR_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/jobs.h"
#include "lib/depth/colour_choices.h"
#include "lib/depth/colour_smooth.h"
#include "lib/depth/estimate.h"
#include "lib/depth/evidence.h"
#include "lib/depth/hair_coverage.h"
#include "lib/depth/soft_edges.h"
#include "lib/depth/thin_cells.h"

namespace starfocus {

// Scratch memory of a worker for one tile.
struct ColourTileMemory {
  ChoiceMemory choices;
  uint8_t* doubt;
  SmoothMemory* smooth;
};

// Maps have the size of the picture and disparities in kDisparityBits.
struct ColourMemory {
  JobSet jobs;
  // The given map, the map after one pass of smoothing, and the smoothed map. Maps that are no
  // longer needed hold the results of later phases.
  int16_t* maps[3];
  // difference of the costs of the map's disparity and of the choice; 0 where they are equal
  int16_t* gain;
  uint8_t* doubt;  // result of MeasureDoubt
  // Difference of the costs, per path, of another surface and of the chosen one.
  uint8_t* certainty;
  TileCount* counts;   // of each tile
  SoftCount* soft;     // of each tile of the repaired map
  int32_t least_gain;  // smallest gain that a change needs
  ThinCells thin;      // thin structure of the map
  HairCells hair_cells;
  HairMemory hair;    // overlaps maps[1], maps[2] and the planes below
  bool has_coverage;  // output: the last call found coverage
  ColourTileMemory* workers;
};

// Lays out the memory at `base` (aligned to STARFOCUS_ALIGNMENT), or only counts it if base is
// null. Returns the bytes used, or kTooLarge. Only the size and the tiles of the plan are read,
// here and below.
size_t LayOutColourRepair(const EstimatePlan& plan, int32_t max_workers, void* base,
                          ColourMemory** memory);

// Repairs light_field.depth, which has at least one finite pixel, into `output`, using the centre
// view alone.
//
// Pixels that the colours do not contradict keep their disparity to the bit. Exceptions are noisy
// maps, and pixels most of whose neighbours of similar colour belong to another surface. Unknown
// pixels (NaN, infinite) get a disparity.
//
// Confidence is 255 where nothing is in doubt. It is 0 where colours contradict the map too weakly,
// or where an outline was moved afterwards.
//
// If output.coverage is not null and the map has closed the outline of hair, the coverage of hair
// is written and memory->has_coverage is set. Disparities of hair are not changed
// (hair_coverage.h). Returns STARFOCUS_OK, STARFOCUS_ERROR_CANCELLED or STARFOCUS_ERROR_RUNNER.
starfocus_status RepairByColour(const EstimatePlan& plan, const starfocus_light_field& light_field,
                                const simd::DepthKernels& kernels, const MapOutput& output,
                                ColourMemory* memory);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_COLOUR_REPAIR_H_
