// The primitive of cells: one rectangle of the picture refocused as a stack of slices, which each
// view of the aperture shows moved against each other, the nearer in front of the farther.
#ifndef STARFOCUS_LIB_STACK_H_
#define STARFOCUS_LIB_STACK_H_

#include <cstddef>
#include <cstdint>

#include "lib/cells.h"
#include "lib/placed_slice.h"
#include "lib/star.h"

namespace starfocus {

// Parts of a rectangle, this high and kSliceLanes wide, that see slices of their own.
inline constexpr int32_t kPartRows = 8;
struct StackPart {
  int32_t x, y, rows;  // in the rectangle
  int32_t count;       // slices seen
  uint8_t shown[kMaxSlices];
};

// Of the light of a pixel: R, G, B and what is covered.
inline constexpr size_t kPixelSums = 4;

// Views of a column that are summed in 16 bits: all of those that cells need.
inline constexpr int32_t kGroupViews = 81;

// Memory of one worker. E and R: largest side of an extended rectangle and of a rectangle; N; G:
// the smaller of 2 N + 1 and kGroupViews.
struct StackScratch {
  Surfaces surfaces;         // E^2 each
  uint8_t* bins;             // kSliceBins
  int32_t* least_blur;       // E
  simd::SliceCover* covers;  // kMaxSlices E
  int32_t cover_rows;        // E
  int16_t* planes;           // of all slices
  size_t plane_samples;      // that fit
  int16_t* filtered;         // SliceSize(R, R, E - R)
  int16_t* tile;             // of all slices
  uint8_t* tile_near;        // of each row of it, and kRowsAhead before
  size_t tile_rows;          // that fit
  SliceOffset* offsets;      // kMaxSlices (2 N + 1)
  simd::SliceShift* shifts;  // kMaxSlices (2 N + 1)
  int16_t* weights;          // G
  StackPart* parts;          // of a rectangle
  uint32_t* sums;            // kPixelSums of the pixels of a tile
};

// Parts of the largest rectangle.
constexpr size_t StackParts(size_t side) {
  return (side + kPartRows - 1) / kPartRows * (simd::SliceSamples(side) / simd::kSliceLanes);
}

// As RefocusRectangle, by slices cut as `rule` says, of what is not `gathered` (null: of all; at
// layer 0). `field`: for the extended rectangle, with memory set. Returns the pixels rendered in
// each view, over all slices.
uint64_t RefocusStack(const StarJob& job, const SliceRule& rule, const GatherMap* gathered,
                      Field* field, StackScratch* scratch, uint32_t* accumulators);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_STACK_H_
