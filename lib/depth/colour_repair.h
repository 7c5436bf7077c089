// SPDX-License-Identifier: Apache-2.0
// Repairs the disparity map of a single view by its colours: what the paper's section VII-A asks a
// bilateral weighted median for. Near steps and on ramps of the map the surfaces around compete for
// each pixel, by hue, saturation and brightness; noise is averaged within surfaces. Then nearer
// surfaces are widened where edges of the picture are soft, and outlines are evened.
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

// What a worker needs for a tile.
struct ColourTileMemory {
  ChoiceMemory choices;
  uint8_t* doubt;
  SmoothMemory* smooth;
};

// Maps have the picture's size, disparities kDisparityBits.
struct ColourMemory {
  JobSet jobs;
  int16_t* maps[3];  // the given one, of noise half smoothed, smoothed; later what is chosen
  int16_t* gain;     // how much less a pixel's choice costs than the map's, 0 where it is the same
  uint8_t* doubt;    // of MeasureDoubt
  uint8_t* certainty;  // how much more another surface costs than the chosen one, on each path
  TileCount* counts;   // of each tile
  SoftCount* soft;     // of each tile of the repaired map
  int32_t least_gain;  // that changes need
  ThinCells thin;      // of the map
  HairCells hair_cells;
  HairMemory hair;    // overlaps maps[1], maps[2] and the planes below
  bool has_coverage;  // output: the last call found coverage
  ColourTileMemory* workers;
};

// Lays out the memory at `base` (aligned to STARFOCUS_ALIGNMENT), or counts when base is null.
// Returns the bytes used, or kTooLarge. Of the plan only size and tiles are read, here and below.
size_t LayOutColourRepair(const EstimatePlan& plan, int32_t max_workers, void* base,
                          ColourMemory** memory);

// Repairs light_field.depth, of which one pixel at least is finite, into `output`, by the
// centre view alone. Pixels that no colour gainsays keep their disparity to the bit unless the map
// is noisy, or most pixels of its colour around are of another surface; unknown ones (NaN,
// infinite) get one. Confidence is 255 where nothing is in doubt, and 0 where colours gainsay the
// map too weakly or an outline was moved afterwards. If output.coverage is not null and the map
// has closed the outline of hair, the coverage of hair is written, memory->has_coverage is set, and
// disparities of hair stay (hair_coverage.h). Returns STARFOCUS_OK, STARFOCUS_ERROR_CANCELLED or
// STARFOCUS_ERROR_RUNNER.
starfocus_status RepairByColour(const EstimatePlan& plan, const starfocus_light_field& light_field,
                                const simd::DepthKernels& kernels, const MapOutput& output,
                                ColourMemory* memory);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_COLOUR_REPAIR_H_
