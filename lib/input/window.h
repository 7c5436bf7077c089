// SPDX-License-Identifier: Apache-2.0
// Rows of all views and of the disparity map that a stripe needs. They are in the caller's pictures
// or in a ring buffer.
#ifndef STARFOCUS_LIB_INPUT_WINDOW_H_
#define STARFOCUS_LIB_INPUT_WINDOW_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/fixed.h"
#include "lib/base/geometry.h"
#include "lib/base/transfer.h"
#include "lib/base/view_set.h"
#include "lib/input/view_reader.h"

namespace starfocus {

struct CoverageMap;

// A light field at one layer. Pixel (x, y) of the layer is at (x << L, y << L) in the pictures.
// Only the centre view is subsampled completely; of side views a few pixels in holes are read.
struct Window {
  int32_t width = 0;  // size of the layer
  int32_t height = 0;
  int layer = 0;                       // L
  int32_t views = 0;                   // number of captured views, including the centre view
  OcclusionViews occlusion_views;      // views that see behind edges
  const Transfer* transfer = nullptr;  // transfer function of the pictures
  Plane<const uint8_t> centre;         // codes at layer 0
  Plane<const int16_t> samples;        // centre view at layers 1 and 2, simd::kLayerBits
  int32_t picture_width = 0;
  int32_t picture_height = 0;
  ViewReader reader;                      // reads light of the views, or excess (excess.h)
  bool is_excess = false;                 // true: `reader` reads excess, at layer 0
  ViewReader light;                       // reads light if is_excess
  Plane<const int16_t> disparity;         // at the size of the pictures, kDisparityBits
  Plane<const uint8_t> given_coverage;    // coverage of the light field, 255: covered; null: none
  const CoverageMap* coverage = nullptr;  // computed from it, or for thin structures; null: none
};

// Sequence of places in a captured view. The first place is (x, y) of the layer, kShiftBits. Each
// step adds (dx, dy) pixels of the layer.
struct CapturedLine {
  int32_t x, y, dx, dy;
};

// Reads the light at the first `count` places of a line in captured view `index`, in RGB order.
// Places outside the picture use the nearest pixel inside. At L = 0 it interpolates linearly. At L
// > 0 it subsamples with a triangular filter of 2^(L+1) - 1 taps per axis around the nearest pixel
// of the picture. That is sufficient because a hole in a defocused block is blurred by at least 3
// pixels of the layer afterwards.
void ReadCaptured(const Window& window, int index, const CapturedLine& line, int32_t count,
                  int16_t* rgb);

// Returns the number of pixels of the picture that ReadCaptured reads around a place.
constexpr int32_t CapturedBorder(int layer) { return layer == 0 ? 1 : (1 << layer) - 1; }

// Reads one place at L = 0 without rounding, with 2 * kShiftBits more fractional bits.
void InterpolateCaptured(const Window& window, int index, int32_t x, int32_t y, int32_t* rgb);

// Returns true if any view has a code of at least kFirstExcess in `rect`.
bool MayHaveHighlights(const Window& window, const Rect& rect);

// Returns true if all pixels of all views in `rect` are highlights.
bool AreAllHighlights(const Window& window, const Rect& rect);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_INPUT_WINDOW_H_
