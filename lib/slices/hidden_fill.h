// SPDX-License-Identifier: Apache-2.0
// Inpaints hidden surfaces that no captured view shows, by continuing the farthest surface smoothly
// behind a depth edge. Runs after FindLayeredDepth and FindMatte.
#ifndef STARFOCUS_LIB_SLICES_HIDDEN_FILL_H_
#define STARFOCUS_LIB_SLICES_HIDDEN_FILL_H_

#include <cstddef>
#include <cstdint>

#include "lib/slices/layered_depth.h"
#include "simd/kernels.h"

namespace starfocus {

// Memory of InpaintHidden for the farthest surface of each pixel. Rows of disparities are
// FillStride(width) apart. A row of colours holds the planes R, G and B, also FillStride(width)
// apart. Each array starts kFillStep pixels before its first row.
struct FillScratch {
  int16_t* disparity;  // height rows, and kFillStep more pixels after the last, as in all of these
                       // arrays
  int16_t* rgb;        // height rows
  int16_t* saved;      // kFillStep + 1 rows before the current step
  uint16_t* source;    // height rows, in the format of simd::FarRow
  uint8_t* farthest;   // height: largest distance over which a row repeats colours
};

// Largest step of the fill, in pixels of the layer. Views hardly show pixels farther behind an
// edge. Rows are separated by as many pixels without a surface, since a vector of kSliceLanes reads
// past a row's end.
inline constexpr int32_t kFillStep = 16;
static_assert(kFillStep == static_cast<int32_t>(simd::kSliceLanes), "the gap between rows");

constexpr size_t FillStride(size_t width) {
  return simd::SliceSamples(width) + static_cast<size_t>(kFillStep);
}

// Replaces the colours of the farthest surfaces that FindLayeredDepth repeated. Each such pixel
// first takes the far colour of the pixel that it repeats, which FindMatte may have separated from
// a mixture.
//
// The colours are then smoothed in steps of 16, 8, 4, 2 and 1 pixels. A step changes the pixels
// that are repeated over at least half a step. Such a pixel becomes half of itself plus an eighth
// of each neighbour one step to the left, right, top and bottom. A neighbour counts if its farthest
// surface is within a pixel of the same disparity; otherwise the pixel itself replaces it. Near the
// edge the colours beside the edge dominate, and far from it their mean does. docs/constants.md
// lists the measurements.
void InpaintHidden(const simd::Kernels& kernels, int32_t layer, const FillScratch& scratch,
                   LayeredDepth* surfaces);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_SLICES_HIDDEN_FILL_H_
