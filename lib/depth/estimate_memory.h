// SPDX-License-Identifier: Apache-2.0
// Memory of an estimate: maps of the whole picture, and scratch memory of each worker for one tile.
// LayOutEstimate computes the size of the memory and divides the memory into arrays.
#ifndef STARFOCUS_LIB_DEPTH_ESTIMATE_MEMORY_H_
#define STARFOCUS_LIB_DEPTH_ESTIMATE_MEMORY_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/arena.h"
#include "lib/base/jobs.h"
#include "lib/depth/evidence.h"
#include "lib/depth/setup.h"
#include "lib/depth/thin_cells.h"
#include "simd/label_costs.h"

namespace starfocus {

// The pixels of all views around a tile, as consecutive planes. Outside the picture, the nearest
// pixels of the picture are repeated. In each plane, pixel (x, y) of the picture has index (y -
// top) * stride + (x - left).
struct TileViews {
  int32_t left, top, rows;
  size_t stride, plane;  // distance in samples between rows, and between planes
  // Planes R, G and B of the centre view, followed by the planes of each side view in the order of
  // the plan. Labels shift side views by fractions of a pixel. Each side view has one set of planes
  // per fraction (EstimatePlan::Phases).
  uint8_t* rgb;
  uint8_t* split;  // scratch memory for making planes: two rows of R, G and B
  // Number of labels that a nearer surface hides, for each pixel of each side view. The hidden
  // labels are always the lowest labels. For pixels outside the picture, the value is
  // simd::kViewEnds.
  uint8_t* hidden;
  bool ends;      // True if a part of the planes lies outside the picture.
  bool all_seen;  // True if the planes lie inside the picture and no hidden labels are known.

  size_t At(int32_t x, int32_t y) const {
    return static_cast<size_t>(y - top) * stride + static_cast<size_t>(x - left);
  }
  // Returns the plane of a colour of the centre view.
  const uint8_t* Centre(int32_t colour) const { return rgb + static_cast<size_t>(colour) * plane; }
};

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
  const uint8_t* swept;   // Equal to EstimateMemory::swept.
};

struct EstimateMemory {
  Jobs jobs;
  // Disparities of the whole picture after the first sweep, which ignores occlusion, in fixed point
  // (kDisparityBits). After the sweeps, a repair stores the result of EvenOut in `first`.
  int16_t* first;
  int16_t* second;     // Disparities after the second sweep, which omits hidden views.
  uint8_t* certainty;  // Certainty of the second sweep.
  // If the views lie on one side: the disparity maps of the side views, in the order of the plan.
  // Each map has the size of the picture. Otherwise null.
  int16_t* side_maps;
  // `given` and all later arrays of this structure are for repairs, and null for estimates. Unknown
  // disparities are kNoSurface.
  int16_t* given;    // Given disparities.
  int16_t* trusted;  // Given disparities at trusted pixels; kNoSurface at all other pixels.
  // Marks of pixels in doubt (swept.h). `doubt` shares the memory of `certainty`; at most one of
  // the two is in use at a time.
  uint8_t* doubt;
  uint8_t* swept;     // 1 for pixels that the sweeps process, else 0; null if all pixels are swept.
  TileCount* counts;  // One element for each tile.
  int32_t least_evidence;
  // Cost of each pixel's disparity in the given map and in the map of the second sweep. The two
  // costs are equal at pixels without a given disparity.
  uint8_t* given_cost;
  uint8_t* found_cost;
  // Thin structure of the given map and of the result of the sweeps.
  ThinCells given_cells, found_cells;
  TileMemory* workers;
};

// Returns the map of side view k in memory.side_maps.
inline int16_t* SideMap(const EstimatePlan& plan, const EstimateMemory& memory, int32_t k) {
  return memory.side_maps + ptrdiff_t{k} * plan.width * plan.height;
}

// Lays out the memory at `base`, which must be aligned to STARFOCUS_ALIGNMENT. If `base` is null,
// only computes the size. Returns the number of bytes used, or kTooLarge.
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
