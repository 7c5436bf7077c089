// SPDX-License-Identifier: Apache-2.0
// The rows of all views and of the disparity map that a stripe needs, whether they lie in the
// caller's pictures or in a ring of lines.
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

// A light field at one layer: pixel (x, y) of the layer stands at (x << L, y << L) in the pictures.
// Only the centre view is subsampled as a whole; of the others a few pixels are read, in holes.
struct Window {
  int32_t width = 0;  // of the layer
  int32_t height = 0;
  int layer = 0;                       // L
  int32_t views = 0;                   // captured, the centre one included
  OcclusionViews occlusion_views;      // which of them look behind edges
  const Transfer* transfer = nullptr;  // of the codes of the pictures
  Plane<const uint8_t> centre;         // codes; layer 0
  Plane<const int16_t> samples;        // of the centre view, simd::kLayerBits; layers 1 and 2
  int32_t picture_width = 0;
  int32_t picture_height = 0;
  ViewReader reader;                      // of the views' light, or of their excess (excess.h)
  bool is_excess = false;                 // which of both; layer 0
  ViewReader light;                       // with is_excess: of light
  Plane<const int16_t> disparity;         // of the pictures, kDisparityBits
  Plane<const uint8_t> given_coverage;    // of the light field, 255: whole; null: there is none
  const CoverageMap* coverage = nullptr;  // found of that, or of thin structures; null: none
};

// Places one after the other in a captured view: the first at (x, y) of the layer, kShiftBits, each
// (dx, dy) pixels of the layer after the one before.
struct CapturedLine {
  int32_t x, y, dx, dy;
};

// The light at the first `count` places of a line in captured view `index`, R, G and B each; places
// outside the picture take the nearest pixel inside. Interpolated linearly at L = 0; at L > 0 a
// binomial of 2^(L+1) - 1 taps per axis around the nearest pixel of the picture subsamples: what
// shows in a hole of a defocused block is blurred by at least 3 pixels of the layer afterwards.
void ReadCaptured(const Window& window, int index, const CapturedLine& line, int32_t count,
                  int16_t* rgb);

// Pixels of the picture around such a place that it is made of.
constexpr int32_t CapturedBorder(int layer) { return layer == 0 ? 1 : (1 << layer) - 1; }

// One such colour at L = 0 before it is rounded, with 2 * kShiftBits more.
void InterpolateCaptured(const Window& window, int index, int32_t x, int32_t y, int32_t* rgb);

// Whether any of the views has codes of kFirstExcess or more in the columns and rows of `rect`.
bool MayHaveHighlights(const Window& window, const Rect& rect);

// Whether all pixels of all views in the columns and rows of `rect` are highlights.
bool AreAllHighlights(const Window& window, const Rect& rect);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_INPUT_WINDOW_H_
