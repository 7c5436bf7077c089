// SPDX-License-Identifier: Apache-2.0
// The aperture, (3) or another opening, sampled on the grid of rendered views, as integer weights.
#ifndef STARFOCUS_LIB_BASE_VIEW_WEIGHTS_H_
#define STARFOCUS_LIB_BASE_VIEW_WEIGHTS_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/aperture_shape.h"
#include "lib/base/fixed.h"

namespace starfocus {

// Weights of the views (i, j), i^2 + j^2 <= most. All views together sum to exactly
// 2^sum_bits, so that a constant picture comes out unchanged.
struct ViewWeights {
  int32_t n = 0;     // N
  int32_t last = 0;  // i of the outermost view (i, 0)
  int32_t most = 0;
  int sum_bits = 1;
  int most_bits = kMaxLightBits;  // that they may be
  int32_t views = 1;
  double extent = 1;   // of the outermost views of subapertures, of the lens's radius
  int32_t radius = 0;  // of the lens, kSubapertureUnits from view to view
  // Weights hold those of the views 0 <= j <= i <= n at index i (i + 1) / 2 + j, or, when `full`,
  // those of all i, j in [-n, n], columns i one after the other.
  bool full = false;
  const uint16_t* weights = nullptr;

  // Any i, j in [-n, n]; zero outside the disc.
  uint32_t Weight(int32_t i, int32_t j) const {
    if (full) return weights[(i + n) * (2 * n + 1) + j + n];
    if (i < 0) i = -i;
    if (j < 0) j = -j;
    const int32_t high = i > j ? i : j, low = i > j ? j : i;
    return weights[high * (high + 1) / 2 + low];
  }
};

// The radius of the lens in subapertures, kSubapertureUnits of each, for the N of
// ViewsBySubaperture. All are computed: over all radii that N serves, no lens with as many views
// has less than half of the worst error that 123 has at N = 4, and none has less than 32 * 5 - 11
// at N = 5, nor than 94 at N = 3 of those that keep the threshold at every radius
// (lib/analysis/subaperture_rule.h, WorstOfLens; docs/constants.md has the tables).
inline constexpr int32_t kSubapertureUnits = 32;
constexpr int32_t LensInSubapertures(int32_t n) {
  return n == 1 ? kSubapertureUnits : n == 3 ? 94 : n == 4 ? 123 : kSubapertureUnits * n - 11;
}

// Subapertures whose centres lie up to this far beyond the rim are rendered, too: at N = 4 that
// halves the worst error, for the four views on the axes.
inline constexpr int32_t kBeyondRim = 5;

// How far from the axis of a lens the centres of its subapertures lie, kSubapertureUnits; `last`
// and `most` of their ViewWeights.
constexpr int32_t FarthestOfLens(int32_t lens) { return lens + kBeyondRim; }
constexpr int32_t LastOfLens(int32_t lens) { return FarthestOfLens(lens) / kSubapertureUnits; }
constexpr int32_t MostOfLens(int32_t lens) {
  return FarthestOfLens(lens) * FarthestOfLens(lens) / (kSubapertureUnits * kSubapertureUnits);
}
constexpr int32_t LastSubaperture(int32_t n) {
  return n == 0 ? 0 : LastOfLens(LensInSubapertures(n));
}
constexpr int32_t MostOfSubapertures(int32_t n) {
  return n == 0 ? 0 : MostOfLens(LensInSubapertures(n));
}
// Where the last one lies, of the lens's radius.
constexpr double SubapertureExtent(int32_t n) {
  return n == 0
             ? 1
             : static_cast<double>(kSubapertureUnits * LastSubaperture(n)) / LensInSubapertures(n);
}

inline constexpr int32_t kMaxViewsAlongRadius = 256;

// The farthest that the last one lies for any N: 4 views reach beyond the rim.
constexpr double LargestSubapertureExtent() {
  double largest = 1;
  for (int32_t n = 1; n <= kMaxViewsAlongRadius; ++n) {
    largest = SubapertureExtent(n) > largest ? SubapertureExtent(n) : largest;
  }
  return largest;
}

// Number of weights ViewWeights of n stores, of an octant or full.
constexpr size_t ViewWeightsSize(int32_t n) {
  return (static_cast<size_t>(n) + 1) * (static_cast<size_t>(n) + 2) / 2;
}
constexpr size_t FullApertureSize(int32_t n) {
  return (2 * static_cast<size_t>(n) + 1) * (2 * static_cast<size_t>(n) + 1);
}
inline size_t ViewWeightsSize(const ApertureShape& opening, int32_t n) {
  return opening.IsSymmetric() ? ViewWeightsSize(n) : FullApertureSize(n);
}

// The views i^2 + j^2 <= N^2 as in a_{d,N} of (5); of openings other than (3) by what of the light
// through the subaperture around each of them is let through. Fills
// weights[ViewWeightsSize(opening, n)]; n in [0, kMaxViewsAlongRadius]. Before what cat's eyes
// take.
ViewWeights MakeViewWeights(int32_t n, const ApertureShape& opening, uint16_t* weights);

// Views that stand for their subapertures of a lens LensInSubapertures(n) wide, by what of its
// light is theirs: of the subapertures that straddle its rim the part within. n in
// [0, kMaxViewsAlongRadius]; 0 is the centre view alone.
ViewWeights MakeSubapertures(int32_t n, const ApertureShape& opening, uint16_t* weights);

// What a rim behind the opening leaves of the light of `whole`, of N >= 1: all light together stays
// as it is. Fills weights[FullApertureSize(n)].
ViewWeights MakeCatsEye(const ViewWeights& whole, const ApertureShape& opening,
                        const RimShift& shift, uint16_t* weights);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_BASE_VIEW_WEIGHTS_H_
