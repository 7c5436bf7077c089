// SPDX-License-Identifier: Apache-2.0
#include "lib/slices/slice_stack.h"

namespace starfocus {
namespace {

// A pixel of which slices cover less than this part of all views' light is not made of them. Scenes
// hardly have any, whatever the part (docs/constants.md).
constexpr uint32_t kLeastShare = 4;

// What weights of a group of views are together: in 16 bits with room for a ninth more, which the
// share of the last light may be too large by, and for the rounding of each slice.
constexpr uint32_t kGroupSum = 58000;

}  // namespace

ViewWeights ScaleWeights(const Aperture& aperture) {
  ViewWeights weights = {&aperture, 0, 0};
  uint32_t largest = 0;
  // Columns on either side of the middle are alike but in full apertures.
  for (int32_t i = aperture.full ? -aperture.last : 0; i <= aperture.last; ++i) {
    const int32_t last = weights.LastAcross(Abs(i));
    for (int32_t first = -last; first <= last; first += kGroupViews) {
      uint32_t sum = 0, most = 0;
      for (int32_t j = first; j <= Min(first + kGroupViews - 1, last); ++j) {
        const uint32_t weight = aperture.Weight(i, j);
        sum += weight;
        most = weight > most ? weight : most;
      }
      sum = 4 * most > sum ? 4 * most : sum;
      largest = sum > largest ? sum : largest;
    }
  }
  weights.scale = (uint64_t{kGroupSum} << 16) / largest;
  weights.least_covered =
      static_cast<uint32_t>(((weights.scale << aperture.sum_bits) >> 16) / kLeastShare);
  return weights;
}

}  // namespace starfocus
