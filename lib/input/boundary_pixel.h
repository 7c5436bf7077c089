// SPDX-License-Identifier: Apache-2.0
// Boundary pixels: on the far side of a depth edge a captured pixel is a mixture of both surfaces.
#ifndef STARFOCUS_LIB_INPUT_BOUNDARY_PIXEL_H_
#define STARFOCUS_LIB_INPUT_BOUNDARY_PIXEL_H_

#include <cstdint>

#include "lib/base/fixed.h"
#include "lib/input/block_pixels.h"
#include "lib/input/window.h"
#include "simd/kernels.h"

namespace starfocus {

// Pixels beyond a field that tell what the boundary pixels in it are made of.
inline constexpr int32_t kMixedPixelBorder = 1;

// Light of R, G and B.
struct Colour {
  int16_t rgb[3];

  int32_t operator[](int c) const { return rgb[c]; }
};

// The centre view at layer 0; beyond its edges it repeats them.
struct CentreView {
  const Window& window;

  int32_t Disparity(int32_t x, int32_t y) const {
    return window.disparity.Row(
        Clamp(y, 0, window.picture_height - 1))[Clamp(x, 0, window.picture_width - 1)];
  }
  // Light of a pixel, or its excess (window.is_excess).
  Colour ColourAt(int32_t x, int32_t y) const;
};

// A pixel and the depth edge beside it: a step of more than `step` up to `near`, kDisparityBits.
struct BoundaryPixel {
  int32_t x, y;
  int side;  // of kSides, where the nearer surface is
  int32_t disparity, near, step;
};

// What it is made of: how much of it is the nearer surface (kShareBits), and the colours of both. A
// share of 0: it is no mixture of them.
struct Mixture {
  int32_t share;
  Colour near, far;
};

// The near colour is that of the pixel behind the edge, or one pixel on where the surface goes on;
// the far one is read from the captured view beside the centre in which the nearer surface has
// moved out of the way; without such a view it is that of the pixel on the other side. Of a window
// of excess the share is that of light, and the colours are excess.
Mixture FindMixture(const CentreView& centre, const BoundaryPixel& pixel);

// Returns the share of `near` in a pixel of level 1 or 2, kShareBits. Filtered pixels differ by
// rounding, so the share fades to 0 where FindMixture's has limits: from twice the least contrast,
// between one and two times the largest distance from the line between both colours, and from 4/5
// to 1.
int32_t FadedShareOf(const Colour& near, const Colour& far, const Colour& mixed);

// Calls visit(column, row) for those pixels of a field that are farther away, by more
// than `step`, than one beside, above or below them; of those in the picture, but for the field's
// outermost ones.
template <class Visit>
void ForEachBesideEdge(const simd::Kernels& kernels, const Window& window, const BlockPixels& field,
                       int16_t step, const Visit& visit) {
  constexpr int32_t kStripColumns = static_cast<int32_t>(simd::kSliceLanes),
                    kAtOnce = 16 * kStripColumns;
  const int32_t left = Max(1, -field.x), right = Min(field.width - 1, window.width - field.x);
  const int32_t top = Max(1, -field.y), bottom = Min(field.height - 1, window.height - field.y);
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

#endif  // STARFOCUS_LIB_INPUT_BOUNDARY_PIXEL_H_
