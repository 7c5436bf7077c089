// SPDX-License-Identifier: Apache-2.0
// Memory of an estimate: maps of the whole picture, and scratch memory of each worker for one tile.
// LayOutEstimate computes its size and divides it.
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

// Rectangles of all views around a tile, one plane after another. Outside the picture the nearest
// pixels are repeated. Pixel (x, y) of the picture is at (y - top) * stride + x - left of each
// plane.
struct TileViews {
  int32_t left, top, rows;
  size_t stride, plane;  // samples
  // Planes R, G, B of the centre view, then of each side view in the order of the plan. Side views
  // are shifted by the fractions of a pixel that labels move them by, with one set of planes for
  // each of EstimatePlan::Phases.
  uint8_t* rgb;
  uint8_t* split;  // two rows of R, G, B, used while planes are made
  // For each pixel of each side view, the number of lowest labels that a nearer surface hides
  // there; simd::kViewEnds outside the picture.
  uint8_t* hidden;
  bool ends;      // part of the rectangle lies outside the picture
  bool all_seen;  // all of it lies inside, and nothing is known to be hidden

  size_t At(int32_t x, int32_t y) const {
    return static_cast<size_t>(y - top) * stride + static_cast<size_t>(x - left);
  }
  // Returns the plane of a colour of the centre view.
  const uint8_t* Centre(int32_t colour) const { return rgb + static_cast<size_t>(colour) * plane; }
};

// Scratch memory of a worker for one tile.
struct TileMemory {
  TileViews views;
  uint8_t* cost;          // of each pixel and label; pixels are PathLabels apart
  uint8_t* prior;         // cost by the given map, laid out like `cost`; null if no map is given
  int16_t* sum;           // sums of paths, laid out like `cost`
  int16_t* path[2];       // of a row of pixels, and one more pixel on both sides
  int16_t* least[2];      // smallest cost of each path, and one more on both sides
  int16_t* jump;          // one row
  simd::ViewMove* moves;  // of each side view, for each label
  int16_t* choice;        // one row
  const uint8_t* swept;   // EstimateMemory::swept
};

struct EstimateMemory {
  JobSet jobs;
  // Result of the first sweep, in which no view counts as hidden; disparities of the whole picture,
  // kDisparityBits. A repair later stores its evened map here.
  int16_t* first;
  int16_t* second;     // result of the second sweep, without hidden views
  uint8_t* certainty;  // certainty of the second sweep
  // The members below are for repairs, and null otherwise. Unknown disparities are kNoSurface.
  int16_t* given;    // given disparities
  int16_t* trusted;  // given disparities where the map is smooth
  // pixels in doubt (swept.h); shares the memory of `certainty`, which is unused then
  uint8_t* doubt;
  uint8_t* swept;     // 1 where the sweeps process pixels, otherwise 0; null: everywhere
  TileCount* counts;  // of each tile
  int32_t least_evidence;
  // Costs of the given map and of the second sweep's map; equal where nothing is given.
  uint8_t* given_cost;
  uint8_t* found_cost;
  // thin structure of the given map, and of the result of the sweeps
  ThinCells given_cells, found_cells;
  TileMemory* workers;
};

// Lays out the memory at `base` (aligned to STARFOCUS_ALIGNMENT), or only counts it if base is
// null. Returns the bytes used, or kTooLarge.
size_t LayOutEstimate(const EstimatePlan& plan, int32_t max_workers, void* base,
                      EstimateMemory** memory, const PieceVisitor* pieces = nullptr);

// Poisons the red zones in the memory of an estimate or repair at `base` for the lifetime of this
// object (lib/base/arena.h).
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
