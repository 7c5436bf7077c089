// SPDX-License-Identifier: Apache-2.0
// Integer weights of the rendered views: the aperture (3) or another opening, sampled on the grid
// of the views.
#ifndef STARFOCUS_LIB_OPTICS_VIEW_WEIGHTS_H_
#define STARFOCUS_LIB_OPTICS_VIEW_WEIGHTS_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/fixed.h"
#include "lib/optics/opening.h"

namespace starfocus {

// Weights of the views (i, j) with i^2 + j^2 <= most. The weights sum to exactly 2^sum_bits, so
// that a picture of one colour remains unchanged.
struct ViewWeights {
  int32_t n = 0;     // N, the number of views along the radius.
  int32_t last = 0;  // i of the outermost view (i, 0).
  int32_t most = 0;
  int sum_bits = 1;
  int most_bits = kMaxLightBits;  // largest allowed sum_bits
  int32_t views = 1;
  // Distance of the outermost subapertures from the axis of the lens, in radii of the lens.
  double extent = 1;
  // Radius of the lens, in 1 / kSubapertureUnits of the distance between views.
  int32_t radius = 0;
  // If `full` is false, the weight of view 0 <= j <= i <= n is at index i (i + 1) / 2 + j. If
  // `full` is true, the weights of all i, j in [-n, n] are stored, column by column.
  bool full = false;
  const uint16_t* weights = nullptr;

  // Returns the weight of view (i, j) for i and j in [-n, n]; the weight is 0 outside the disc.
  uint32_t Weight(int32_t i, int32_t j) const {
    if (full) return weights[(i + n) * (2 * n + 1) + j + n];
    if (i < 0) i = -i;
    if (j < 0) j = -j;
    const int32_t high = i > j ? i : j, low = i > j ? j : i;
    return weights[high * (high + 1) / 2 + low];
  }
};

// Radius of the lens in subapertures, times kSubapertureUnits, for the N of ViewsBySubaperture. The
// radii are computed, not tuned. The error of a lens radius is the worst error over the blur radii
// that use this N. For N = 4, a lens radius of 123 units (1 / kSubapertureUnits) has at most twice
// the error of any other radius with as many views. For N = 5, no lens radius has a smaller error
// than 32 * 5 - 11 units. For N = 3, a lens radius of 94 units has the smallest error among the
// radii that meet the error threshold at every blur radius. See WorstOfLens in
// examples/lab/analysis/subaperture_rule.h, and the tables in docs/constants.md.
inline constexpr int32_t kSubapertureUnits = 32;
constexpr int32_t LensInSubapertures(int32_t n) {
  return n == 1 ? kSubapertureUnits : n == 3 ? 94 : n == 4 ? 123 : kSubapertureUnits * n - 11;
}

// Largest distance by which the centre of a rendered subaperture may lie outside the rim, in 1 /
// kSubapertureUnits. At N = 4 this distance adds the four outermost views on the axes, which halves
// the worst error.
inline constexpr int32_t kBeyondRim = 5;

// Largest distance of the centre of a subaperture from the axis of the lens, in 1 /
// kSubapertureUnits, and the corresponding `last` and `most` of ViewWeights.
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
// Distance of the outermost subaperture from the axis of the lens, in radii of the lens.
constexpr double SubapertureExtent(int32_t n) {
  return n == 0
             ? 1
             : static_cast<double>(kSubapertureUnits * LastSubaperture(n)) / LensInSubapertures(n);
}

inline constexpr int32_t kMaxViewsAlongRadius = 256;

// Largest SubapertureExtent of any N. The extent exceeds 1 at N = 4, whose views reach beyond the
// rim.
constexpr double LargestSubapertureExtent() {
  double largest = 1;
  for (int32_t n = 1; n <= kMaxViewsAlongRadius; ++n) {
    largest = SubapertureExtent(n) > largest ? SubapertureExtent(n) : largest;
  }
  return largest;
}

// Number of weights that ViewWeights stores for N = n: the weights of one octant, or of all views.
constexpr size_t ViewWeightsSize(int32_t n) {
  return (static_cast<size_t>(n) + 1) * (static_cast<size_t>(n) + 2) / 2;
}
constexpr size_t FullApertureSize(int32_t n) {
  return (2 * static_cast<size_t>(n) + 1) * (2 * static_cast<size_t>(n) + 1);
}
inline size_t ViewWeightsSize(const ApertureShape& opening, int32_t n) {
  return opening.IsSymmetric() ? ViewWeightsSize(n) : FullApertureSize(n);
}

// Computes the weights a_{d,N} of (5) for the views (i, j) with i^2 + j^2 <= N^2. For openings
// other than (3), the weight of a view is the light that passes through the subaperture around the
// view. Fills weights[ViewWeightsSize(opening, n)]; n in [0, kMaxViewsAlongRadius]. The weights
// ignore cat's eyes; MakeCatsEye applies them.
ViewWeights MakeViewWeights(int32_t n, const ApertureShape& opening, uint16_t* weights);

// Computes the weights of views that represent subapertures of a lens of radius
// LensInSubapertures(n). A subaperture that straddles the rim is weighted by the light of its part
// inside the rim. `n` is in [0, kMaxViewsAlongRadius]; n = 0 is the centre view alone.
ViewWeights MakeSubapertures(int32_t n, const ApertureShape& opening, uint16_t* weights);

// Applies the cat's eye of `opening` to the weights `whole`, which have N >= 1. The sum of all
// weights does not change. Fills weights[FullApertureSize(n)].
ViewWeights MakeCatsEye(const ViewWeights& whole, const ApertureShape& opening,
                        const RimShift& shift, uint16_t* weights);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_OPTICS_VIEW_WEIGHTS_H_
