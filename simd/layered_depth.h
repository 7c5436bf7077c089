// SPDX-License-Identifier: Apache-2.0
// SIMD kernels that build a layered depth image. The kernels find the depth edges of a field and
// the surfaces that are hidden behind these edges from the centre view.
#ifndef STARFOCUS_SIMD_LAYERED_DEPTH_H_
#define STARFOCUS_SIMD_LAYERED_DEPTH_H_

#include <cstddef>
#include <cstdint>

#include "simd/disparities.h"
#include "simd/samples.h"

namespace starfocus::simd {

// Largest number of surfaces at a pixel, including the visible one.
inline constexpr int kSurfaces = 3;

// Fractional bits and special values of a share, which is the part of a pixel that the first
// surface covers. A share is in [1, kSliceWhole]. The share is kSliceEnd if the surface covers the
// whole pixel and ends next to the pixel.
inline constexpr int kSliceBits = 7;
inline constexpr int16_t kSliceWhole = 1 << kSliceBits;
inline constexpr uint8_t kSliceEnd = 255;

// A step of disparity of more than `step` from one pixel to the next is a depth edge. A depth edge
// hides a part of the background from the centre view. For each 2^unit_bits of the disparity step,
// a side view reveals one more pixel of the hidden background.
struct EdgeLimits {
  int16_t step;
  int unit_bits;  // [6, 8]
};

// Returns the largest supported distance, in units of disparity, between a pixel and the last pixel
// before a depth edge. The returned distance leaves room for the edge's far side, one pixel
// farther, because distances in pixels must fit in a byte. A pixel whose distance to a depth edge
// exceeds the returned value counts as a pixel without an edge. The returned value is less than
// INT16_MAX, because a saturated distance must mean that there is no edge.
constexpr int16_t FarthestEdge(int unit_bits) {
  const int32_t units = int32_t{254} << unit_bits;
  return static_cast<int16_t>(units < INT16_MAX ? units : INT16_MAX - 1);
}

// A step in disparity is not a depth edge if it is at most 2^-kSmallStepBits of the depth range
// already hidden by the pixel. Disparity maps computed by neural networks are uneven, and the
// background behind an outline must extend behind the whole surface.
inline constexpr int kSmallStepBits = 3;

// Rows that one call of FindEdges reads and writes.
struct EdgeRows {
  const int16_t *near, *far;
  int16_t *moved, *behind;
  uint8_t* distance;
};

// Range of the differences in disparity between adjacent pixels of one surface that may open a gap,
// because adjacent slices move by different distances.
struct CopyLimits {
  int16_t least, most;  // > 0
};

// Depth edges between each of kSliceLanes pixels of a row and the next pixel. Bit k of `falls` is
// set if a depth edge follows pixel k, and pixel k is nearer to the camera than pixel k + 1. Bit k
// of `rises` is set if a depth edge follows pixel k, and pixel k + 1 is nearer to the camera than
// pixel k.
struct StepBits {
  uint16_t falls, rises;
};

// A captured view that may show the surfaces behind depth edges. The pixels that may occlude a
// hidden pixel in this view lie on a line that starts at the hidden pixel. Pixel m of the line is m
// pixels away towards `side`. Perpendicular to `side`, pixel m is shifted to the right or to the
// bottom by m slant 2^-kSlantBits pixels, rounded half up.
struct ViewLook {
  int16_t unit;  // Disparity that moves a pixel of the view by one pixel; 0 if there is no view.
  int8_t side;   // Direction of the line: 0 right, 1 left, 2 bottom, 3 top.
  // Slope of the line, in [-2^kSlantBits, 2^kSlantBits]; 0 for lines along rows or columns.
  int16_t slant;
};
inline constexpr int kSlantBits = 14;
// Largest value of ViewLook::unit. Views whose ViewLook::unit exceeds this constant are too close
// to the centre view and are not used.
inline constexpr int16_t kMostUnit = 1 << 10;
// Number of views per side. LookBehind tries the views of a side in order.
inline constexpr int kViewLooks = 2;

// A row of a field in which hidden surfaces are searched. The rows of the field are `stride`
// samples apart. Before and after the row, kSliceLanes more samples must be readable.
struct DepthRow {
  const int16_t* disparity;
  ptrdiff_t stride;
  int32_t width;         // Number of pixels of the row, at most 64 kSliceLanes.
  int32_t above, below;  // Number of rows of the field above and below this row.
  int16_t high;          // Upper bound of the disparities of the field.
  int unit_bits;         // EdgeLimits::unit_bits of the field.
  // Views that look behind the edges of each side, in the order of `edges`.
  ViewLook looks[4][kViewLooks];
  // Distances from each pixel to the far sides of edges to the right, left, bottom and top, as
  // computed by FindEdges. A distance is 0 if there is no edge. All far sides lie inside the field.
  // The rows of distances are `stride` elements apart.
  const uint8_t* edges[4];
};

// Output of LookBehind for a row: the hidden surfaces, the sources of their colours, and the pixels
// that have hidden surfaces. Whole groups of kSliceLanes are written.
struct HiddenRow {
  int16_t* disparity[kSurfaces - 1];  // kNoSurface if there is no surface.
  uint16_t* source[kSurfaces - 1];    // Sources of the colours; kSourceSecond describes the format.
  uint16_t* found[kSurfaces - 1];  // Bit k of element c: pixel c kSliceLanes + k has the surface.
  uint8_t* share;                  // Share of the first surface: kSliceWhole or kSliceEnd.
};

// Format of a source, which describes the origin of the colour of a hidden surface. A source is 0
// if there is no surface. Bit k is set if side k (right, left, bottom, top) shows the surface; the
// colour is the mean over these sides. Bit kSourceSecond + k is set if only the second view of side
// k shows the surface. The bits from kSourceDistance on are 0 if a view shows the surface. If no
// view shows the surface, a pixel beyond the edge is repeated, and the bits from kSourceDistance on
// are the distance to the repeated pixel.
inline constexpr int kSourceSecond = 4, kSourceDistance = 8;

// The rank of an edge is the distance to its far side in pixels, plus kUnseen if no view shows the
// surface behind the edge. The edge with the lowest rank determines the hidden surface. If there is
// no edge, the rank is kNoRank.
inline constexpr int16_t kUnseen = 256, kNoRank = INT16_MAX;

// Largest distance of an edge in pixels, which fits a byte.
inline constexpr int32_t kMostDistance = UINT8_MAX;

namespace reference {

// Splits pixels into planes: out[c * plane + n] = rgb[3 n + c] for n < count. No other elements of
// `out` are written.
void Split(const int16_t* rgb, size_t count, size_t plane, int16_t* out);

// Follows depth edges by one row, from rows.far to rows.near. The caller decides which of two
// adjacent rows is `near`. For each pixel, moved[n] is the distance to the next edge in units of
// disparity, and behind[n] is the disparity beyond that edge. On entry, moved[n] and behind[n]
// describe row `far`; on return, they describe row `near`. Before the first call, the caller sets
// moved[n] to INT16_MAX.
//
// If the near pixel hides the far side of the edge from some view, distance[n] is the distance in
// pixels to the far side. If the near pixel hides nothing, distance[n] is 0. Whole groups of
// kSliceLanes are read and written.
void FindEdges(const EdgeRows& rows, const EdgeLimits& limits, size_t count);

// Finds the pixels n < count of a row that differ from pixel n + 1 by more than `step`. Writes one
// StepBits per group of kSliceLanes; bits of pixels at or beyond `count` are 0. Pixel `count` is
// read as well.
void FindSteps(const int16_t* row, size_t count, int16_t step, StepBits* steps);

// Finds the pixels next to depth edges. Bit k of beside[c] is set if one of the four neighbours of
// pixel c kSliceLanes + k is nearer than the pixel by more than `step`. Bits of pixels at or beyond
// `count` are 0. Rows are `stride` samples apart.
void BesideSteps(const int16_t* row, ptrdiff_t stride, size_t count, int16_t step,
                 uint16_t* beside);

// For each pixel, finds the disparity of a copy that continues the pixel's surface behind the
// pixel. The candidates for pixel n < count are the disparities of its four neighbours that are
// lower than the pixel's disparity by `least` to `most`. Element copies[n] is the lowest candidate,
// or kNoSurface if there is no candidate. Rows are `stride` samples apart. Whole groups of
// kSliceLanes are written. In the result, bit c is set if group c has copies. A row has at most 64
// groups.
uint64_t FindCopies(const int16_t* row, ptrdiff_t stride, size_t count, const CopyLimits& limits,
                    int16_t* copies);

// Finds up to two surfaces behind each pixel of a row. On each side, the first candidate is the
// surface beyond the next edge. The second candidate is the surface that the far side of this edge
// hides beyond another edge. The second candidate must be at most kMostDistance pixels away. A view
// at distance 1 must be able to see the second candidate, so the candidate's distance is limited by
// its depth behind the pixel.
//
// The first hidden surface is the candidate with the lowest rank. If two candidates have equal
// rank, the nearer candidate is chosen. The second hidden surface is chosen in the same way, from
// the candidates that differ from the first hidden surface by more than 2^unit_bits.
//
// A view shows a hidden surface behind a pixel if no pixel on the line of the ViewLook covers the
// hidden surface. A pixel of the line covers the surface if two conditions hold. First, the pixel
// is nearer than the surface by more than half of the view's unit. Second, the view shows the pixel
// less than 3/4 of a pixel away from the hidden pixel.
//
// In the result, bit c is set if group c of kSliceLanes pixels has hidden surfaces. In all other
// groups, `source` and `found` are unspecified.
uint64_t LookBehind(const DepthRow& row, const HiddenRow& hidden);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_LAYERED_DEPTH_H_
