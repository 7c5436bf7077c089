// SPDX-License-Identifier: Apache-2.0
// Finds the superblocks that depend on pixels that differ between two light fields, for videos.
#ifndef STARFOCUS_LIB_ENGINE_FRAME_DIFF_H_
#define STARFOCUS_LIB_ENGINE_FRAME_DIFF_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/arena.h"
#include "lib/base/geometry.h"
#include "lib/base/jobs.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Comparison of two light fields. Rows are compared in order, starting at the first row that
// affects the region. The flags of a stripe and its neighbours are complete when all rows that
// affect these stripes have been compared.
struct FrameDiff {
  bool active = false;  // true if `before` points to the previous light field
  const starfocus_light_field *before, *now;
  const starfocus_image* picture;  // Previous picture, packed RGB: source of unchanged pixels.
  int32_t views;                   // Number of views to compare.
  int32_t width, height, side;     // Size of the picture, and side of a superblock, in pixels.
  int32_t columns;                 // Number of columns of superblocks.
  // Number of pixels around a block, in the centre view and in side views, on which the block may
  // depend.
  int32_t centre_reach, side_reach;
  bool fills;     // True if unknown disparities are filled along their row.
  int32_t rows;   // Number of rows compared so far.
  int32_t known;  // Number of stripes whose flags are initialised.
  // Ring of stripes with one flag per column: 1 if the superblock changed.
  uint8_t* flags = nullptr;
  int32_t stripes = 0;  // number of stripes in the ring

  uint8_t* Flags(int32_t stripe) const {
    return flags + static_cast<size_t>(stripe % stripes) * static_cast<size_t>(columns);
  }
};

// Allocates the flags of `columns` columns of superblocks. Input rows are compared up to `reach`
// rows below the next stripe. The compared rows flag stripes that start up to `reach` rows farther
// down. The ring of flags also keeps the flags of the previous stripe.
void TakeFrameDiff(int32_t columns, int32_t side, int32_t reach, Arena* arena, FrameDiff* changes);

// Restarts the comparison at the stripe that starts at row y.
void StartFrameDiff(int32_t y, FrameDiff* changes);

// Compares all rows that affect blocks of the stripe at row y, of the previous stripe, or of the
// next stripe. Returns STARFOCUS_OK or STARFOCUS_ERROR_CANCELLED.
starfocus_status CompareRows(int32_t y, CancelToken* cancel, FrameDiff* changes);

// Returns true if a superblock that overlaps `rect` has changed. The distance from `rect` to the
// stripe that was compared last must be less than the height of a stripe.
bool HasChanged(const FrameDiff& changes, const Rect& rect);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_FRAME_DIFF_H_
