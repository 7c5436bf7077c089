// SPDX-License-Identifier: Apache-2.0
// Finds contaminated rims in pictures with one view. Pixels of the far surface next to an outline
// may have a halo if the picture was sharpened, or light of the near surface if the picture is soft
// or the outline of the map lies inside the object. Behind a blurred object, such a rim would show
// as a sharp outline. Ray-traced pictures have no rims: their pixels are clean from the second
// pixel on.
#ifndef STARFOCUS_LIB_MATTING_RIMS_H_
#define STARFOCUS_LIB_MATTING_RIMS_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/arena.h"
#include "lib/base/config.h"
#include "lib/base/fixed.h"
#include "lib/base/geometry.h"
#include "lib/base/jobs.h"
#include "lib/io/input.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Side of a patch in pixels, and the number of patches on each side that decide together with a
// patch.
inline constexpr int32_t kRimPatch = 8, kRimAround = 2;
// Largest width of a rim in pixels. A line across an outline is clean from the distance
// kRimWidth + 1 to the distance kRimEnd.
inline constexpr int32_t kRimWidth = 4, kRimEnd = 8;
// Smallest step of disparity at an outline with a rim, kDisparityBits.
inline constexpr int32_t kRimStep = 3 << kDisparityBits;
// Number of pixels around a pixel on which its rim depends: the patches around its patch, and the
// lines across their outlines.
inline constexpr int32_t kRimBorder = (kRimAround + 1) * kRimPatch - 1 + kRimEnd - 1;

// Sums over the lines that cross the outlines in a patch, along rows and columns. A line belongs to
// the patch of its far pixel next to the outline. Element k of an array belongs to the far pixel at
// a distance of k + 1 pixels. Colours are differences from the mean colour of the clean pixels of
// the line, in units of white / (8 * 255).
template <class Sum, class Squares>
struct RimSumsOf {
  Sum excess[kRimWidth][3];    // sums of differences
  Squares squares[kRimWidth];  // sums of squared differences, of three channels
  Sum count[kRimWidth];        // number of pixels to which no other outline is nearer
  Sum near[3];                 // differences of the near surface
  Sum slope[3];                // first clean pixel minus last clean pixel
  Sum lines;                   // number of lines
};
using RimSums = RimSumsOf<int32_t, uint32_t>;

// The rim in a patch.
struct PatchRim {
  uint8_t weight[kRimWidth];     // from 0 for clean pixels to kWholeRim for pixels of a rim
  int16_t excess[kRimWidth][3];  // mean light that the rim adds to the far surface

  bool IsEmpty() const { return weight[0] == 0; }
};
inline constexpr int32_t kWholeRim = 255;

// Patches of the rows that the blocks of a stripe read: a ring of `rows` rows of patches.
struct RimMap {
  int32_t width = 0, height = 0;  // size of the picture
  int32_t columns = 0, rows = 0;  // number of patches in a row; number of rows in memory
  RimSums* sums = nullptr;
  PatchRim* rims = nullptr;
  // First rows of patches of which the sums and the rims are not known yet; -1 before the first
  // row.
  int32_t summed = -1, found = -1;

  int32_t Rows() const { return (height + kRimPatch - 1) / kRimPatch; }
  size_t At(int32_t column, int32_t row) const {
    return static_cast<size_t>(row % rows) * static_cast<size_t>(columns) +
           static_cast<size_t>(column);
  }
  // Returns the rim in the patch of pixel (x, y).
  const PatchRim& RimAt(int32_t x, int32_t y) const {
    return rims[At(x / kRimPatch, y / kRimPatch)];
  }
};

// Returns true if an engine of this configuration finds rims: with one view, because side views
// show clean far colours, and with STARFOCUS_FEATURE_COVERAGE.
inline bool HasRims(const FullConfig& config) {
  return config.views == 1 && Has(config, STARFOCUS_FEATURE_COVERAGE);
}

// Allocates the patches for stripes whose blocks read `border` rows above and below.
void TakeRims(const FullConfig& config, int32_t border, Arena* arena, RimMap* map);

// Forgets all rows, so that FindRims starts anew.
void ForgetRims(RimMap* map);

// Finds the rims in `rows` of the picture. Rows beyond the picture are ignored. Stripes must follow
// each other from top to bottom. Returns STARFOCUS_OK, STARFOCUS_ERROR_RUNNER or
// STARFOCUS_ERROR_CANCELLED.
starfocus_status FindRims(const FullConfig& config, const Input& input, const Range& rows,
                          Jobs* jobs, RimMap* map);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_MATTING_RIMS_H_
