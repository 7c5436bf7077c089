// SPDX-License-Identifier: Apache-2.0
// Splits the mixed pixels of a field into the two surfaces that each pixel mixes: boundary pixels
// at depth edges, from their colours, and pixels of thin structures, from the coverage map.
// Renderers apply the split.
#ifndef STARFOCUS_LIB_MATTING_MIXED_PIXELS_H_
#define STARFOCUS_LIB_MATTING_MIXED_PIXELS_H_

#include <cstdint>
#include <cstring>

#include "lib/base/fixed.h"
#include "lib/io/block_pixels.h"
#include "lib/io/input.h"
#include "lib/matting/colour.h"
#include "lib/matting/coverage.h"
#include "lib/matting/rims.h"
#include "lib/optics/view_grid.h"
#include "simd/kernels.h"

namespace starfocus {

// Width in pixels of the border around a field that is read to separate the field's boundary
// pixels.
inline constexpr int32_t kMixedPixelBorder = 1;

// Reads the centre view of a picture, or, with a field, of the field's layer. At layer 0, light is
// copied from the field if possible, because reading the picture is slower. Pixels outside the
// picture, whose light in the field is that of side views, have the light and the disparity of the
// nearest pixel inside. At other layers, this holds for pixels outside the field.
class CentreView {
 public:
  explicit CentreView(const Input& input, const BlockPixels* field = nullptr);

  const Input& input() const { return input_; }
  // At layer 0, the pixels of the picture in the field.
  const Rect& copied() const { return copied_; }
  int layer() const { return layer_; }
  int32_t Disparity(int32_t x, int32_t y) const {
    return layer_ == 0
               ? input_.disparity.Row(Clamp(y, 0, input_.height - 1))[Clamp(x, 0, input_.width - 1)]
               : *field_->Disparity(Column(x), Row(y));
  }
  // Returns the light of a pixel, or the light beyond white (excess) if the input reads excess.
  Colour ColourAt(int32_t x, int32_t y) const {
    Colour colour;
    if (layer_ == 0 && !Contains(copied_, x, y)) {
      input_.Light(0, Clamp(x, 0, input_.width - 1), Clamp(y, 0, input_.height - 1), 1, colour.rgb);
    } else {
      std::memcpy(colour.rgb, field_->Rgb(Column(x), Row(y)), sizeof(colour.rgb));
    }
    return colour;
  }

 private:
  int32_t Column(int32_t x) const { return Clamp(x - field_->x, 0, field_->width - 1); }
  int32_t Row(int32_t y) const { return Clamp(y - field_->y, 0, field_->height - 1); }

  const Input& input_;
  const BlockPixels* const field_;
  const int layer_;
  Rect copied_ = {0, 0, 0, 0};
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

// Range of the squared distances between the near and the far colour over which the share of a
// mixture rises from 0, in squares of white / 255. The paper's renderer has a smaller range: noise
// of one code then changes shares at low contrast by up to a third.
inline constexpr int32_t kContrastFade = 1024, kPaperContrastFade = 64;

// Separates pixel (x, y) of the layer, which is next to a depth edge: the disparity `near` on its
// side `side` (an index into kSides) is larger than its own by more than `step`. The near colour is
// read at the second pixel beyond the edge, or at the first pixel if the two pixels are on
// different surfaces. The far colour comes from a captured side view in which the nearer surface
// does not cover the far surface. Without such a view, the far colour is the colour of the next
// pixel away from the edge. If the input reads excess, both colours are excess, but the share is
// computed from light.
Mixture FindMixture(const CentreView& centre, int32_t x, int32_t y, int side, int32_t disparity,
                    int32_t near, int32_t step, int32_t contrast_fade);

// Separates a pixel by the light of the pixel and of both surfaces into the colours `shown`, which
// are light or excess. Small changes of a colour change the result little: as the share falls to 0,
// the far colour becomes the colour of the pixel.
Mixture Unmix(const BoundaryColours& light, int32_t contrast_fade, const BoundaryColours& shown);

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

// A pixel of a field that the slice renderer splits.
struct SplitPixel {
  enum Kind {
    kBoundary,   // A mixed pixel at a depth edge. Surfaces behind its far surface are kept.
    kThin,       // A mixed pixel of a thin structure. Its two surfaces replace all others.
    kOneSurface  // A pixel of a thin structure that shows one surface. Only `column` and `row`
                 // count.
  } kind;
  int32_t column, row;
  // Part of the pixel that the near surface covers, in kSliceBits, or kSliceEnd if the near surface
  // covers the pixel and ends there.
  uint8_t share;
  int16_t near_disparity, far_disparity;
  Colour near, far;
};

// Gives each pixel of thin tiles the disparity of the surface that covers most of the pixel. With
// these disparities, hidden surfaces end at the boundary of the thin structure.
void SetThinDisparities(const Input& input, BlockPixels* field);

// Splits the pixels of a field for a lens. Calls visit(SplitPixel, step, data) for each split pixel
// of the field, and for each other pixel of thin tiles if the coverage is not given. `step` is the
// largest step of disparity between pixels of the field that is not a depth edge. The disparities
// of the field must come from SetThinDisparities.
//
// Pixels outside the picture are not split. A boundary pixel is split only if its two surfaces move
// by more than a pixel relative to each other in some view, and only on the far side of the depth
// edge. The outermost boundary pixels of the field are not split, because these pixels do not splat
// into any rectangle.
using SplitVisitor = void (*)(const SplitPixel& pixel, int32_t step, void* data);
void SplitPixels(const Input& input, const ViewGrid& grid, const BlockPixels& field,
                 SplitVisitor visit, void* data);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_MATTING_MIXED_PIXELS_H_
