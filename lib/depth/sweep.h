// SPDX-License-Identifier: Apache-2.0
// Sweeps over all labels at the pixels of a tile. A sweep measures how well each label fits the
// views, adds the prior of a given map, sums costs along paths from all directions of the setup,
// and chooses the disparity with the smallest sum for each pixel (semi-global matching).
#ifndef STARFOCUS_LIB_DEPTH_SWEEP_H_
#define STARFOCUS_LIB_DEPTH_SWEEP_H_

#include "lib/depth/maps.h"
#include "lib/depth/tile_views.h"

namespace starfocus {

// Scratch memory of a worker for one tile.
struct TileMemory {
  TileViews views;
  uint8_t* cost;  // cost of each label at each pixel; pixels are PathLabels apart
  // Cost added by the given map, in the layout of `cost`; null if no map is given.
  uint8_t* prior;
  int16_t* sum;           // Sums of path costs, in the layout of `cost`.
  int16_t* path[2];       // Path costs of a row of pixels, plus one pixel on each side.
  int16_t* least[2];      // Smallest path cost at each pixel of a row, plus one pixel on each side.
  int16_t* jump;          // Costs of a jump between labels at each pixel of a row (FindJumps).
  simd::ViewMove* moves;  // Movement of each side view for each label.
  int16_t* choice;        // Chosen label of each pixel of a row.
};
// Takes the memory of a worker for regions of at most the size of `region`.
TileMemory TakeTileMemory(const SweepSetup& setup, const Rect& region, Arena* arena);

// Light field, labels and memory of a sweep.
struct Sweep {
  const SweepSetup& setup;
  const starfocus_light_field& light_field;
  const simd::DepthKernels& kernels;
  const EstimateMemory& memory;
};

// Fills `disparity`, a map of the whole picture, for tile `index` from the views on one side of
// each pixel.
void SweepOneSide(const Sweep& sweep, int32_t index, int32_t worker, int16_t* disparity);
// Fills memory.second, `certainty` unless it is null, and, for a repair, the costs for tile
// `index`. Uses the views that see each pixel according to memory.side_maps if the views lie on
// one side, otherwise according to memory.first.
void SweepAllViews(const Sweep& sweep, int32_t index, int32_t worker, uint8_t* certainty);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_SWEEP_H_
