// SPDX-License-Identifier: Apache-2.0
// Separates boundary pixels at depth edges, which may be mixtures, into the colours of both
// surfaces.
#ifndef STARFOCUS_LIB_MATTING_BOUNDARY_PIXEL_H_
#define STARFOCUS_LIB_MATTING_BOUNDARY_PIXEL_H_

#include <cstdint>

#include "lib/base/fixed.h"
#include "lib/io/block_pixels.h"
#include "lib/io/input.h"
#include "simd/kernels.h"

namespace starfocus {

// Width in pixels of the border around a field that is read to separate the field's boundary
// pixels.
inline constexpr int32_t kMixedPixelBorder = 1;

// Linear light of the samples R, G and B of a pixel.
struct Colour {
  int16_t rgb[3];

  int32_t operator[](int c) const { return rgb[c]; }
};

// Reads the centre view at layer 0. Coordinates outside the picture read the nearest pixel inside.
struct CentreView {
  const Input& input;

  int32_t Disparity(int32_t x, int32_t y) const {
    return input.disparity.Row(Clamp(y, 0, input.height - 1))[Clamp(x, 0, input.width - 1)];
  }
  // Returns the light of a pixel, or the light beyond white (excess) if `input` reads excess.
  Colour ColourAt(int32_t x, int32_t y) const;
};

// A pixel next to a depth edge; the disparity beyond the edge, `near`, is larger by more than
// `step`. Disparities have kDisparityBits.
struct BoundaryPixel {
  int32_t x, y;
  int side;  // index into kSides: direction of the nearer surface
  int32_t disparity, near, step;
};

// Colour of a boundary pixel, and the colours of the two surfaces that it may mix.
struct BoundaryColours {
  Colour near, far, mixed;
};

// Result of the separation: the share of the nearer surface (kShareBits) and the colours of both
// surfaces. A share of 0 means that the pixel is not a mixture.
struct Mixture {
  int32_t share;
  Colour near, far;
};

// Separates a boundary pixel. The near colour is read at the second pixel beyond the edge, or at
// the first pixel if the two pixels are on different surfaces. The far colour comes from a captured
// side view in which the nearer surface does not cover the far surface. Without such a view, the
// far colour is the colour of the next pixel away from the edge. If the input reads excess,
// both colours are excess, but the share is computed from light.
Mixture FindMixture(const CentreView& centre, const BoundaryPixel& pixel);

// Separates a pixel by its colour and by the colours of both surfaces. Small changes of a colour
// change the result little: as the share falls to 0, the far colour becomes the colour of the
// pixel.
Mixture Unmix(const BoundaryColours& colours);

// Calls visit(column, row) for each pixel of a field if the disparity of one of its four neighbours
// is larger by more than `step`. Pixels outside the picture and the outermost pixels of the field
// are skipped.
template <class Visit>
void ForEachBesideEdge(const simd::Kernels& kernels, const Input& input, const BlockPixels& field,
                       int16_t step, const Visit& visit) {
  constexpr int32_t kStripColumns = static_cast<int32_t>(simd::kSliceLanes),
                    kAtOnce = 16 * kStripColumns;
  const int32_t left = Max(1, -field.x),
                right = Min(field.width - 1, input.Width(field.layer) - field.x);
  const int32_t top = Max(1, -field.y),
                bottom = Min(field.height - 1, input.Height(field.layer) - field.y);
  uint16_t beside[kAtOnce / kStripColumns];
  for (int32_t row = top; row < bottom; ++row) {
    for (int32_t from = left; from < right; from += kAtOnce) {
      const int32_t count = Min(kAtOnce, right - from);
      kernels.BesideSteps(field.Disparity(from, row), field.width, static_cast<size_t>(count), step,
                          beside);
      for (int32_t k = 0; k < count; k += kStripColumns) {
        ForEachBit(beside[k / kStripColumns], [&](int32_t bit) { visit(from + k + bit, row); });
      }
    }
  }
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_MATTING_BOUNDARY_PIXEL_H_
