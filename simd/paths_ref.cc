// SPDX-License-Identifier: Apache-2.0
#include "simd/paths.h"

namespace starfocus::simd::reference {
namespace {

int Least(int a, int b) { return a < b ? a : b; }

// Returns the term that the path of the previous pixel adds to the cost of label l.
int Onward(const int16_t* before, int least, int jump, size_t l, size_t labels) {
  int onward = Least(before[l] - least, jump);
  if (l > 0) onward = Least(onward, before[l - 1] - least + kSlopeCost);
  if (l + 1 < labels) onward = Least(onward, before[l + 1] - least + kSlopeCost);
  return onward;
}

// Returns the position of the minimum relative to the middle label, from three sums; kChoiceBits
// fractional bits.
int Refine(int left, int middle, int right) {
  const int from_left = left - middle, from_right = right - middle;
  const int most = from_left > from_right ? from_left : from_right;
  return most == 0 ? 0 : (from_left - from_right) * (1 << (kChoiceBits - 1)) / most;
}

}  // namespace

void AddPaths(const PathRow& row, size_t labels, ptrdiff_t step, size_t count) {
  const size_t places = PathLabels(labels);
  for (size_t k = 0; k < count; ++k) {
    const ptrdiff_t pixel = static_cast<ptrdiff_t>(k) * step;
    const ptrdiff_t at = pixel * static_cast<ptrdiff_t>(places);
    int least = kNoLabel;
    for (size_t l = 0; l < labels; ++l) {
      const int path = row.cost[at + static_cast<ptrdiff_t>(l)] +
                       Onward(row.before + at, row.before_least[pixel], row.jump[pixel], l, labels);
      row.path[at + static_cast<ptrdiff_t>(l)] = static_cast<int16_t>(path);
      int16_t& sum = row.sum[at + static_cast<ptrdiff_t>(l)];
      sum = static_cast<int16_t>(row.adds ? sum + path : path);
      least = Least(least, path);
    }
    for (size_t l = labels; l < places; ++l) {
      row.path[at + static_cast<ptrdiff_t>(l)] = row.sum[at + static_cast<ptrdiff_t>(l)] = kNoLabel;
    }
    row.least[pixel] = static_cast<int16_t>(least);
  }
}

void FindJumps(const uint8_t* pixels, const uint8_t* before, size_t plane, size_t count,
               int16_t* jump) {
  for (size_t n = 0; n < count; ++n) {
    int apart = 0;
    for (size_t c = 0; c < 3; ++c) {
      const int by = pixels[n + c * plane] - before[n + c * plane];
      apart += by < 0 ? -by : by;
    }
    const int cost = kLargestJump * kSimilarColours / (kSimilarColours + apart);
    jump[n] = static_cast<int16_t>(cost > kLeastJump ? cost : kLeastJump);
  }
}

void ChooseLabels(const int16_t* sum, size_t labels, size_t count, int16_t* choice,
                  uint8_t* margin) {
  for (size_t n = 0; n < count; ++n, sum += PathLabels(labels)) {
    size_t best = 0;
    for (size_t l = 1; l < labels; ++l) best = sum[l] < sum[best] ? l : best;
    int other = kNoLabel;
    for (size_t l = 0; l < labels; ++l) {
      if (l + 2 <= best || l >= best + 2) other = Least(other, sum[l]);
    }
    int refined = 0;
    if (best > 0 && best + 1 < labels) refined = Refine(sum[best - 1], sum[best], sum[best + 1]);
    choice[n] = static_cast<int16_t>((static_cast<int>(best) << kChoiceBits) + refined);
    if (margin == nullptr) continue;
    margin[n] = static_cast<uint8_t>(Least((other - sum[best]) / 8, 255));
  }
}

}  // namespace starfocus::simd::reference
