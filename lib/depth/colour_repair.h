// SPDX-License-Identifier: Apache-2.0
// Repairs the disparity map of a single view using the colours of the view. The paper repairs maps
// with a bilateral weighted median (VII-A). First, disparities are averaged within surfaces to
// reduce noise. Near steps and on ramps of the map, each pixel is assigned to the surrounding
// surface that best matches the pixel's hue, saturation and brightness. Finally, nearer surfaces
// are widened if edges of the picture are soft, and outlines are smoothed.
#ifndef STARFOCUS_LIB_DEPTH_COLOUR_REPAIR_H_
#define STARFOCUS_LIB_DEPTH_COLOUR_REPAIR_H_

#include <cstdint>

#include "lib/depth/colour_choices.h"
#include "lib/depth/maps.h"
#include "lib/depth/outlines.h"
#include "lib/matting/hair_coverage.h"

namespace starfocus {

// Scratch memory of a worker for one tile.
struct ColourTileMemory {
  ChoiceMemory choices;
  uint8_t* doubt;
  int32_t* ring;    // SmoothTile
  uint32_t* noise;  // CountNoise of the rows that the worker has counted
};

// Memory of a repair by colour. All maps have the size of the picture, and disparities are in fixed
// point (kDisparityBits).
struct ColourMemory {
  Jobs* jobs;
  int16_t* given;  // The given map. If it is noisy, later the repaired map.
  // Disparities chosen for doubtful pixels. Before that, the map after one pass of smoothing; after
  // that, the widened map.
  int16_t* chosen;
  int16_t* smooth;  // The smoothed map. If the given map is not noisy, the repaired map.
  // For each pixel, cost of the map's disparity minus the cost of the chosen disparity; 0 if both
  // disparities are on one surface.
  int16_t* gain;
  uint8_t* doubt;     // result of MeasureDoubt
  TileCount* counts;  // One element for each tile.
  SoftCount* soft;    // One element for each tile of the repaired map.
  ThinCells thin;     // Thin structure of the map.
  CellRanges ranges;  // Disparities of the repaired map.
  HairMemory hair;
  ColourTileMemory* workers;
};

// Takes the memory of a repair by colour. TakeColourRepair and RepairByColour read only the size
// and the tiles of `setup`.
ColourMemory TakeColourRepair(const SweepSetup& setup, int32_t max_workers, Arena* arena);

// Repairs light_field.depth using the colours of the centre view, and writes the result to
// `output`. At least one pixel of light_field.depth must be finite.
//
// A pixel keeps its disparity exactly if the colours do not contradict the map at the pixel. Even
// without contradiction, noisy maps are smoothed, and a pixel may change if most neighbours of
// similar colour belong to another surface. Unknown pixels (NaN or infinite) get a disparity.
//
// The confidence is 255 at pixels without doubt. The confidence is 0 if the colours contradict the
// map, but too weakly for a change. At pixels changed by the widening or smoothing of outlines, the
// confidence is 0.
//
// If output.coverage is not null and the map shows hair as a solid shape, the function writes the
// coverage of the hair and sets *has_coverage to true, otherwise to false. Disparities of hair are
// not changed (hair_coverage.h). Returns STARFOCUS_OK, STARFOCUS_ERROR_CANCELLED or
// STARFOCUS_ERROR_RUNNER.
starfocus_status RepairByColour(const SweepSetup& setup, const starfocus_light_field& light_field,
                                const simd::DepthKernels& kernels, const MapOutput& output,
                                const ColourMemory& memory, bool* has_coverage);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_COLOUR_REPAIR_H_
