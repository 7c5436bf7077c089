// SPDX-License-Identifier: Apache-2.0
// SIMD kernels that build a layered depth image. The kernels find the depth edges of a field and
// the surfaces that are hidden behind these edges from the centre view.
#ifndef STARFOCUS_SIMD_LAYERED_DEPTH_H_
#define STARFOCUS_SIMD_LAYERED_DEPTH_H_

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <initializer_list>

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
struct HiddenView {
  int16_t unit;  // Disparity that moves a pixel of the view by one pixel; 0 if there is no view.
  int8_t side;   // Direction of the line: 0 right, 1 left, 2 bottom, 3 top.
  // Slope of the line, in [-2^kSlantBits, 2^kSlantBits]; 0 for lines along rows or columns.
  int16_t slant;
};
inline constexpr int kSlantBits = 14;
// Largest value of HiddenView::unit. Views whose HiddenView::unit exceeds this constant are too
// close to the centre view and are not used.
inline constexpr int16_t kMostUnit = 1 << 10;
// Number of views per side. FindHidden tries the views of a side in order.
inline constexpr int kHiddenViews = 2;

// A row of a field in which hidden surfaces are searched. The rows of the field are `stride`
// samples apart. Before and after the row, kSliceLanes more samples must be readable.
struct DepthRow {
  const int16_t* disparity;
  ptrdiff_t stride;
  int32_t width;         // Number of pixels of the row, at most 64 kSliceLanes.
  int32_t above, below;  // Number of rows of the field above and below this row.
  int16_t high;          // Upper bound of the disparities of the field.
  int unit_bits;         // `unit_bits` of FindEdges.
  // Views that look behind the edges of each side, in the order of `edges`.
  HiddenView views[4][kHiddenViews];
  // Distances from each pixel to the far sides of edges to the right, left, bottom and top, as
  // computed by FindEdges. A distance is 0 if there is no edge. All far sides lie inside the field.
  // The rows of distances are `stride` elements apart.
  const uint8_t* edges[4];
};

// Output of FindHidden for a row: the hidden surfaces, the sources of their colours, and the pixels
// that have hidden surfaces. Whole groups of kSliceLanes are written.
struct HiddenRow {
  int16_t* disparity[kSurfaces - 1];  // kNoSurface if there is no surface.
  uint16_t* source[kSurfaces - 1];    // Sources of the colours; kSourceSecond describes the format.
  uint16_t* found[kSurfaces - 1];  // Bit k of element c: pixel c kSliceLanes + k has the surface.
  uint8_t* share;                  // Share of the first surface: kSliceWhole or kSliceEnd.
};

// Hidden surfaces of a group of kSliceLanes pixels, and the share of their first surfaces. The
// three planes of colours are `plane` samples apart.
struct HiddenGroup {
  int16_t* disparity[kSurfaces - 1];
  uint16_t* source[kSurfaces - 1];
  int16_t* rgb[kSurfaces - 1];
  size_t plane;
  const uint8_t* share;
};

// Format of a source, which describes the origin of the colour of a hidden surface. A source is 0
// if there is no surface. Bit k is set if side k (right, left, bottom, top) shows the surface; the
// colour is the mean over these sides. Bit kSourceSecond + k is set if only the second view of side
// k shows the surface. The bits from kSourceDistance on are 0 if a view shows the surface. If no
// view shows the surface, a pixel beyond the edge is repeated, and the bits from kSourceDistance on
// are the distance to the repeated pixel.
inline constexpr int kSourceSecond = 4, kSourceDistance = 8;
// Masks of the sides along the rows (right and left) and along the columns (bottom and top).
inline constexpr int16_t kSourceAlongRow = 3, kSourceAlongColumn = 12;

// The rank of an edge is the distance to its far side in pixels, plus kUnseen if no view shows the
// surface behind the edge. The edge with the lowest rank determines the hidden surface. If there is
// no edge, the rank is kNoRank.
inline constexpr int16_t kUnseen = 256, kNoRank = INT16_MAX;

// Largest distance of an edge in pixels, which fits a byte.
inline constexpr int32_t kMostDistance = UINT8_MAX;

namespace reference {

// The surface beyond one edge of a pixel.
struct HiddenSide {
  int rank;  // rank of the edge, as defined at kUnseen
  int16_t disparity;
  bool second;  // true if only the side's second view shows the surface
};

// Returns true if a view does not show the surface at `disparity` behind pixel x of a row.
inline bool IsCovered(const DepthRow& row, int32_t x, int16_t disparity, const HiddenView& view) {
  for (int32_t m = 0;; ++m) {
    const int32_t along = view.side % 2 == 0 ? m : -m;
    const int32_t across = (m * view.slant + (1 << (kSlantBits - 1))) >> kSlantBits;
    const int32_t column = x + (view.side < 2 ? along : across);
    const int32_t line = view.side < 2 ? across : along;
    if (column < 0 || column >= row.width || line < -row.above || line > row.below) return false;
    const int32_t nearer = row.disparity[column + line * row.stride] - disparity;
    if (2 * nearer > view.unit && 4 * std::abs(nearer - m * view.unit) < 3 * view.unit) return true;
  }
}

// Number of edges that are followed on each side: the next edge, and the edge beyond the next
// edge's far side.
inline constexpr int kEdges = 2;

// Returns the distance from pixel x to the far side of an edge, or 0 if there is no such edge.
inline int DistanceOf(const DepthRow& row, int32_t x, int side, ptrdiff_t step, int edge) {
  const uint8_t* first = row.edges[side] + x;
  if (edge == 0 || *first == 0) return *first;
  const int more = first[step * *first], distance = *first + more;
  if (more == 0 || distance > kMostDistance) return 0;
  const int16_t* here = row.disparity + x;
  const int depth = Saturated(*here - here[step * distance]) >> row.unit_bits;
  return distance - 1 <= depth ? distance : 0;
}

inline HiddenSide FindHiddenSide(const DepthRow& row, int32_t x, int side, int edge) {
  const ptrdiff_t along = side < 2 ? 1 : row.stride, step = side % 2 == 0 ? along : -along;
  const int32_t distance = DistanceOf(row, x, side, step, edge);
  if (distance == 0) return {kNoRank, kNoSurface, false};
  const int16_t disparity = row.disparity[x + step * distance];
  for (const HiddenView& view : row.views[side]) {
    if (view.unit != 0 && !IsCovered(row, x, disparity, view)) {
      return {distance, disparity, &view != row.views[side]};
    }
  }
  return {distance + kUnseen, disparity, false};
}

// Writes pixel x of hidden surface `behind` and returns its disparity. The surface must differ from
// `above`, which is the disparity of the hidden surface in front.
inline int16_t ChooseSurface(const HiddenSide* sides, int32_t x, int behind, int32_t unit,
                             int16_t above, const HiddenRow& hidden) {
  const HiddenSide* best = nullptr;
  for (const HiddenSide* side = sides; side < sides + 4 * kEdges; ++side) {
    if (side->rank == kNoRank) continue;
    if (behind > 0 && std::abs(side->disparity - above) <= unit) continue;
    const bool before = best == nullptr || side->rank < best->rank ||
                        (side->rank == best->rank && side->disparity > best->disparity);
    if (before) best = side;
  }
  int source = 0;
  for (int k = 0; best != nullptr && k < 4 * kEdges; ++k) {
    if (sides[k].rank != best->rank || sides[k].disparity != best->disparity) continue;
    const int side = k % 4;
    source |= 1 << side | (sides[k].second ? 1 << (kSourceSecond + side) : 0);
    if (best->rank > kUnseen) source |= (best->rank - kUnseen) << kSourceDistance;
  }
  hidden.source[behind][x] = static_cast<uint16_t>(source);
  return hidden.disparity[behind][x] = best == nullptr ? kNoSurface : best->disparity;
}

// Splits pixels into planes: out[c * plane + n] = rgb[3 n + c] for n < count. No other elements of
// `out` are written.
STARFOCUS_REFERENCE void Deinterleave(const int16_t* rgb, size_t count, size_t plane,
                                      int16_t* out) {
  for (size_t n = 0; n < count; ++n) {
    for (size_t c = 0; c < 3; ++c) out[c * plane + n] = rgb[3 * n + c];
  }
}

// Follows depth edges by one row, from `far` to `near`. The caller decides which of two adjacent
// rows is `near`. A step of disparity of more than `step` from one pixel to the next is a depth
// edge. A depth edge hides a part of the background from the centre view. For each 2^unit_bits of
// the disparity step, a side view reveals one more pixel of the hidden background. `unit_bits` is
// in [6, 8].
//
// For each pixel, moved[n] is the distance to the next edge in units of disparity, or INT16_MAX if
// the distance exceeds `farthest`, and behind[n] is the disparity beyond that edge. On entry,
// moved[n] and behind[n] describe row `far`; on return, they describe row `near`. Before the first
// call, the caller sets moved[n] to INT16_MAX. `farthest` is at most FarthestEdge(unit_bits).
//
// If the near pixel hides the far side of the edge from some view, distance[n] is the distance in
// pixels to the far side. If the near pixel hides nothing, distance[n] is 0. Whole groups of
// kSliceLanes are read and written.
STARFOCUS_REFERENCE void FindEdges(const int16_t* near, const int16_t* far, int16_t step,
                                   int unit_bits, int16_t farthest, size_t count, int16_t* moved,
                                   int16_t* behind, uint8_t* distance) {
  for (size_t n = 0; n < SliceSamples(count); ++n) {
    const int next = moved[n] + (1 << unit_bits);
    const int16_t farther = next > farthest ? int16_t{INT16_MAX} : static_cast<int16_t>(next);
    const int16_t change = Saturated(near[n] - far[n]), so_far = Saturated(near[n] - behind[n]);
    const bool goes_on =
        farther <= so_far && farther <= farthest && change <= so_far >> kSmallStepBits;
    const bool edge = change > step && !goes_on;
    moved[n] = edge ? int16_t{0} : farther;
    if (edge) behind[n] = far[n];
    const int16_t depth = Saturated(near[n] - behind[n]);
    const bool hides = depth > step && moved[n] <= depth && moved[n] <= farthest;
    distance[n] = static_cast<uint8_t>(hides ? (moved[n] >> unit_bits) + 1 : 0);
  }
}

// Finds the pixels n < count of a row that differ from pixel n + 1 by more than `step`. Writes one
// StepBits per group of kSliceLanes; bits of pixels at or beyond `count` are 0. Pixel `count` is
// read as well.
STARFOCUS_REFERENCE void FindSteps(const int16_t* row, size_t count, int16_t step,
                                   StepBits* steps) {
  for (size_t n = 0; n < count; ++n) {
    StepBits& bits = steps[n / kSliceLanes];
    if (n % kSliceLanes == 0) bits = {0, 0};
    const int fall = row[n] - row[n + 1], bit = 1 << n % kSliceLanes;
    bits.falls = static_cast<uint16_t>(bits.falls | (fall > step ? bit : 0));
    bits.rises = static_cast<uint16_t>(bits.rises | (-fall > step ? bit : 0));
  }
}

// Finds the pixels next to depth edges. Bit k of beside[c] is set if one of the four neighbours of
// pixel c kSliceLanes + k is nearer than the pixel by more than `step`. Bits of pixels at or beyond
// `count` are 0. Rows are `stride` samples apart.
STARFOCUS_REFERENCE void BesideSteps(const int16_t* row, ptrdiff_t stride, size_t count,
                                     int16_t step, uint16_t* beside) {
  for (size_t n = 0; n < count; ++n) {
    uint16_t& bits = beside[n / kSliceLanes];
    if (n % kSliceLanes == 0) bits = 0;
    bool nearer = false;
    for (const ptrdiff_t next : {ptrdiff_t{1}, ptrdiff_t{-1}, stride, -stride}) {
      nearer = nearer || row[static_cast<ptrdiff_t>(n) + next] - row[n] > step;
    }
    bits = static_cast<uint16_t>(bits | (nearer ? 1 << n % kSliceLanes : 0));
  }
}

// For each pixel, finds the disparity of a copy that continues the pixel's surface behind the
// pixel. The candidates for pixel n < count are the disparities of its eight neighbours that are
// lower than the pixel's disparity by `least` to `most`, both > 0. In this range, the difference
// may open a gap in a surface, because adjacent slices move by different distances; between
// diagonal neighbours, in views that move along both axes. Element copies[n] is the lowest
// candidate, or kNoSurface if there is no candidate. Rows are `stride` samples apart. Whole groups
// of kSliceLanes are written. In the result, bit c is set if group c has copies. A row has at most
// 64 groups.
STARFOCUS_REFERENCE uint64_t FindCopies(const int16_t* row, ptrdiff_t stride, size_t count,
                                        int16_t least, int16_t most, int16_t* copies) {
  uint64_t strips = 0;
  for (size_t n = 0; n < SliceSamples(count); ++n) {
    copies[n] = kNoSurface;
    if (n >= count) continue;
    int16_t farthest = 0;
    for (const ptrdiff_t next : {ptrdiff_t{1}, ptrdiff_t{-1}, stride - 1, stride, stride + 1,
                                 -stride - 1, -stride, -stride + 1}) {
      const int16_t step = Saturated(row[n] - row[static_cast<ptrdiff_t>(n) + next]);
      if (step >= least && step <= most && step > farthest) farthest = step;
    }
    if (farthest == 0) continue;
    copies[n] = static_cast<int16_t>(row[n] - farthest);
    strips |= uint64_t{1} << (n / kSliceLanes);
  }
  return strips;
}

// Returns the mean of two colours, rounded half up, or only one of them if `has_a` or `has_b` is
// false. Colours are light, >= 0.
inline int16_t MeanOfFound(bool has_a, int16_t a, bool has_b, int16_t b) {
  return has_a && has_b ? static_cast<int16_t>((a + b + 1) >> 1) : has_a ? a : b;
}

// Returns the colour of a copy (InsertCopies) of a pixel, in the plane in which `rgb` is the pixel.
inline int16_t ColourOfCopy(const int16_t* row, ptrdiff_t stride, int16_t copy,
                            const int16_t* rgb) {
  const auto is_copy = [=](ptrdiff_t next) { return row[next] == copy; };
  const auto mean_of = [=](ptrdiff_t a, ptrdiff_t b) {
    return MeanOfFound(is_copy(a), rgb[a], is_copy(b), rgb[b]);
  };
  const bool along = is_copy(1) || is_copy(-1), across = is_copy(stride) || is_copy(-stride);
  if (along || across) return MeanOfFound(along, mean_of(1, -1), across, mean_of(stride, -stride));
  const ptrdiff_t fall = stride + 1, rise = stride - 1;
  return MeanOfFound(is_copy(fall) || is_copy(-fall), mean_of(fall, -fall),
                     is_copy(rise) || is_copy(-rise), mean_of(rise, -rise));
}

// Inserts the copies (FindCopies) of a group of kSliceLanes pixels in front of their hidden
// surfaces. A pixel whose first hidden surface is nearer keeps its surfaces, and so does a pixel at
// which the first surface ends, because this pixel belongs to one slice only. The source of a copy
// is 0. Its colour is the mean colour of the neighbours whose disparity is that of the copy: the
// mean of the means along the row and along the column, or, without such a neighbour there, of the
// means along both diagonals. Rows are `stride` samples apart. The planes of `rgb`, the colours of
// the first surfaces, are as far apart as those of `hidden`.
STARFOCUS_REFERENCE void InsertCopies(const int16_t* row, ptrdiff_t stride, const int16_t* copies,
                                      const int16_t* rgb, const HiddenGroup& hidden) {
  for (size_t n = 0; n < kSliceLanes; ++n) {
    if (copies[n] <= hidden.disparity[0][n] || hidden.share[n] != kSliceWhole) continue;
    hidden.disparity[1][n] = hidden.disparity[0][n];
    hidden.disparity[0][n] = copies[n];
    hidden.source[1][n] = hidden.source[0][n];
    hidden.source[0][n] = 0;
    for (size_t at = n; at < 3 * hidden.plane; at += hidden.plane) {
      hidden.rgb[1][at] = hidden.rgb[0][at];
      hidden.rgb[0][at] = ColourOfCopy(row + n, stride, copies[n], rgb + at);
    }
  }
}

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
// A view shows a hidden surface behind a pixel if no pixel on the line of the HiddenView covers the
// hidden surface. A pixel of the line covers the surface if two conditions hold. First, the pixel
// is nearer than the surface by more than half of the view's unit. Second, the view shows the pixel
// less than 3/4 of a pixel away from the hidden pixel.
//
// In the result, bit c is set if group c of kSliceLanes pixels has hidden surfaces. In all other
// groups, `source` and `found` are unspecified.
STARFOCUS_REFERENCE uint64_t FindHidden(const DepthRow& row, const HiddenRow& hidden) {
  uint64_t strips = 0;
  for (int32_t x = 0; x < static_cast<int32_t>(SliceSamples(static_cast<size_t>(row.width))); ++x) {
    HiddenSide sides[4 * kEdges];
    bool end = false;
    for (int side = 0; side < 4; ++side) {
      for (int edge = 0; edge < kEdges; ++edge) {
        sides[4 * edge + side] = FindHiddenSide(row, x, side, edge);
      }
      end = end || row.edges[side][x] == 1;
    }
    hidden.share[x] = end ? kSliceEnd : static_cast<uint8_t>(kSliceWhole);
    const size_t strip = static_cast<size_t>(x) / kSliceLanes;
    int16_t above = kNoSurface;
    for (int behind = 0; behind < kSurfaces - 1; ++behind) {
      above = ChooseSurface(sides, x, behind, 1 << row.unit_bits, above, hidden);
      const int bit = above != kNoSurface ? 1 << static_cast<size_t>(x) % kSliceLanes : 0;
      uint16_t& found = hidden.found[behind][strip];
      found = static_cast<uint16_t>((static_cast<size_t>(x) % kSliceLanes == 0 ? 0 : found) | bit);
      if (bit != 0) strips |= uint64_t{1} << strip;
    }
  }
  return strips;
}

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_LAYERED_DEPTH_H_
