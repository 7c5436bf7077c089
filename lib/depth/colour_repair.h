// SPDX-License-Identifier: Apache-2.0
// Repairs the disparity map of a single view using the colours of the view. The paper repairs maps
// with a bilateral weighted median (VII-A). Here, noise is reduced by averaging disparities within
// surfaces, and outlines of the map follow the outlines of the picture (lib/depth/outlines.h).
#ifndef STARFOCUS_LIB_DEPTH_COLOUR_REPAIR_H_
#define STARFOCUS_LIB_DEPTH_COLOUR_REPAIR_H_

#include <cstdint>

#include "lib/depth/maps.h"
#include "lib/depth/outlines.h"
#include "lib/matting/hair_coverage.h"

namespace starfocus {

struct ColourMemory {
  Jobs* jobs;
  OutlineMemory outlines;
  ThinPatches thin;  // Thin structure of the map, whose disparities are kept.
  HairMemory hair;
  int32_t* rings;   // rows that are smoothed, of all workers
  uint32_t* noise;  // numbers of differences that the workers have counted
};

// Takes the memory of a repair by colour. TakeColourRepair and RepairByColour read only the size
// and the tiles of `setup`, which must outlive the memory.
ColourMemory TakeColourRepair(const SweepSetup& setup, int32_t max_workers, Arena* arena);

// Converts rows of light_field.depth to fixed point (kDisparityBits). A pixel that is not finite
// gets the disparity of the nearest finite pixel in its row. If two finite pixels are equally near,
// the smaller disparity is copied. Rows without a finite pixel remain unknown.
void ReadRows(const SweepSetup& setup, const starfocus_light_field& light_field, const Range& rows,
              int16_t* disparity);

// Copies rows without a finite pixel from the nearest row with a finite pixel. If two rows are
// equally near, the smaller disparities are copied. At least one row must have a finite pixel. Call
// FillUnknownRows after ReadRows has read all rows.
void FillUnknownRows(const SweepSetup& setup, int16_t* disparity);

// Repairs light_field.depth using the colours of the centre view, and writes the result to
// `output`. At least one pixel of light_field.depth must be finite.
//
// Pixels away from outlines keep their disparity exactly, unless the map is noisy. Unknown pixels
// (NaN or infinite) get a disparity. A map with sharp outlines that the colours hardly contradict
// is kept exactly.
//
// The confidence is 255 at pixels away from outlines. Near outlines, it is how clearly the colours
// decide for one side, and 0 if they contradict the map, but too weakly for a change.
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
