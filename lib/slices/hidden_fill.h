// SPDX-License-Identifier: Apache-2.0
// What no captured view shows behind a depth edge: there the far surface goes on smoothly.
#ifndef STARFOCUS_LIB_SLICES_HIDDEN_FILL_H_
#define STARFOCUS_LIB_SLICES_HIDDEN_FILL_H_

#include <cstddef>
#include <cstdint>

#include "lib/slices/layered_depth.h"
#include "simd/kernels.h"

namespace starfocus {

// Memory of InpaintHidden for surfaces of a width and height: the farthest surface of each pixel.
// Rows of disparities lie FillStride(width) apart; a row of colours has R, G and B behind each
// other, as far apart. All start kFillStep pixels before the row's first one.
struct FillScratch {
  int16_t* disparity;  // height rows, and kFillStep pixels, as behind all of these
  int16_t* rgb;        // height rows
  int16_t* saved;      // kFillStep + 1 rows: as they were before a step
  uint16_t* source;    // height rows: as simd::FarRow has them
  uint8_t* farthest;   // height: the largest distance over which a row's colours are repeated
};

// The widest step of the fill, in pixels of the layer: what is farther away is hardly seen. Pixels
// of no surface as many lie between rows, since a group of kSliceLanes reads as far.
inline constexpr int32_t kFillStep = 16;
static_assert(kFillStep == static_cast<int32_t>(simd::kSliceLanes), "the gap between rows");

constexpr size_t FillStride(size_t width) {
  return simd::SliceSamples(width) + static_cast<size_t>(kFillStep);
}

// Replaces the colours that FindLayeredDepth repeated, of pixels' farthest surfaces. Each one first
// takes the far colour of the pixel that it repeats, which FindMatte may have parted from a
// mixture. Then, in steps of 16, 8, 4, 2 and 1 pixels, every one of them that is repeated over at
// least half a step takes the mean of itself, by half, and of its neighbours a step to the left,
// right, top and bottom, by an eighth each: of their farthest surfaces, if these are within a pixel
// of its disparity, else of itself. So colours beside the edge matter near it, and far from it the
// mean of what lies around. docs/constants.md tells what was measured.
void InpaintHidden(const simd::Kernels& kernels, int32_t layer, const FillScratch& scratch,
                   LayeredDepth* surfaces);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_SLICES_HIDDEN_FILL_H_
