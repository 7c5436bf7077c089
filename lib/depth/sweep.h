// SPDX-License-Identifier: Apache-2.0
// Sweeps over all labels at the pixels of a tile. A sweep loads the views around the tile
// (tile_views.cc), measures how well each label fits the views, adds the prior of a given map, sums
// costs along paths from all directions of the setup, and chooses the disparity with the smallest
// sum for each pixel (semi-global matching).
#ifndef STARFOCUS_LIB_DEPTH_SWEEP_H_
#define STARFOCUS_LIB_DEPTH_SWEEP_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/arena.h"
#include "lib/depth/maps.h"
#include "lib/depth/setup.h"
#include "simd/kernels.h"

namespace starfocus {

// A surface hides a pixel of a view if the surface is nearer by more than kSurfaceDepth
// (kDisparityBits). Estimated disparities of one surface differ by less than kSurfaceDepth.
inline constexpr int32_t kSurfaceDepth = 1 << kDisparityBits;

// The pixels of all views around a tile, as consecutive planes. Outside the picture, the nearest
// pixels of the picture are repeated. In each plane, pixel (x, y) of the picture has index (y -
// top) * stride + (x - left).
struct TileViews {
  int32_t left, top, rows;
  size_t stride, plane;  // distance in samples between rows, and between planes
  // Planes R, G and B of the centre view, followed by the planes of each side view in the order of
  // the setup. Labels shift side views by fractions of a pixel. Each side view has one set of
  // planes per fraction (SweepSetup::PhasesOf).
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
// Takes the memory of the views around rectangles of at most the size of `bordered`.
TileViews TakeTileViews(const SweepSetup& setup, const Rect& bordered, Arena* arena);

// Makes the planes of all views. The planes cover `bordered` and the pixels around it to which
// labels can move pixels of the bordered tile.
void LoadTileViews(const SweepSetup& setup, const starfocus_light_field& light_field,
                   const Rect& bordered, const simd::DepthKernels& kernels, TileViews* views);

// Computes, for each label and each side view, the movement of a pixel as an offset in the planes.
void FindMoves(const SweepSetup& setup, const TileViews& views, simd::ViewMove* moves);

// Sets views->hidden to simd::kViewEnds outside the picture, and to 0 (no hidden labels) inside.
// The first sweep uses MarkOutside.
void MarkOutside(const SweepSetup& setup, TileViews* views);

// Marks the labels that the surfaces in the maps of the side views hide. `side_maps` contains the
// maps in the order of the setup.
void MarkHiddenInMaps(const SweepSetup& setup, const int16_t* side_maps, TileViews* views);

// Marks the labels that the pixels of a map hide in the views, at all positions to which pixels of
// the bordered tile can move. `map` has width * height disparities.
void MarkHidden(const SweepSetup& setup, const int16_t* map, const Rect& bordered,
                TileViews* views);

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
// Takes the memory of a worker for rectangles of at most the size of `bordered`.
TileMemory TakeTileMemory(const SweepSetup& setup, const Rect& bordered, Arena* arena);

// Light field, labels and memory of a sweep.
struct Sweep {
  const SweepSetup& setup;
  const starfocus_light_field& light_field;
  const simd::DepthKernels& kernels;
  const EstimateMemory& memory;
};

// Fills `disparity`, a map of the whole picture, and `certainty`, unless it is null, for tile
// `index`. If `one_side` is true, uses the views on one side of each pixel. Otherwise, uses the
// views that see the pixel, according to memory.side_maps if the views lie on one side, or else
// according to memory.first; `disparity` must then be memory.second, and a repair also gets the
// costs of the tile.
void SweepTile(const Sweep& sweep, bool one_side, int32_t index, int32_t worker, int16_t* disparity,
               uint8_t* certainty);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_SWEEP_H_
