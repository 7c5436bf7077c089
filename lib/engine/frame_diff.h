// SPDX-License-Identifier: Apache-2.0
// Which superblocks depend on pixels that differ between two light fields.
#ifndef STARFOCUS_LIB_ENGINE_FRAME_DIFF_H_
#define STARFOCUS_LIB_ENGINE_FRAME_DIFF_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/call_progress.h"
#include "lib/base/geometry.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Rows are compared from the first one that is needed to the last; blocks of a stripe and of those
// beside it are known once all rows within their reach are compared.
struct FrameDiff {
  bool active = false;  // there is something to compare with
  const starfocus_light_field *before, *now;
  int32_t views;                     // that matter
  int32_t width, height, side;       // of the picture and its superblocks
  int32_t columns;                   // of superblocks
  int32_t centre_reach, side_reach;  // pixels around a block that it may depend on
  bool fills;                        // whether unknown disparities are filled along their row
  int32_t rows;                      // compared so far
  int32_t known;                     // stripes whose flags are set up
  uint8_t* flags = nullptr;          // ring of stripes, by column: 1 where something changed
  int32_t stripes = 0;               // of the ring

  uint8_t* Flags(int32_t stripe) const {
    return flags + static_cast<size_t>(stripe % stripes) * static_cast<size_t>(columns);
  }
};

// Starts anew, for stripes from row y on.
void StartFrameDiff(int32_t y, FrameDiff* changes);

// Compares all rows that blocks of the stripe at row y, and of those before and after it, depend
// on. Returns STARFOCUS_OK or STARFOCUS_ERROR_CANCELLED.
starfocus_status CompareRows(int32_t y, CancelToken* cancel, FrameDiff* changes);

// Whether a superblock that has pixels in `rect`, or less than a stripe away from those last
// compared, has changed.
bool HasChanged(const FrameDiff& changes, const Rect& rect);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_FRAME_DIFF_H_
