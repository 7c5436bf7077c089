// SPDX-License-Identifier: Apache-2.0
// SIMD kernels that build a layered depth image. They find the depth edges of a field, and the
// surfaces that those edges hide from the centre view.
#ifndef STARFOCUS_SIMD_LAYERED_DEPTH_H_
#define STARFOCUS_SIMD_LAYERED_DEPTH_H_

#include <cstddef>
#include <cstdint>

#include "simd/disparities.h"
#include "simd/padding.h"

namespace starfocus::simd {

// Largest number of surfaces of a pixel, one behind another.
inline constexpr int kSurfaces = 3;

// Share of a pixel that its first surface covers, with kSliceBits fractional bits. It is in [1,
// kSliceWhole], or kSliceEnd if the surface covers all of the pixel and ends next to it.
inline constexpr int kSliceBits = 7;
inline constexpr int16_t kSliceWhole = 1 << kSliceBits;
inline constexpr uint8_t kSliceEnd = 255;

// A step of disparity of more than `step` from one pixel to the next is a depth edge. It hides a
// part of the background from the centre view. A side view sees one more pixel of that part for
// each 2^unit_bits of the step.
struct EdgeLimits {
  int16_t step;
  int unit_bits;  // [6, 8]
};

// Returns the largest distance, in units of disparity, from a pixel to the pixel before an edge.
// The far side of the edge is one pixel farther, and distances in pixels must fit a byte. A larger
// value means that there is no edge; a distance that saturates at 16 bits is therefore always
// larger.
constexpr int16_t FarthestEdge(int unit_bits) {
  const int32_t units = int32_t{254} << unit_bits;
  return static_cast<int16_t>(units < INT16_MAX ? units : INT16_MAX - 1);
}

// A step of at most 2^-kSmallStepBits of the depth that a pixel already hides is not an edge. Maps
// of networks are uneven, and the background behind an outline extends behind the whole surface.
inline constexpr int kSmallStepBits = 3;

// Rows of one step of FindEdges, from the far row to the near one.
struct EdgeRows {
  const int16_t *near, *far;
  int16_t *moved, *behind;
  uint8_t* distance;
};

// Range of the steps of disparity within a surface that may tear it, since the slices on both sides
// move apart.
struct CopyLimits {
  int16_t least, most;  // > 0
};

// Steps of kSliceLanes pixels of a row. Bit k of `falls` is set if pixel k is nearer than the next
// one by more than a step. Bit k of `rises` is set if the next one is nearer.
struct StepBits {
  uint16_t falls, rises;
};

// A captured view that looks behind edges. The pixels that may occlude a place in it lie on a line
// that starts at the place. Pixel m is m pixels away towards `side`, and m slant 2^-kSlantBits
// pixels across, rounded halves up, to the right or the bottom.
struct ViewLook {
  int16_t unit;   // disparity that moves a pixel of the view by one pixel; 0: there is no view
  int8_t side;    // right, left, bottom, top
  int16_t slant;  // in [-2^kSlantBits, 2^kSlantBits]; 0: along rows or columns
};
inline constexpr int kSlantBits = 14;
// Largest unit. Views with a larger unit, which are nearer to the centre, are not used.
inline constexpr int16_t kMostUnit = 1 << 10;
// Number of views per side, tried in order.
inline constexpr int kViewLooks = 2;

// A row of a field in which hidden surfaces are searched. The rows of the field are `stride`
// samples apart, and kSliceLanes samples can be read before and after the row.
struct DepthRow {
  const int16_t* disparity;
  ptrdiff_t stride;
  int32_t width;         // pixels of the row, at most 64 kSliceLanes
  int32_t above, below;  // number of rows of the field above and below this one
  int16_t high;          // upper bound of the disparities of the field
  int unit_bits;         // as in EdgeLimits
  // views that look behind the edges of each side, in the order of `edges`
  ViewLook looks[4][kViewLooks];
  // Distance of each pixel to the far side of its edges to the right, left, bottom and top, as
  // FindEdges computes them. It is 0 if there is no edge. All far sides lie inside the field. Rows
  // are `stride` apart, like those of disparities.
  const uint8_t* edges[4];
};

// Output of LookBehind for a row, in whole groups of kSliceLanes: the hidden surfaces, the sources
// of their colours, and the pixels that have them.
struct HiddenRow {
  int16_t* disparity[kSurfaces - 1];  // kNoSurface: no surface
  uint16_t* source[kSurfaces - 1];    // see kSourceSecond
  uint16_t* found[kSurfaces - 1];     // bit k of found[c]: pixel c kSliceLanes + k has this surface
  uint8_t* share;                     // of the first surface: kSliceWhole or kSliceEnd
};

// Format of a source, which describes where the colour of a hidden surface is found; 0 if there is
// no surface. Bit k is set if side k (right, left, bottom, top) shows the surface; its colour is
// the mean of those sides. Bit kSourceSecond + k is set if only the second view of that side shows
// it. If no view shows the surface, the bits from kSourceDistance on are the distance of the pixel
// that is repeated instead, otherwise 0.
inline constexpr int kSourceSecond = 4, kSourceDistance = 8;

// The rank of a side is the distance of its edge in pixels, plus kUnseen if no view shows the
// surface behind it. The side with the lowest rank gives the surface. A side without an edge has
// the rank kNoRank.
inline constexpr int16_t kUnseen = 256, kNoRank = INT16_MAX;

// Largest distance of an edge in pixels, which fits a byte.
inline constexpr int32_t kMostDistance = UINT8_MAX;

namespace reference {

// Splits pixels into planes: out[c * plane + n] = rgb[3 n + c] for n < count. Nothing else is
// written.
void Split(const int16_t* rgb, size_t count, size_t plane, int16_t* out);

// Follows depth edges by one row, from the far row to the near one. The caller chooses which of two
// adjacent rows or columns is the near one. For each pixel, moved[n] is the distance to the next
// edge in units of disparity, and behind[n] the disparity beyond it. Both are updated from the far
// row to the near row; moved[n] starts as INT16_MAX.
//
// distance[n] is set to the distance in pixels to the edge's far side if the near pixel hides that
// side from some view, otherwise to 0. Whole groups of kSliceLanes are read and written.
void FindEdges(const EdgeRows& rows, const EdgeLimits& limits, size_t count);

// Finds the steps of more than `step` after each pixel n < count of a row, in groups of
// kSliceLanes. Bits of pixels beyond `count` are 0. Pixel `count` is read, too.
void FindSteps(const int16_t* row, size_t count, int16_t step, StepBits* steps);

// Sets bit k of beside[c] if one of the four neighbours of pixel c kSliceLanes + k is nearer by
// more than `step`. Bits of pixels at or beyond `count` are 0. Rows are `stride` samples apart.
void BesideSteps(const int16_t* row, ptrdiff_t stride, size_t count, int16_t step,
                 uint16_t* beside);

// Finds the copies that continue a surface behind its pixels. The candidates for pixel n < count
// are the disparities of its four neighbours that lie from `least` to `most` below its own. The
// lowest of these is stored in copies[n]; without a candidate, copies[n] is kNoSurface. Rows are
// `stride` samples apart. Whole groups of kSliceLanes are written. Returns the groups that have
// copies, the first in bit 0; at most 64 groups.
uint64_t FindCopies(const int16_t* row, ptrdiff_t stride, size_t count, const CopyLimits& limits,
                    int16_t* copies);

// Finds up to two surfaces behind each pixel of a row. Candidates are the surfaces beyond the edges
// of all sides, and the surfaces that these hide in turn beyond an edge on the same side. The
// latter must be at most kMostDistance away, and within the reach of a view at distance 1, which is
// their depth behind the pixel.
//
// The first surface is that of the lowest rank, or the nearer one if two sides have the same rank.
// The second one is chosen in the same way from the surfaces that differ from the first by more
// than 2^unit_bits.
//
// A view shows the place behind a pixel if no pixel of the ViewLook covers it. A pixel covers it if
// two conditions hold. The pixel is nearer by more than half of the view's unit. In that view, it
// moves to less than 3/4 of a pixel from the place.
//
// Returns the groups of kSliceLanes that have hidden surfaces, the first in bit 0. In other groups
// `source` and `found` are unspecified.
uint64_t LookBehind(const DepthRow& row, const HiddenRow& hidden);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_LAYERED_DEPTH_H_
