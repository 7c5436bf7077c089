// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>
#include <initializer_list>

#include "simd/layered_depth.h"
#include "simd/samples.h"

namespace starfocus::simd::reference {
namespace {

// The surface beyond one edge of a pixel.
struct HiddenSide {
  int rank;  // rank of the edge, as defined at kUnseen
  int16_t disparity;
  bool second;  // true if only the side's second view shows the surface
};

// Returns true if a view does not show the surface at `disparity` behind pixel x of a row.
bool IsCovered(const DepthRow& row, int32_t x, int16_t disparity, const ViewLook& look) {
  for (int32_t m = 0;; ++m) {
    const int32_t along = look.side % 2 == 0 ? m : -m;
    const int32_t across = (m * look.slant + (1 << (kSlantBits - 1))) >> kSlantBits;
    const int32_t column = x + (look.side < 2 ? along : across);
    const int32_t line = look.side < 2 ? across : along;
    if (column < 0 || column >= row.width || line < -row.above || line > row.below) return false;
    const int32_t nearer = row.disparity[column + line * row.stride] - disparity;
    if (2 * nearer > look.unit && 4 * std::abs(nearer - m * look.unit) < 3 * look.unit) return true;
  }
}

// Number of edges that are followed on each side: the next edge, and the edge beyond the next
// edge's far side.
constexpr int kEdges = 2;

// Returns the distance from pixel x to the far side of an edge, or 0 if there is no such edge.
int DistanceOf(const DepthRow& row, int32_t x, int side, ptrdiff_t step, int edge) {
  const uint8_t* first = row.edges[side] + x;
  if (edge == 0 || *first == 0) return *first;
  const int more = first[step * *first], distance = *first + more;
  if (more == 0 || distance > kMostDistance) return 0;
  const int16_t* here = row.disparity + x;
  const int depth = Saturated(*here - here[step * distance]) >> row.unit_bits;
  return distance - 1 <= depth ? distance : 0;
}

HiddenSide LookBehindSide(const DepthRow& row, int32_t x, int side, int edge) {
  const ptrdiff_t along = side < 2 ? 1 : row.stride, step = side % 2 == 0 ? along : -along;
  const int32_t distance = DistanceOf(row, x, side, step, edge);
  if (distance == 0) return {kNoRank, kNoSurface, false};
  const int16_t disparity = row.disparity[x + step * distance];
  for (const ViewLook& look : row.looks[side]) {
    if (look.unit != 0 && !IsCovered(row, x, disparity, look)) {
      return {distance, disparity, &look != row.looks[side]};
    }
  }
  return {distance + kUnseen, disparity, false};
}

// Writes pixel x of hidden surface `behind` and returns its disparity. The surface must differ from
// `above`, which is the disparity of the hidden surface in front.
int16_t ChooseSurface(const HiddenSide* sides, int32_t x, int behind, int32_t unit, int16_t above,
                      const HiddenRow& hidden) {
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

}  // namespace

void Split(const int16_t* rgb, size_t count, size_t plane, int16_t* out) {
  for (size_t n = 0; n < count; ++n) {
    for (size_t c = 0; c < 3; ++c) out[c * plane + n] = rgb[3 * n + c];
  }
}

void FindEdges(const EdgeRows& rows, const EdgeLimits& limits, size_t count) {
  const int16_t *near = rows.near, *far = rows.far;
  int16_t *moved = rows.moved, *behind = rows.behind;
  for (size_t n = 0; n < SliceSamples(count); ++n) {
    const int16_t farther = Saturated(moved[n] + (1 << limits.unit_bits));
    const int16_t change = Saturated(near[n] - far[n]), so_far = Saturated(near[n] - behind[n]);
    const bool goes_on = farther <= so_far && farther <= FarthestEdge(limits.unit_bits) &&
                         change <= so_far >> kSmallStepBits;
    const bool edge = change > limits.step && !goes_on;
    moved[n] = edge ? int16_t{0} : farther;
    if (edge) behind[n] = far[n];
    const int16_t depth = Saturated(near[n] - behind[n]);
    const bool hides =
        depth > limits.step && moved[n] <= depth && moved[n] <= FarthestEdge(limits.unit_bits);
    rows.distance[n] = static_cast<uint8_t>(hides ? (moved[n] >> limits.unit_bits) + 1 : 0);
  }
}

void FindSteps(const int16_t* row, size_t count, int16_t step, StepBits* steps) {
  for (size_t n = 0; n < count; ++n) {
    StepBits& bits = steps[n / kSliceLanes];
    if (n % kSliceLanes == 0) bits = {0, 0};
    const int fall = row[n] - row[n + 1], bit = 1 << n % kSliceLanes;
    bits.falls = static_cast<uint16_t>(bits.falls | (fall > step ? bit : 0));
    bits.rises = static_cast<uint16_t>(bits.rises | (-fall > step ? bit : 0));
  }
}

void BesideSteps(const int16_t* row, ptrdiff_t stride, size_t count, int16_t step,
                 uint16_t* beside) {
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

uint64_t FindCopies(const int16_t* row, ptrdiff_t stride, size_t count, const CopyLimits& limits,
                    int16_t* copies) {
  uint64_t strips = 0;
  for (size_t n = 0; n < SliceSamples(count); ++n) {
    copies[n] = kNoSurface;
    if (n >= count) continue;
    int16_t farthest = 0;
    for (const ptrdiff_t next : {ptrdiff_t{1}, ptrdiff_t{-1}, stride, -stride}) {
      const int16_t step = Saturated(row[n] - row[static_cast<ptrdiff_t>(n) + next]);
      if (step >= limits.least && step <= limits.most && step > farthest) farthest = step;
    }
    if (farthest == 0) continue;
    copies[n] = static_cast<int16_t>(row[n] - farthest);
    strips |= uint64_t{1} << (n / kSliceLanes);
  }
  return strips;
}

uint64_t LookBehind(const DepthRow& row, const HiddenRow& hidden) {
  uint64_t strips = 0;
  for (int32_t x = 0; x < static_cast<int32_t>(SliceSamples(static_cast<size_t>(row.width))); ++x) {
    HiddenSide sides[4 * kEdges];
    bool end = false;
    for (int side = 0; side < 4; ++side) {
      for (int edge = 0; edge < kEdges; ++edge) {
        sides[4 * edge + side] = LookBehindSide(row, x, side, edge);
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

}  // namespace starfocus::simd::reference
