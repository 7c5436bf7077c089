// SPDX-License-Identifier: Apache-2.0
// Inpaints hidden surfaces that no captured view shows: the farthest surface is continued smoothly
// behind a depth edge. The inpainting runs after FindLayeredDepth and SplitMixedPixels.
#ifndef STARFOCUS_LIB_SLICES_INPAINT_H_
#define STARFOCUS_LIB_SLICES_INPAINT_H_

#include <cstddef>
#include <cstdint>

#include "lib/slices/layered_depth.h"
#include "simd/kernels.h"

namespace starfocus {

// Memory of InpaintHidden for the farthest surface of each pixel. Rows of disparities are
// FillStride(width) samples apart. A row of colours consists of the planes R, G and B, which are
// also FillStride(width) samples apart. Each array starts kFillStep pixels before its first row.
// Arrays of samples end kFillStep pixels after their last row.
struct FillScratch {
  int16_t* disparity;  // Height rows.
  int16_t* rgb;        // Height rows.
  int16_t* saved;      // kFillStep + 1 rows with the colours before the current smoothing pass.
  uint16_t* source;    // Height rows, in the format of simd::FarRow.
  // Largest distance in pixels over which each row repeats colours, and the strips of kSliceLanes
  // pixels that repeat colours, one bit each; height elements.
  uint8_t* farthest;
  uint64_t* strips;
};

// Largest step of the fill, in pixels of the layer. Views hardly show pixels that are more than
// kFillStep pixels behind an edge. A gap of kFillStep pixels without a surface separates the rows,
// because a vector of kSliceLanes samples reads past the end of a row.
inline constexpr int32_t kFillStep = 16;
static_assert(kFillStep == static_cast<int32_t>(simd::kSliceLanes), "the gap between rows");

constexpr size_t FillStride(size_t width) {
  return simd::SliceSamples(width) + static_cast<size_t>(kFillStep);
}

// Replaces the colours that FindLayeredDepth repeated on the farthest surfaces. First, each
// repeated pixel takes the far colour of its source pixel. SplitMixedPixels may have separated the
// source's colour into a near and a far colour.
//
// The colours are then smoothed in five passes, with steps of 16, 8, 4, 2 and 1 pixels. A pass
// changes the pixels whose source is at least half a step away. The new colour is half of the
// pixel's colour plus an eighth of the colour of each of four neighbours. The four neighbours are
// one step to the left, right, top and bottom. If the farthest surface of a neighbour differs by
// more than one pixel of disparity, the pixel's own colour replaces the neighbour's colour. Last, a
// colour that differs much from those of both neighbours along the edge is limited (LimitFar),
// because a single odd source would show as a streak near the edge. After all passes, pixels near
// the edge have the colours next to the edge, and pixels far behind have the mean of these colours.
// The page docs/constants.md lists measurements of this continuation.
void InpaintHidden(const simd::Kernels& kernels, int32_t layer, const FillScratch& scratch,
                   LayeredDepth* surfaces);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_SLICES_INPAINT_H_
