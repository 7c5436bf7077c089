// SPDX-License-Identifier: Apache-2.0
// The memory of an estimate: maps of the whole picture, and what each worker needs for a tile. One
// routine sizes and carves it.
#ifndef STARFOCUS_LIB_DEPTH_ESTIMATE_MEMORY_H_
#define STARFOCUS_LIB_DEPTH_ESTIMATE_MEMORY_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/arena.h"
#include "lib/base/jobs.h"
#include "lib/depth/estimate_plan.h"
#include "lib/depth/evidence.h"
#include "lib/depth/thin_cells.h"
#include "simd/label_costs.h"

namespace starfocus {

// Rectangles of all views around a tile, one plane after the other; outside the picture its nearest
// pixels. Pixel (x, y) of the picture lies at (y - top) * stride + x - left of each plane.
struct TileViews {
  int32_t left, top, rows;
  size_t stride, plane;  // samples
  // Planes R, G, B of the centre, then of each side view in the plan's order: moved by the parts of
  // a pixel that labels move it by, those of EstimatePlan::Phases one after the other.
  uint8_t* rgb;
  uint8_t* split;  // two rows of R, G, B, while planes are made
  // Of each side view how many labels something nearer hides that it is known to show at a pixel,
  // simd::kViewEnds outside the picture.
  uint8_t* hidden;
  bool ends;      // not all of the rectangle lies in the picture
  bool all_seen;  // it does, and nothing is known to be hidden

  size_t At(int32_t x, int32_t y) const {
    return static_cast<size_t>(y - top) * stride + static_cast<size_t>(x - left);
  }
  // The centre's plane.
  const uint8_t* Centre(int32_t colour) const { return rgb + static_cast<size_t>(colour) * plane; }
};

// What a worker needs for one tile.
struct TileMemory {
  TileViews views;
  uint8_t* cost;          // of each pixel and label, PathLabels apart
  uint8_t* prior;         // as cost: what a given map says; null when there is none
  int16_t* sum;           // of paths, as cost
  int16_t* path[2];       // of a row of pixels, and one pixel more on both sides
  int16_t* least[2];      // of each of them, and one more on both sides
  int16_t* jump;          // of a row
  simd::ViewMove* moves;  // of each side view, for each label
  int16_t* choice;        // a row
  const uint8_t* swept;   // EstimateMemory::swept
};

struct EstimateMemory {
  JobSet jobs;
  int16_t* first;      // disparities of the whole picture, kDisparityBits: with all views trusted
  int16_t* second;     // those with hidden views left out
  uint8_t* certainty;  // of the second
  // Of a map that is repaired, null otherwise; kNoSurface where it is unknown.
  int16_t* given;     // its disparities
  int16_t* trusted;   // those of places where it is smooth
  uint8_t* doubt;     // which pixels are in doubt (swept.h): in certainty's memory, which is free
  uint8_t* swept;     // 1 where the sweeps look, 0 elsewhere; null: everywhere
  TileCount* counts;  // of each tile
  int32_t least_evidence;
  // How badly the views fit the given map and the second one; alike where nothing is given.
  uint8_t* given_cost;
  uint8_t* found_cost;
  ThinCells given_cells, found_cells;  // of the given map, and of what the sweeps found
  TileMemory* workers;
};

// Lays out the memory at `base` (aligned to STARFOCUS_ALIGNMENT), or counts when base is null.
// Returns the bytes used, or kTooLarge.
size_t LayOutEstimate(const EstimatePlan& plan, int32_t max_workers, void* base,
                      EstimateMemory** memory, const PieceVisitor* pieces = nullptr);

// Makes the red zones of the memory of an estimate or repair at `base` ones that nobody may touch,
// as long as the object lives (lib/base/arena.h).
class EstimateZones {
 public:
  EstimateZones(const EstimatePlan& plan, int32_t max_workers, void* base);
  ~EstimateZones();
  EstimateZones(const EstimateZones&) = delete;
  EstimateZones& operator=(const EstimateZones&) = delete;

 private:
  void Visit(const PieceVisitor& visitor) const;

  const EstimatePlan& plan_;
  int32_t max_workers_;
  void* base_;
};

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_ESTIMATE_MEMORY_H_
