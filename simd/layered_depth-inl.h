// SPDX-License-Identifier: Apache-2.0
// Vector code of the functions in layered_depth.h. This file is included once per SIMD target.
#include <initializer_list>

#include "simd/highway-inl.h"
#include "simd/layered_depth.h"

HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

inline void Deinterleave(const int16_t* HWY_RESTRICT rgb, size_t count, size_t plane,
                         int16_t* HWY_RESTRICT out) {
  const bool done = SplitColours(LanesTag(), rgb, count, plane, out);
  if (!done) reference::Deinterleave(rgb, count, plane, out);
}

inline void FindEdges(const int16_t* HWY_RESTRICT near, const int16_t* HWY_RESTRICT far,
                      int16_t least_step, int unit_bits, int16_t last, size_t count,
                      int16_t* HWY_RESTRICT moved, int16_t* HWY_RESTRICT behind,
                      uint8_t* HWY_RESTRICT distance) {
  const LanesTag d16;
  const size_t lanes = hn::Lanes(d16);
  const auto step = hn::Set(d16, least_step);
  const auto unit = hn::Set(d16, static_cast<int16_t>(1 << unit_bits));
  const auto farthest = hn::Set(d16, last), none = hn::Set(d16, int16_t{INT16_MAX});
  const auto one = hn::Set(d16, int16_t{1});
  for (size_t n = 0; n < SliceSamples(count); n += lanes) {
    const auto here = hn::LoadU(d16, near + n), next = hn::LoadU(d16, far + n);
    const auto change = hn::SaturatedSub(here, next), moved_before = hn::LoadU(d16, moved + n);
    // Most vectors are far from every edge.
    if (hn::AllFalse(d16, hn::Or(hn::Gt(change, step), hn::Lt(moved_before, none)))) {
      StoreBytes(d16, hn::Zero(d16), distance + n);
      continue;
    }
    const auto moves_on = hn::SaturatedAdd(moved_before, unit);
    const auto far_away = hn::IfThenElse(hn::Gt(moves_on, farthest), none, moves_on);
    const auto before = hn::LoadU(d16, behind + n);
    const auto so_far = hn::SaturatedSub(here, before);
    const auto ends = hn::Or(hn::Gt(far_away, hn::Min(so_far, farthest)),
                             hn::Gt(change, hn::ShiftRight<kSmallStepBits>(so_far)));
    const auto edge = hn::And(hn::Gt(change, step), ends);
    const auto moves = hn::IfThenZeroElse(edge, far_away);
    const auto surface = hn::IfThenElse(edge, next, before);
    hn::StoreU(moves, d16, moved + n);
    hn::StoreU(surface, d16, behind + n);
    const auto depth = hn::SaturatedSub(here, surface);
    const auto beyond = hn::Gt(moves, hn::Min(depth, farthest));
    const auto hides = hn::AndNot(beyond, hn::Gt(depth, step));
    const auto pixels = hn::Add(hn::ShiftRightSame(moves, unit_bits), one);
    StoreBytes(d16, hn::IfThenElseZero(hides, pixels), distance + n);
  }
}

// Number of depth edges that FindHidden evaluates for a pixel: on each of the four sides, the next
// edge and a second edge behind the next edge.
inline constexpr int kEdges = 8;

// Surfaces beyond the edges of a group of pixels. Edge k is on side k % 4, and is valid if bit k of
// `some` is set. The surfaces are stored in memory, because vectors of some targets have no size at
// compile time.
struct StripSides {
  uint32_t some;
  int16_t unit;  // difference of disparity that moves a pixel of the layer by one pixel
  int16_t rank[kEdges][kSliceLanes], disparity[kEdges][kSliceLanes], second[kEdges][kSliceLanes];
};

// Returns a mask of the lanes in which the hidden pixel, at `disparity`, is covered by a pixel of
// the line that starts at `at`. The pixels of the line are `step` samples apart. A disparity of
// `unit` moves a pixel of the view by one pixel. The pixels of the line up to `last` can cover the
// hidden pixel, and the pixels up to `sure` are inside the field in all lanes. `room` is the number
// of pixels of each lane's line that lie in the field.
template <class D, class V = hn::Vec<D>>
HWY_INLINE hn::Mask<D> FindCovered(D d16, const int16_t* at, ptrdiff_t step, int16_t unit,
                                   int32_t sure, int32_t last, V disparity, V room) {
  const auto reach = static_cast<int16_t>((3 * unit - 1) / 4);
  const auto nearer = hn::SaturatedAdd(disparity, hn::Set(d16, static_cast<int16_t>(unit / 2)));
  // The comparison with `end` tests whether the movement of the pixel differs by at most `reach`
  // from the movement onto the hidden pixel. The comparison with `nearer` tests whether the pixel
  // is sufficiently nearer than the hidden pixel.
  auto start = hn::Sub(hn::Sub(disparity, hn::Set(d16, reach)), hn::Set(d16, INT16_MIN));
  const auto end = hn::Set(d16, static_cast<int16_t>(INT16_MIN + 2 * reach + 1));
  const auto next = hn::Set(d16, unit);
  auto covered = hn::Zero(d16);
  int32_t u = 0;
  const auto covers = [&]() HWY_ATTR {
    const auto here = hn::LoadU(d16, at);
    const auto near = hn::And(hn::Gt(here, nearer), hn::Lt(hn::Sub(here, start), end));
    start = hn::Add(start, next);
    at += step;
    ++u;
    return near;
  };
  while (u <= last && u <= sure) covered = hn::Or(covered, hn::VecFromMask(d16, covers()));
  while (u <= last) {
    const auto outside = hn::Gt(hn::Set(d16, static_cast<int16_t>(u)), room);
    covered = hn::Or(covered, hn::VecFromMask(d16, hn::AndNot(outside, covers())));
  }
  return hn::MaskFromVec(covered);
}

// Does the work of FindCovered for views whose line of pixels is neither a row nor a column. Lane 0
// is in column `column` of the row. Pixels of the line after number `last` cannot cover the hidden
// pixel.
template <class D, class V = hn::Vec<D>>
HWY_INLINE hn::Mask<D> FindCoveredAslant(D d16, const DepthRow& row, const HiddenView& view,
                                         int32_t column, V disparity, int32_t last) {
  const int16_t* const at = row.disparity + column;
  const auto lanes = static_cast<int32_t>(hn::Lanes(d16));
  const auto reach = static_cast<int16_t>((3 * view.unit - 1) / 4);
  const auto nearer =
      hn::SaturatedAdd(disparity, hn::Set(d16, static_cast<int16_t>(view.unit / 2)));
  auto start = hn::Sub(hn::Sub(disparity, hn::Set(d16, reach)), hn::Set(d16, INT16_MIN));
  const auto end = hn::Set(d16, static_cast<int16_t>(INT16_MIN + 2 * reach + 1));
  const auto columns = CountFrom(d16, static_cast<int16_t>(column));
  auto covered = hn::Zero(d16);
  for (int32_t m = 0; m <= last; ++m) {
    const int32_t along = view.side % 2 == 0 ? m : -m;
    const int32_t across = (m * view.slant + (1 << (kSlantBits - 1))) >> kSlantBits;
    const int32_t x = view.side < 2 ? along : across, y = view.side < 2 ? across : along;
    if (y < -row.above || y > row.below) break;
    if (column + x <= -lanes || column + x >= row.width) break;
    const auto here = hn::LoadU(d16, at + y * row.stride + x);
    const auto place = hn::Add(columns, hn::Set(d16, static_cast<int16_t>(x)));
    const auto inside = hn::And(hn::Gt(place, hn::Set(d16, -1)),
                                hn::Lt(place, hn::Set(d16, static_cast<int16_t>(row.width))));
    const auto near = hn::And(hn::Gt(here, nearer), hn::Lt(hn::Sub(here, start), end));
    covered = hn::Or(covered, hn::VecFromMask(d16, hn::And(near, inside)));
    start = hn::Add(start, hn::Set(d16, view.unit));
  }
  return hn::MaskFromVec(covered);
}

// Returns the distance in samples from a pixel to its neighbour on the side `side`.
HWY_INLINE ptrdiff_t StepOf(const DepthRow& row, int side) {
  const ptrdiff_t along = side < 2 ? 1 : row.stride;
  return side % 2 == 0 ? along : -along;
}

// Returns the lanes of a group in which the distance to an edge is not 0; bit k stands for lane k.
// Next to a vertical edge, only a few lanes have a distance other than 0.
HWY_INLINE uint32_t LanesOf(const uint8_t* distances) {
  const hn::CappedTag<uint8_t, kSliceLanes> d8;
  uint32_t lanes = 0;
  for (size_t k = 0; k < kSliceLanes; k += hn::Lanes(d8)) {
    lanes |= BitsOf(d8, hn::Ne(hn::LoadU(d8, distances + k), hn::Zero(d8))) << k;
  }
  return lanes;
}

HWY_INLINE ptrdiff_t LowestLane(uint32_t lanes) {
  return static_cast<ptrdiff_t>(hwy::Num0BitsBelowLS1Bit_Nonzero32(lanes));
}

// Finds the second edge of each pixel in `lanes`, which is the edge behind which the far side of
// the first edge hides a surface. Writes the distances to the surface behind the second edge; other
// distances are not changed. Returns the lanes that have a second edge. Most pixels have no second
// edge.
HWY_INLINE uint32_t FollowEdges(const DepthRow& row, int side, size_t strip, uint32_t lanes,
                                uint8_t* HWY_RESTRICT distances) {
  const ptrdiff_t step = StepOf(row, side);
  const uint8_t* const edges = row.edges[side] + strip;
  const int16_t* const pixels = row.disparity + strip;
  uint32_t found = 0;
  for (; lanes != 0; lanes &= lanes - 1) {
    const ptrdiff_t k = LowestLane(lanes);
    const int32_t more = edges[k + step * edges[k]], distance = edges[k] + more;
    if (more == 0 || distance > kMostDistance) continue;
    const int32_t depth = pixels[k] - pixels[k + step * distance];
    const int32_t room = (depth < INT16_MAX ? depth : INT16_MAX) >> row.unit_bits;
    if (distance - 1 > room) continue;
    distances[k] = static_cast<uint8_t>(distance);
    found |= uint32_t{1} << k;
  }
  return found;
}

// Returns a mask of the lanes in which the hidden pixel, at `disparity`, is covered in a view. The
// disparities of all lanes are at least `low`.
template <class D, class V = hn::Vec<D>>
HWY_INLINE hn::Mask<D> IsCovered(D d16, const DepthRow& row, const HiddenView& view, int32_t column,
                                 V disparity, int32_t low) {
  const int32_t side = view.side, vertical = side == 2 ? row.below : row.above;
  const auto lanes = static_cast<int32_t>(hn::Lanes(d16));
  const int32_t last = (row.high - low) / view.unit + 1;
  if (view.slant != 0) return FindCoveredAslant(d16, row, view, column, disparity, last);
  const auto columns = CountFrom(d16, static_cast<int16_t>(column));
  const auto width = hn::Set(d16, static_cast<int16_t>(row.width - 1));
  const auto room = side == 0   ? hn::Sub(width, columns)
                    : side == 1 ? columns
                                : hn::Set(d16, static_cast<int16_t>(vertical));
  const int32_t end = row.width - lanes - column;
  const int32_t sure = side == 0 ? end : side == 1 ? column : vertical;
  const int32_t most = side == 0   ? row.width - 1 - column
                       : side == 1 ? column + lanes - 1
                                   : vertical;
  return FindCovered(d16, row.disparity + column, StepOf(row, side), view.unit, sure,
                     last < most ? last : most, disparity, room);
}

// Looks behind an edge of each pixel of `lanes`. In the other lanes, the distances to the far sides
// of edges are 0. Writes the result as edge `index`. Sides are in the order of DepthRow::edges.
HWY_INLINE void FindHiddenSide(const DepthRow& row, size_t strip, const uint8_t* distances,
                               uint32_t lanes, int index, StripSides* sides) {
  const LanesTag d16;
  const int side = index % 4;
  const ptrdiff_t step = StepOf(row, side);
  const HiddenView* const views = row.views[side];
  int16_t* const behind = sides->disparity[index];
  const int16_t* const pixels = row.disparity + strip;
  for (size_t k = 0; k < kSliceLanes; k += hn::Lanes(d16)) {
    hn::StoreU(hn::LoadU(d16, pixels + k), d16, behind + k);
  }
  for (; lanes != 0; lanes &= lanes - 1) {
    const ptrdiff_t k = LowestLane(lanes);
    behind[k] = pixels[k + step * distances[k]];
  }
  for (size_t k = 0; k < kSliceLanes; k += hn::Lanes(d16)) {
    const auto column = static_cast<int32_t>(strip + k);
    const auto distance = LoadBytes(d16, distances + k);
    const auto hides = hn::Gt(distance, hn::Zero(d16));
    const auto disparity = hn::LoadU(d16, behind + k);
    const auto high = hn::Set(d16, row.high);
    const int32_t low = hn::GetLane(hn::MinOfLanes(d16, hn::IfThenElse(hides, disparity, high)));
    auto unseen = hides, second = hn::Lt(distance, hn::Zero(d16));
    if (views[0].unit != 0) {
      unseen = hn::And(hides, IsCovered(d16, row, views[0], column, disparity, low));
    }
    if (views[1].unit != 0 && !hn::AllFalse(d16, unseen)) {
      const auto covered = IsCovered(d16, row, views[1], column, disparity, low);
      second = hn::AndNot(covered, unseen);
      unseen = hn::And(covered, unseen);
    }
    const auto far = hn::IfThenElseZero(unseen, hn::Set(d16, kUnseen));
    const auto rank = hn::IfThenElse(hides, hn::Add(distance, far), hn::Set(d16, kNoRank));
    hn::StoreU(rank, d16, sides->rank[index] + k);
    hn::StoreU(hn::VecFromMask(d16, second), d16, sides->second[index] + k);
  }
}

// Returns the source (HiddenRow::source) of the hidden surface that has the rank `best` and the
// given disparity.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V SourceOf(D d16, const StripSides& sides, size_t k, V best, V disparity) {
  auto source = hn::Zero(d16);
  for (uint32_t rest = sides.some; rest != 0; rest &= rest - 1) {
    const ptrdiff_t edge = LowestLane(rest);
    const auto same = hn::And(hn::Eq(hn::LoadU(d16, sides.rank[edge] + k), best),
                              hn::Eq(hn::LoadU(d16, sides.disparity[edge] + k), disparity));
    const auto side = static_cast<int>(edge % 4);
    const auto bit = hn::Set(d16, static_cast<int16_t>(1 << side));
    const auto second_bit = hn::Set(d16, static_cast<int16_t>(1 << (side + kSourceSecond)));
    const auto bits = hn::Or(bit, hn::And(second_bit, hn::LoadU(d16, sides.second[edge] + k)));
    source = hn::Or(source, hn::IfThenElseZero(same, bits));
  }
  const auto unseen = hn::Gt(best, hn::Set(d16, int16_t{kUnseen}));
  const auto distance = hn::IfThenElseZero(unseen, hn::ShiftLeft<kSourceDistance>(best));
  const auto some = hn::Lt(best, hn::Set(d16, kNoRank));
  return hn::IfThenElseZero(some, hn::Or(source, distance));
}

// Writes vector k of a hidden surface, at pixel `n`, and returns the disparities of the surface.
// The surface belongs to the edge with the lowest rank among the edges whose disparity differs from
// `above` by more than a unit. For the first hidden surface, `above` is ignored.
HWY_INLINE LanesVec ChooseSurface(const StripSides& sides, size_t k, int surface, LanesVec above,
                                  size_t n, const HiddenRow& hidden) {
  const LanesTag d16;
  const hn::RebindToUnsigned<LanesTag> du16;
  const auto unit = hn::Set(d16, sides.unit);
  const auto none = hn::Set(d16, kNoRank), nothing = hn::Set(d16, kNoSurface);
  auto best = none, disparity = nothing;
  for (uint32_t rest = sides.some; rest != 0; rest &= rest - 1) {
    const ptrdiff_t edge = LowestLane(rest);
    const auto far = hn::LoadU(d16, sides.disparity[edge] + k);
    auto rank = hn::LoadU(d16, sides.rank[edge] + k);
    if (surface > 0) {
      const auto step = hn::SaturatedSub(hn::Max(far, above), hn::Min(far, above));
      rank = hn::IfThenElse(hn::Gt(step, unit), rank, none);
    }
    const auto same = hn::Eq(rank, best);
    const auto nearest = hn::IfThenElse(same, hn::Max(disparity, far), disparity);
    disparity = hn::IfThenElse(hn::Lt(rank, best), far, nearest);
    best = hn::Min(best, rank);
  }
  const auto some = hn::Lt(best, none);
  const auto chosen = hn::IfThenElse(some, disparity, nothing);
  // `any` is rarely true for the second hidden surface, because most pixels have at most one hidden
  // surface.
  const bool any = !hn::AllFalse(d16, some);
  const auto source = any ? SourceOf(d16, sides, k, best, chosen) : hn::Zero(d16);
  hn::StoreU(chosen, d16, hidden.disparity[surface] + n);
  hn::StoreU(hn::BitCast(du16, source), du16, hidden.source[surface] + n);
  return chosen;
}

// Writes the hidden surfaces of a group of pixels. Returns true if any pixel has a hidden surface.
HWY_INLINE bool ChooseSurfaces(const StripSides& sides, size_t strip, const HiddenRow& hidden) {
  const LanesTag d16;
  const auto nothing = hn::Set(d16, kNoSurface);
  uint32_t found[kSurfaces - 1] = {};
  for (size_t k = 0; k < kSliceLanes; k += hn::Lanes(d16)) {
    auto above = nothing;
    for (int surface = 0; surface < kSurfaces - 1; ++surface) {
      above = ChooseSurface(sides, k, surface, above, strip + k, hidden);
      found[surface] |= BitsOf(d16, hn::Ne(above, nothing)) << k;
    }
  }
  for (int surface = 0; surface < kSurfaces - 1; ++surface) {
    hidden.found[surface][strip / kSliceLanes] = static_cast<uint16_t>(found[surface]);
  }
  return found[0] != 0;  // a pixel with a second hidden surface always has a first hidden surface
}

// Writes the first surface's share of each pixel in a group: kSliceEnd if the surface ends at the
// pixel, otherwise kSliceWhole. Returns the sides with edges, one bit each. Most groups have no
// edges.
HWY_INLINE uint32_t MarkEnds(const DepthRow& row, size_t strip, uint8_t* HWY_RESTRICT share) {
  const hn::CappedTag<uint8_t, kSliceLanes> d8;
  const auto one = hn::Set(d8, uint8_t{1}), none = hn::Zero(d8);
  const auto whole = hn::Set(d8, static_cast<uint8_t>(kSliceWhole));
  uint32_t sides = 0;
  for (size_t n = strip; n < strip + kSliceLanes; n += hn::Lanes(d8)) {
    const auto right = hn::LoadU(d8, row.edges[0] + n), left = hn::LoadU(d8, row.edges[1] + n);
    const auto bottom = hn::LoadU(d8, row.edges[2] + n), top = hn::LoadU(d8, row.edges[3] + n);
    if (hn::AllTrue(d8, hn::Eq(hn::Or(hn::Or(right, left), hn::Or(bottom, top)), none))) {
      hn::StoreU(whole, d8, share + n);
      continue;
    }
    const auto along = hn::Or(hn::Eq(right, one), hn::Eq(left, one));
    const auto across = hn::Or(hn::Eq(bottom, one), hn::Eq(top, one));
    hn::StoreU(hn::IfThenElse(hn::Or(along, across), hn::Set(d8, kSliceEnd), whole), d8, share + n);
    if (!hn::AllTrue(d8, hn::Eq(right, none))) sides |= 1;
    if (!hn::AllTrue(d8, hn::Eq(left, none))) sides |= 2;
    if (!hn::AllTrue(d8, hn::Eq(bottom, none))) sides |= 4;
    if (!hn::AllTrue(d8, hn::Eq(top, none))) sides |= 8;
  }
  return sides;
}

inline uint64_t FindHidden(const DepthRow& row, const HiddenRow& hidden) {
  const LanesTag d16;
  StripSides sides;
  sides.unit = static_cast<int16_t>(1 << row.unit_bits);
  uint64_t strips = 0, bit = 1;
  const auto nothing = hn::Set(d16, kNoSurface);
  const auto width = static_cast<size_t>(row.width);
  for (size_t strip = 0; strip < width; strip += kSliceLanes, bit <<= 1) {
    sides.some = MarkEnds(row, strip, hidden.share);
    if (sides.some == 0) {
      for (size_t n = strip; n < strip + kSliceLanes; n += hn::Lanes(d16)) {
        for (int16_t* disparity : hidden.disparity) hn::StoreU(nothing, d16, disparity + n);
      }
      continue;
    }
    for (int side = 0; side < 4; ++side) {
      if ((sides.some >> side & 1) == 0) continue;
      const uint8_t* const edges = row.edges[side] + strip;
      const uint32_t lanes = LanesOf(edges);
      FindHiddenSide(row, strip, edges, lanes, side, &sides);
      uint8_t next[kSliceLanes] = {};
      const uint32_t more = FollowEdges(row, side, strip, lanes, next);
      if (more == 0) continue;
      sides.some |= 16u << side;
      FindHiddenSide(row, strip, next, more, 4 + side, &sides);
    }
    if (ChooseSurfaces(sides, strip, hidden)) strips |= bit;
  }
  return strips;
}

// Lanes at or beyond `count` are masked before use, because their memory may be uninitialised.
inline void FindSteps(const int16_t* HWY_RESTRICT row, size_t count, int16_t step,
                      StepBits* HWY_RESTRICT steps) {
  const LanesTag d16;
  const auto least = hn::Set(d16, step);
  for (size_t strip = 0; strip < count; strip += kSliceLanes, ++steps) {
    uint32_t falls = 0, rises = 0;
    const size_t end = count - strip < kSliceLanes ? count - strip : kSliceLanes;
    for (size_t k = 0; k < end; k += hn::Lanes(d16)) {
      const int16_t* at = row + strip + k;
      const auto here = hn::LoadU(d16, at), next = hn::LoadU(d16, at + 1);
      const auto counted = hn::FirstN(d16, end - k);
      const auto fall = hn::And(hn::Gt(hn::SaturatedSub(here, next), least), counted);
      const auto rise = hn::And(hn::Gt(hn::SaturatedSub(next, here), least), counted);
      if (hn::AllFalse(d16, hn::Or(fall, rise))) continue;
      falls |= BitsOf(d16, fall) << k;
      rises |= BitsOf(d16, rise) << k;
    }
    *steps = {static_cast<uint16_t>(falls), static_cast<uint16_t>(rises)};
  }
}

inline void BesideSteps(const int16_t* HWY_RESTRICT row, ptrdiff_t stride, size_t count,
                        int16_t step, uint16_t* HWY_RESTRICT beside) {
  const LanesTag d16;
  const auto least = hn::Set(d16, step);
  for (size_t strip = 0; strip < count; strip += kSliceLanes, ++beside) {
    uint32_t bits = 0;
    const size_t end = count - strip < kSliceLanes ? count - strip : kSliceLanes;
    for (size_t k = 0; k < end; k += hn::Lanes(d16)) {
      const int16_t* at = row + strip + k;
      const auto sides = hn::Max(hn::LoadU(d16, at - 1), hn::LoadU(d16, at + 1));
      const auto ends = hn::Max(hn::LoadU(d16, at - stride), hn::LoadU(d16, at + stride));
      const auto nearer = hn::SaturatedSub(hn::Max(sides, ends), hn::LoadU(d16, at));
      const auto edge = hn::And(hn::Gt(nearer, least), hn::FirstN(d16, end - k));
      if (!hn::AllFalse(d16, edge)) bits |= BitsOf(d16, edge) << k;
    }
    *beside = static_cast<uint16_t>(bits);
  }
}

inline uint64_t FindCopies(const int16_t* HWY_RESTRICT row, ptrdiff_t stride, size_t count,
                           int16_t least_step, int16_t most_step, int16_t* HWY_RESTRICT copies) {
  const LanesTag d16;
  const hn::RebindToUnsigned<LanesTag> du16;
  // Steps minus `more` are negative up to `most_step`. As unsigned numbers, the largest of them is
  // therefore that of the largest step up to `most_step`, if there is one.
  const auto more = hn::Set(d16, static_cast<int16_t>(most_step + 1));
  const auto none = hn::Set(d16, kNoSurface), zero = hn::Zero(d16);
  const auto below_least = hn::Set(d16, static_cast<int16_t>(least_step - most_step - 2));
  uint64_t strips = 0;
  for (size_t n = 0; n < SliceSamples(count); n += hn::Lanes(d16)) {
    const auto here = hn::LoadU(d16, row + n);
    auto largest = hn::Zero(du16);
    for (const ptrdiff_t next : {ptrdiff_t{1}, ptrdiff_t{-1}, stride - 1, stride, stride + 1,
                                 -stride - 1, -stride, -stride + 1}) {
      const auto step =
          hn::SaturatedSub(here, hn::LoadU(d16, row + static_cast<ptrdiff_t>(n) + next));
      largest = hn::Max(largest, hn::BitCast(du16, hn::Sub(step, more)));
    }
    const auto less = hn::BitCast(d16, largest);
    const auto inside = hn::FirstN(d16, n < count ? count - n : 0);
    const auto copied = hn::And(hn::And(hn::Gt(less, below_least), hn::Lt(less, zero)), inside);
    const auto copy = hn::Sub(here, hn::Add(less, more));
    hn::StoreU(hn::IfThenElse(copied, copy, none), d16, copies + n);
    if (!hn::AllFalse(d16, copied)) strips |= uint64_t{1} << (n / kSliceLanes);
  }
  return strips;
}

// Moves a lane of `first` to `second` and replaces it by `value`, if the lane is in `inserts`.
HWY_INLINE void InsertLanes(hn::Mask<LanesTag> inserts, LanesVec value, int16_t* HWY_RESTRICT first,
                            int16_t* HWY_RESTRICT second) {
  const LanesTag d16;
  const auto before = hn::LoadU(d16, first);
  hn::StoreU(hn::IfThenElse(inserts, before, hn::LoadU(d16, second)), d16, second);
  hn::StoreU(hn::IfThenElse(inserts, value, before), d16, first);
}

inline void InsertCopies(const int16_t* HWY_RESTRICT row, ptrdiff_t stride,
                         const int16_t* HWY_RESTRICT copies, const int16_t* HWY_RESTRICT rgb,
                         const HiddenGroup& hidden) {
  const LanesTag d16;
  const hn::RebindToUnsigned<decltype(d16)> du16;
  const hn::Rebind<uint8_t, LanesTag> d8;
  const auto mean_of_found = [=](auto has_a, LanesVec a, auto has_b, LanesVec b) HWY_ATTR {
    const auto mean =
        hn::BitCast(d16, hn::AverageRound(hn::BitCast(du16, a), hn::BitCast(du16, b)));
    return hn::IfThenElse(has_a, hn::IfThenElse(has_b, mean, a), b);
  };
  for (size_t n = 0; n < kSliceLanes; n += hn::Lanes(d16)) {
    const auto copy = hn::LoadU(d16, copies + n);
    const auto share = hn::PromoteTo(d16, hn::LoadU(d8, hidden.share + n));
    const auto inserts = hn::And(hn::Gt(copy, hn::LoadU(d16, hidden.disparity[0] + n)),
                                 hn::Eq(share, hn::Set(d16, kSliceWhole)));
    if (hn::AllFalse(d16, inserts)) continue;
    InsertLanes(inserts, copy, hidden.disparity[0] + n, hidden.disparity[1] + n);
    InsertLanes(inserts, hn::Zero(d16), reinterpret_cast<int16_t*>(hidden.source[0] + n),
                reinterpret_cast<int16_t*>(hidden.source[1] + n));
    const int16_t* const at = row + n;
    // Vectors are arguments, because SVE vectors cannot be captured.
    const auto is_copy = [=](LanesVec disparity, ptrdiff_t next)
                             HWY_ATTR { return hn::Eq(hn::LoadU(d16, at + next), disparity); };
    const auto right = is_copy(copy, 1), left = is_copy(copy, -1), below = is_copy(copy, stride),
               above = is_copy(copy, -stride);
    const auto in_row = hn::Or(right, left), in_column = hn::Or(below, above);
    const auto straight = hn::Or(in_row, in_column);
    // Few copies have neighbours along diagonals only.
    const bool is_straight = hn::AllFalse(d16, hn::AndNot(straight, inserts));
    const auto fall_below = is_copy(copy, stride + 1), fall_above = is_copy(copy, -stride - 1);
    const auto rise_below = is_copy(copy, stride - 1), rise_above = is_copy(copy, -stride + 1);
    const auto falls = hn::Or(fall_below, fall_above), rises = hn::Or(rise_below, rise_above);
    for (size_t c = 0; c < 3; ++c) {
      const size_t sample = c * hidden.plane + n;
      const int16_t* const from = rgb + sample;
      const auto mean_of = [=](auto has_a, ptrdiff_t a, auto has_b, ptrdiff_t b) HWY_ATTR {
        return mean_of_found(has_a, hn::LoadU(d16, from + a), has_b, hn::LoadU(d16, from + b));
      };
      const auto along = mean_of(right, 1, left, -1);
      const auto across = mean_of(below, stride, above, -stride);
      auto colour = mean_of_found(in_row, along, in_column, across);
      if (!is_straight) {
        const auto fall = mean_of(fall_below, stride + 1, fall_above, -stride - 1);
        const auto rise = mean_of(rise_below, stride - 1, rise_above, -stride + 1);
        colour = hn::IfThenElse(straight, colour, mean_of_found(falls, fall, rises, rise));
      }
      InsertLanes(inserts, colour, hidden.rgb[0] + sample, hidden.rgb[1] + sample);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace starfocus::simd
HWY_AFTER_NAMESPACE();
