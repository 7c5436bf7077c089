// SPDX-License-Identifier: Apache-2.0
// Rows of all views and of the disparity map that a stripe reads. The rows lie in the caller's
// pictures or in ring buffers.
#ifndef STARFOCUS_LIB_IO_WINDOW_H_
#define STARFOCUS_LIB_IO_WINDOW_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/fixed.h"
#include "lib/base/geometry.h"
#include "lib/base/transfer.h"
#include "lib/io/view_reader.h"
#include "lib/optics/view_set.h"

namespace starfocus {

struct CoverageMap;

// A light field at one layer. Pixel (x, y) of the layer is at (x << L, y << L) in the pictures.
// Only the centre view is subsampled completely. Side views are read only at a few pixels, to fill
// holes.
struct Window {
  int32_t width = 0;  // width and height of the layer in pixels
  int32_t height = 0;
  int layer = 0;                       // Layer L.
  int32_t views = 0;                   // Number of captured views, including the centre view.
  OcclusionViews occlusion_views;      // Captured views that see behind depth edges.
  const Transfer* transfer = nullptr;  // Transfer function of the pictures.
  Plane<const uint8_t> centre;         // Codes of the centre view at layer 0.
  Plane<const int16_t> samples;        // Centre view at layers 1 and 2, simd::kLayerBits.
  int32_t picture_width = 0;
  int32_t picture_height = 0;
  ViewReader reader;               // Reads light of the views, or excess (excess.h).
  bool is_excess = false;          // True: `reader` reads excess, at layer 0.
  ViewReader light;                // If is_excess is true, reads the light of the views.
  Plane<const int16_t> disparity;  // Disparities at the size of the pictures, kDisparityBits.
  // Coverage that the light field provides, from 0 to 255 (fully covered); null if the light field
  // has no coverage.
  Plane<const uint8_t> given_coverage;
  // Coverage computed from `given_coverage` or for thin structures; null: no coverage.
  const CoverageMap* coverage = nullptr;
};

// Sequence of positions in a captured view. The first position is (x, y) of the layer, kShiftBits.
// Neighbouring positions are (dx, dy) pixels of the layer apart.
struct CapturedLine {
  int32_t x, y, dx, dy;
};

// Reads the light at the first `count` positions of a line in captured view `index`, in RGB order.
// For positions outside the picture, the nearest pixel inside is read. At layer 0 (L = 0) the light
// is interpolated linearly. At L > 0 the view is subsampled around the nearest pixel of the
// picture, with a triangular filter of 2^(L+1) - 1 taps per axis. A triangular filter is
// sufficient, because refocusing later blurs a hole of a defocused block by at least 3 pixels of
// the layer.
void ReadCaptured(const Window& window, int index, const CapturedLine& line, int32_t count,
                  int16_t* rgb);

// Returns the number of pixels of the picture that ReadCaptured reads around a position.
constexpr int32_t CapturedBorder(int layer) { return layer == 0 ? 1 : (1 << layer) - 1; }

// Reads the light at one position of a view at layer 0 without rounding. The result has 2 *
// kShiftBits more fractional bits than light.
void InterpolateCaptured(const Window& window, int index, int32_t x, int32_t y, int32_t* rgb);

// Returns true if any view has a code of at least kFirstExcess in `rect`.
bool MayHaveHighlights(const Window& window, const Rect& rect);

// Returns true if all pixels of all views in `rect` are highlights.
bool AreAllHighlights(const Window& window, const Rect& rect);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_IO_WINDOW_H_
