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

// Calls act(x, y, at) for each pixel of the picture in the field that lies in a thin tile; `at` is
// its index, CoverageMap::At(x, y).
template <class Act>
void ForEachThin(const CoverageMap& map, const BlockPixels& field, const Act& act) {
  const Rect inside = Clipped({field.x, field.y, field.width, field.height}, map.width, map.height);
  for (int32_t y = inside.y; y < inside.y + inside.height; ++y) {
    for (int32_t x = inside.x, end; x < inside.x + inside.width; x = end) {
      end = Min(inside.x + inside.width, (x / kCoverageTile + 1) * kCoverageTile);
      if (map.Tile(x / kCoverageTile, y / kCoverageTile).thin == 0) continue;
      size_t at = map.At(x, y);
      for (int32_t k = x; k < end; ++k) act(k, y, at++);
    }
  }
}

// Splits the pixels of a field for a lens.
//
// Pixels outside the picture are not split. A boundary pixel is split only if its two surfaces move
// by more than a pixel relative to each other in some view, and only on the far side of the depth
// edge. The outermost boundary pixels of the field are not split, because these pixels do not splat
// into any rectangle.
class PixelSplitter {
 public:
  PixelSplitter(const Input& input, const ViewGrid& grid, const BlockPixels& field);

  // Calls visit(SplitPixel) for each split pixel of the field, and for each other pixel of thin
  // tiles if the coverage is not given. The disparities of the field must come from
  // SetThinDisparities.
  template <class Visit>
  void ForEach(const Visit& visit) const {
    const Input& input = centre_.input();
    SplitPixel pixel;
    ForEachBesideEdge(*input.kernels, input, field_, step_, [&](int32_t column, int32_t row) {
      if (SplitBoundary(column, row, &pixel)) visit(pixel);
    });
    if (rims_ != nullptr) {
      ForEachInRim([&](int32_t x, int32_t y) {
        if (SplitRim(x - field_.x, y - field_.y, &pixel)) visit(pixel);
      });
    }
    if (map_ == nullptr) return;
    ForEachThin(*map_, field_, [&](int32_t x, int32_t y, size_t at) {
      if (HasGiven(input) && map_->alpha[at] == kUnsplit) return;
      SplitThin(x, y, at, &pixel);
      visit(pixel);
    });
  }

 private:
  // The outline next to a pixel of its far surface: the distance to the nearest pixel of the near
  // surface, 0 if it is more than kRimWidth pixels away; the sides on which it is (one bit of
  // kSides each); and the largest disparity there.
  struct Outline {
    int32_t distance, sides, near;
  };

  // Calls act(x, y) for each pixel of the picture in the field, except its outermost pixels, that
  // lies in a cell with a rim.
  template <class Act>
  void ForEachInRim(const Act& act) const {
    const Rect inside = Clipped({field_.x + 1, field_.y + 1, field_.width - 2, field_.height - 2},
                                rims_->width, rims_->height);
    const int32_t right = inside.x + inside.width, bottom = inside.y + inside.height;
    for (int32_t y = inside.y, end; y < bottom; y = end) {
      end = Min(bottom, (y / kRimCell + 1) * kRimCell);
      for (int32_t x = inside.x, last; x < right; x = last) {
        last = Min(right, (x / kRimCell + 1) * kRimCell);
        if (!rims_->RimAt(x, y).IsEmpty()) ForPixels({x, y, last - x, end - y}, act);
      }
    }
  }

  // Splits the boundary pixel (column, row). Returns false if it is not a mixture, or if the
  // coverage map splits it.
  bool SplitBoundary(int32_t column, int32_t row, SplitPixel* pixel) const;
  // Splits a pixel of a contaminated rim that is not a boundary pixel. Returns false if the pixel
  // does not belong to a rim.
  bool SplitRim(int32_t column, int32_t row, SplitPixel* pixel) const;
  // Splits pixel (x, y) of the picture, which lies in a thin tile, as the coverage map says at
  // index `from` (CoverageMap::At).
  void SplitThin(int32_t x, int32_t y, size_t from, SplitPixel* pixel) const;

  // Returns true if two surfaces move far enough relative to each other for a split.
  bool MoveApart(int32_t near, int32_t far) const;
  // Returns true if the coverage map decides how pixel (x, y) of the picture is split. Given
  // coverage decides only on the pixels that it splits.
  bool IsInMap(int32_t x, int32_t y) const;
  bool IsPartial(int32_t x, int32_t y) const;
  bool IsInside(int32_t x, int32_t y) const;
  bool IsOneSurface(int32_t x, int32_t y) const;
  void LimitToFar(int32_t x, int32_t y, Colour* far) const;
  Outline OutlineAt(int32_t x, int32_t y) const;
  bool LimitToClean(int32_t x, int32_t y, const Outline& outline, Colour* colour) const;
  void CleanRim(const Outline& outline, SplitPixel* pixel) const;

  const CentreView centre_;
  const ViewGrid& grid_;
  const BlockPixels& field_;
  const RimMap* const rims_;      // Null if no pixel of the field belongs to a rim.
  const CoverageMap* const map_;  // Null if the coverage map splits no pixel of the field.
  const int16_t step_;            // Largest step between pixels that is not a depth edge.
  const int64_t rim_;
};

}  // namespace starfocus

#endif  // STARFOCUS_LIB_MATTING_MIXED_PIXELS_H_
