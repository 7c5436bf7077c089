// SPDX-License-Identifier: Apache-2.0
// Kernels that build a layered depth image: they find the depth edges of a field, and the surfaces
// that those edges hide from the centre view.
#ifndef STARFOCUS_SIMD_LAYERED_DEPTH_H_
#define STARFOCUS_SIMD_LAYERED_DEPTH_H_

#include <cstddef>
#include <cstdint>

#include "simd/disparities.h"
#include "simd/padding.h"

namespace starfocus::simd {

// Surfaces that a pixel can have, one behind the other.
inline constexpr int kSurfaces = 3;

// How much of a pixel its first surface covers, with kSliceBits fractional bits: a share in
// [1, kSliceWhole], or kSliceEnd for all of a pixel beside which the surface ends.
inline constexpr int kSliceBits = 7;
inline constexpr int16_t kSliceWhole = 1 << kSliceBits;
inline constexpr uint8_t kSliceEnd = 255;

// A step of disparity from one pixel to the next of more than `step` is a depth edge. What lies
// behind it is hidden from the centre view; a side view sees a pixel more of it for each
// 2^unit_bits of the step.
struct EdgeLimits {
  int16_t step;
  int unit_bits;  // [6, 8]
};

// The largest distance, in units of disparity, from a pixel to the pixel before an edge. The far
// side of the edge lies one pixel farther, and distances in pixels fit a byte. A distance that does
// not fit 16 bits means that there is no edge, and so must stay above this.
constexpr int16_t FarthestEdge(int unit_bits) {
  const int32_t units = int32_t{254} << unit_bits;
  return static_cast<int16_t>(units < INT16_MAX ? units : INT16_MAX - 1);
}

// A step of up to 2^-kSmallStepBits of the depth of an edge that a pixel hides is none: maps of
// networks are uneven, and behind all of a surface lies what its outline hides.
inline constexpr int kSmallStepBits = 3;

// Rows of a step from the far row to the near one, see FindEdges.
struct EdgeRows {
  const int16_t *near, *far;
  int16_t *moved, *behind;
  uint8_t* distance;
};

// Steps of disparity within a surface that may part it: slices of both sides move apart.
struct CopyLimits {
  int16_t least, most;  // > 0
};

// The steps of kSliceLanes pixels of a row. Bit k of `falls` tells whether pixel k is nearer than
// the next one by more than a step; bit k of `rises`, whether the next one is nearer.
struct StepBits {
  uint16_t falls, rises;
};

// A captured view that looks behind edges. Pixels that may come to lie before a place in it follow
// each other away from the place: pixel m lies m pixels to that side, and across it m slant
// 2^-kSlantBits pixels, halves rounded up, to the right or the bottom.
struct ViewLook {
  int16_t unit;   // disparity by which pixels of the view move by one; 0: there is no view
  int8_t side;    // right, left, bottom, top
  int16_t slant;  // at most 2^kSlantBits either way; 0: along rows or columns
};
inline constexpr int kSlantBits = 14;
// Views nearer to the centre, of larger units, are not looked into.
inline constexpr int16_t kMostUnit = 1 << 10;
// Views that are looked into on a side, one after the other.
inline constexpr int kViewLooks = 2;

// A row of a field in which hidden surfaces are looked for. The rows of the field lie `stride`
// samples apart, and kSliceLanes samples can be read before the row and behind it.
struct DepthRow {
  const int16_t* disparity;
  ptrdiff_t stride;
  int32_t width;         // pixels of the row, 64 kSliceLanes at most
  int32_t above, below;  // rows of the field above this one and below it
  int16_t high;          // no disparity of the field is higher
  int unit_bits;         // as in EdgeLimits
  // The views that are looked into on each side, as `edges` has them.
  ViewLook looks[4][kViewLooks];
  // The distance of each pixel to the far side of its edges, 0 where there is no edge: to the
  // right, left, bottom and top, as FindEdges gives them. None points out of the field. Rows lie
  // `stride` apart, like those of disparities.
  const uint8_t* edges[4];
};

// What LookBehind writes of a row, in whole groups of kSliceLanes: the surfaces behind the first
// one with the place where their colours are found, and which pixels have them.
struct HiddenRow {
  int16_t* disparity[kSurfaces - 1];  // kNoSurface where there is none
  uint16_t* source[kSurfaces - 1];    // see kSourceSecond
  uint16_t* found[kSurfaces - 1];     // bit k of found[c]: whether pixel c kSliceLanes + k has one
  uint8_t* share;                     // of the first surface: kSliceWhole or kSliceEnd
};

// A source tells where the colour of a hidden surface is found, and is 0 where there is no surface.
// Bit k tells whether side k (right, left, bottom, top) shows it; the colour is the mean of those
// sides. Bit kSourceSecond + k tells that only that side's second view shows it. If no view shows
// it, the bits from kSourceDistance on are the distance of the pixel that is repeated instead, else
// 0.
inline constexpr int kSourceSecond = 4, kSourceDistance = 8;

// A side's rank is the distance of its edge in pixels, and this more if no view shows what lies
// behind it. The lowest rank gives the surface; a side without an edge has the rank kNoRank.
inline constexpr int16_t kUnseen = 256, kNoRank = INT16_MAX;

// The largest distance of an edge in pixels: it fits a byte.
inline constexpr int32_t kMostDistance = UINT8_MAX;

namespace reference {

// Parts pixels into planes: out[c * plane + n] = rgb[3 n + c] for n < count. Nothing else is
// written.
void Split(const int16_t* rgb, size_t count, size_t plane, int16_t* out);

// Follows depth edges by one row, from the far row to the near one (or from column to column, or
// backwards: the caller chooses what is near). For each pixel, moved[n] holds how many units of
// disparity away the next edge lies, and behind[n] the disparity beyond it; both are updated from
// the far row to the near row, and moved[n] starts as INT16_MAX. distance[n] becomes the distance
// to the edge's far side in pixels if the near pixel hides that side from some view, else 0. Whole
// groups of kSliceLanes are read and written.
void FindEdges(const EdgeRows& rows, const EdgeLimits& limits, size_t count);

// Finds the steps of more than `step` after each pixel n < count of a row, in groups of
// kSliceLanes; bits of pixels beyond are 0. Pixel `count` is read too.
void FindSteps(const int16_t* row, size_t count, int16_t step, StepBits* steps);

// Bit k of beside[c] tells whether one of the four pixels next to pixel c kSliceLanes + k < count
// is nearer by more than `step`; bits of pixels beyond are 0. Rows lie `stride` samples apart.
void BesideSteps(const int16_t* row, ptrdiff_t stride, size_t count, int16_t step,
                 uint16_t* beside);

// Finds what of each pixel's surface goes on behind it: copies[n] becomes the lowest disparity of
// the four pixels next to pixel n < count that lies from `least` to `most` below its own, or
// kNoSurface where there is none. Rows lie `stride` samples apart. Whole groups of kSliceLanes are
// written. Returns which groups have any, the first in bit 0; 64 groups at most.
uint64_t FindCopies(const int16_t* row, ptrdiff_t stride, size_t count, const CopyLimits& limits,
                    int16_t* copies);

// Finds up to two surfaces behind each pixel of a row, of those beyond the edges of all sides. What
// the far side of an edge hides in turn, beyond the edge that is its own, lies behind the pixel
// too, if it is kMostDistance away at most and no farther than a view at distance 1 can look: by
// its depth behind the pixel. The first surface is that beyond the edge of lowest rank, the nearer
// one if two sides have the same rank; the second is chosen likewise from the sides whose surface
// differs from the first by more than 2^unit_bits. A view shows the place behind a pixel if nothing
// before it moves there: no pixel of the ViewLook is nearer by more than half a unit of the view's
// and moves, in that view, to less than 3/4 of a pixel from the place. Returns which groups of
// kSliceLanes have hidden surfaces, the first in bit 0. In the others `source` and `found` are
// unspecified.
uint64_t LookBehind(const DepthRow& row, const HiddenRow& hidden);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_LAYERED_DEPTH_H_
