// SPDX-License-Identifier: Apache-2.0
#include "lib/slices/slice_stack.h"

namespace starfocus {
namespace {

// If the coverage of a pixel, summed over all views, is less than 1 / kLeastShare of the largest
// possible sum, the pixel takes the colour of the centre view. No test picture has a pixel with so
// little coverage (docs/constants.md).
constexpr uint32_t kLeastShare = 4;

// Largest sum of the weights of a group of views. The rest of the 16-bit range is for two errors:
// the rounding in each slice, and a contribution that exceeds the weight of its view by up to a
// ninth.
constexpr uint32_t kGroupSum = 58000;

// Limits for apertures with a steep fall-off (theta of at least 0.3 pi), in which the largest
// weight of a view is more than kSteep times the mean weight. ScaleWeights multiplies the weights
// of these apertures until the mean weight is at least kLeastMean, but by a factor of at most
// kMostShares. Each product of a weight and a light value is rounded, so smaller weights would
// change the 8-bit codes of dark pixels.
constexpr uint64_t kSteep = 3;
constexpr uint64_t kLeastMean = 2 * kGroupSum / kGroupViews;
constexpr uint64_t kMostShares = 32;

// Returns the sum of the weights of views (i, first) to (i, last) or four times the largest of
// these weights, whichever is larger.
uint32_t GroupSum(const ViewWeights& aperture, int32_t i, int32_t first, int32_t last) {
  uint32_t sum = 0, most = 0;
  for (int32_t j = first; j <= last; ++j) {
    const uint32_t weight = aperture.Weight(i, j);
    sum += weight;
    most = weight > most ? weight : most;
  }
  return 4 * most > sum ? 4 * most : sum;
}

constexpr int kMostExtraBits = 4;
constexpr int kNoLight = 99;  // result of RankOf for a weight of 0

// Returns the number of times that `weight` can be multiplied by sixteen without exceeding
// `largest`; kNoLight for weight 0.
int RankOf(uint32_t weight, uint32_t largest) {
  int rank = 0;
  for (uint64_t times = weight; times << kMostExtraBits <= largest; ++rank) {
    if (times == 0) return kNoLight;
    times <<= kMostExtraBits;
  }
  return rank;
}

}  // namespace

uint32_t ScaledWeights::Shares(int32_t i, int32_t first, int32_t last) const {
  const uint64_t sum = (GroupSum(*aperture, i, first, last) * scale) >> 16;
  return sum <= kGroupSum ? 1 : static_cast<uint32_t>((sum + kGroupSum - 1) / kGroupSum);
}

int32_t ScaledWeights::LastAlike(int32_t i, int32_t first, int32_t last) const {
  const int rank = RankOf(aperture->Weight(i, first), largest);
  int32_t j = first;
  while (j < last && RankOf(aperture->Weight(i, j + 1), largest) == rank) ++j;
  return j;
}

int ScaledWeights::ExtraBits(int32_t i, int32_t first, int32_t last) const {
  const uint64_t sum = (GroupSum(*aperture, i, first, last) * scale) >> 16;
  int bits = 0;
  while (bits < kMostExtraBits && sum << (bits + 1) <= kGroupSum) ++bits;
  const bool large = RankOf(aperture->Weight(i, first), largest) == 0;
  return 2 * aperture->last < kGroupViews && large ? 0 : bits;
}

ScaledWeights ScaleWeights(const ViewWeights& aperture) {
  ScaledWeights weights = {&aperture, 0, 0, 0};
  uint32_t largest = 0;
  uint64_t views = 0;
  // The weights of columns -i and i are equal, except in full apertures.
  for (int32_t i = aperture.full ? -aperture.last : 0; i <= aperture.last; ++i) {
    const int32_t last = weights.LastAcross(Abs(i));
    for (int32_t j = -last; j <= last; ++j) {
      const uint32_t weight = aperture.Weight(i, j);
      weights.largest = weight > weights.largest ? weight : weights.largest;
      if (weight > 0) views += aperture.full || i == 0 ? 1 : 2;
    }
    for (int32_t first = -last; first <= last; first += kGroupViews) {
      const uint32_t sum = GroupSum(aperture, i, first, Min(first + kGroupViews - 1, last));
      largest = sum > largest ? sum : largest;
    }
  }
  weights.scale = (uint64_t{kGroupSum} << 16) / largest;
  if (weights.largest * views > kSteep << aperture.sum_bits) {
    const uint64_t sum = (weights.scale << aperture.sum_bits) >> 16;
    const uint64_t shares = (views * kLeastMean + sum - 1) / sum;
    weights.scale *= shares < kMostShares ? shares : kMostShares;
  }
  weights.least_covered =
      static_cast<uint32_t>(((weights.scale << aperture.sum_bits) >> 16) / kLeastShare);
  return weights;
}

}  // namespace starfocus
