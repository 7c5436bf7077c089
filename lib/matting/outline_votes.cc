// SPDX-License-Identifier: Apache-2.0
#include "lib/matting/outline_votes.h"

#include <algorithm>

#include "lib/base/fixed.h"

namespace starfocus {
namespace {

constexpr int32_t kPixel = 1 << kDisparityBits;
// Largest absolute vote and side.
constexpr int32_t kSure = 127;

// A vote compares a pixel with every second pixel and row within band + kVoteReach pixels. The
// weight of a sample is the product of its trust, its closeness and its similarity.
constexpr int32_t kVoteReach = 7;
constexpr int32_t kMostReach = kMostBand + kVoteReach;
constexpr int32_t kFullTrust = 16, kRidgeTrust = 8, kFullCloseness = 16;
// Squared distance in pixels at which the closeness is a half.
constexpr int32_t kFallOff = 300;
// Weight of colours of the nearer surface that no sample has. Colours of the farther surface go on
// outside the band, but a rim or a thin part of the nearer surface may lie in the band alone.
// The weight is full where farther samples have a weight of at least kFullyFar before similarity.
constexpr int32_t kUnknownNear = 200, kFullyFar = 4096;
// Weight of the side that the map gives to the pixel itself.
constexpr int32_t kGivenSide = 1000;

// Similarity of colours by the sum of absolute differences of red, green and blue, which is large
// up to a few codes (kTight), and small up to kWide.
constexpr int32_t kWide = 96, kTight = 24;
struct Similarity {
  int32_t of[kWide];

  constexpr Similarity() : of() {
    for (int32_t k = 0; k < kWide; ++k) {
      const int32_t wide = kWide - k, tight = k < kTight ? kTight - k : 0;
      of[k] = wide * wide / 2304 + tight * tight * 5 / 2;
    }
  }
};
constexpr Similarity kSimilarity;

int32_t SimilarityOf(const uint8_t* a, const uint8_t* b) {
  const int32_t sum = Abs(a[0] - b[0]) + Abs(a[1] - b[1]) + Abs(a[2] - b[2]);
  return sum < kWide ? kSimilarity.of[sum] : 0;
}

// Trust of a pixel by the absolute value of its distance.
struct Trust {
  uint8_t of[128];

  explicit Trust(const OutlinePass& pass) {
    const int32_t end = kDistance * pass.band, first = pass.trusted * end;
    of[0] = kFullTrust;
    for (int32_t k = 1; k < 128; ++k) {
      const int32_t trust =
          Clamp(kFullTrust * (10 * k - first) / (10 * end - first), 0, kFullTrust);
      of[k] = static_cast<uint8_t>((k & 1) != 0 ? Max(trust, kRidgeTrust) : trust);
    }
  }
};

// Radius of the windows whose votes displace an outline, and of the windows that smooth shifts.
constexpr int32_t kShiftRadius = 4;
// Weight of no displacement against displacements, in units of gains.
constexpr int32_t kStill = 8;
// Radius of the windows in which colours explain votes.
constexpr int32_t kSnapRadius = 3;
// The displaced outline is sure kSure / kSlope pixels away from it.
constexpr int32_t kSlope = 100;
// Variance of noise of the projected colours, in squared quarters of a code: 8 codes.
constexpr int32_t kColourNoise = 1024;

// Smoothed displacement of the outline at a pixel, in 1/kDistance pixel.
int32_t SmoothShift(const OutlineMemory& memory, int32_t x, int32_t y) {
  int32_t weights = kStill, shifts = 0;
  ForBand(memory, memory.Widened({x, y, 1, 1}, kShiftRadius), [&](int32_t, int32_t, size_t at) {
    weights += memory.gain[at];
    shifts += memory.gain[at] * memory.shift[at];
  });
  return shifts / weights;
}

// The colours and votes around a pixel. Colours are relative to the colour of the pixel.
struct SnapWindow {
  static constexpr int32_t kMost = (2 * kSnapRadius + 1) * (2 * kSnapRadius + 1);
  int32_t count = 0, weights = 0;
  int32_t vote[kMost], weight[kMost], colour[kMost][3];

  SnapWindow(const OutlinePicture& picture, const OutlineMemory& memory, const int16_t* map,
             int32_t x, int32_t y) {
    const int32_t middle = memory.middle[memory.At(x, y)];
    const uint8_t* own = picture.Pixel(x, y);
    const Rect around = memory.Widened({x, y, 1, 1}, kSnapRadius);
    for (int32_t row = around.y; row < around.y + around.height; ++row) {
      for (int32_t column = around.x; column < around.x + around.width; ++column, ++count) {
        const size_t at = memory.At(column, row);
        const int32_t outside = map[at] > middle ? kSure : -kSure;
        vote[count] = memory.distance[at] != 0 ? memory.vote[at] : outside;
        weight[count] = Abs(vote[count]) >> 3;
        weights += weight[count];
        const uint8_t* rgb = picture.Pixel(column, row);
        for (int c = 0; c < 3; ++c) colour[count][c] = rgb[c] - own[c];
      }
    }
  }

  // Sets `direction` to the direction in which the colours vary with the votes, with 64 as the
  // largest component. Returns false if they do not vary together.
  bool FindDirection(int32_t* direction) const {
    int64_t votes = 0, colours[3] = {}, products[3] = {}, most = 0;
    for (int32_t k = 0; k < count; ++k) {
      votes += weight[k] * vote[k];
      for (int c = 0; c < 3; ++c) {
        colours[c] += weight[k] * colour[k][c];
        products[c] += weight[k] * vote[k] * colour[k][c];
      }
    }
    for (int c = 0; c < 3; ++c) {
      products[c] = (weights * products[c] - votes * colours[c]) / weights / weights;
      most = std::max(most, products[c] < 0 ? -products[c] : products[c]);
    }
    if (most == 0) return false;
    for (int c = 0; c < 3; ++c) direction[c] = static_cast<int32_t>(64 * products[c] / most);
    return true;
  }

  // Returns the mixture of `otherwise` and of the pixel's side that a linear regression of the
  // votes over the colours predicts. The share of the prediction is the coefficient of
  // determination of the regression: the part of the votes that colours explain.
  int32_t Predict(int32_t otherwise) const {
    int32_t direction[3];
    if (weights == 0 || !FindDirection(direction)) return otherwise;
    int64_t v = 0, c = 0, vv = 0, cc = 0, vc = 0;
    for (int32_t k = 0; k < count; ++k) {
      int32_t along = 0;  // in quarters of a code of the largest component
      for (int i = 0; i < 3; ++i) along += direction[i] * colour[k][i];
      along >>= 4;
      v += weight[k] * vote[k];
      c += weight[k] * along;
      vv += weight[k] * vote[k] * vote[k];
      vc += int64_t{weight[k]} * vote[k] * along;
      cc += int64_t{weight[k]} * along * along;
    }
    const int64_t mean_v = v / weights, mean_c = c / weights;
    const int64_t covariance = vc / weights - mean_v * mean_c;
    const int64_t colours = cc / weights - mean_c * mean_c + kColourNoise;
    const int64_t votes = vv / weights - mean_v * mean_v + 1;
    const int64_t predicted =
        std::clamp<int64_t>(mean_v - covariance * mean_c / colours, -kSure, kSure);
    const int64_t share =
        std::clamp<int64_t>(256 * covariance * covariance / (colours * votes), 0, 256);
    return static_cast<int32_t>((share * predicted + (256 - share) * otherwise) / 256);
  }
};

// Number of clean pixels that give a pixel its disparity, and the distance in 1/kDistance pixel
// beyond half of the map's ramp from which pixels of the band are clean.
constexpr int32_t kCleanPixels = 8, kBesideRamp = 2 * kDistance;

}  // namespace

void VoteByColour(const OutlinePicture& picture, const OutlineMemory& memory,
                  const OutlinePass& pass, const int16_t* map, const Rect& tile) {
  const Trust trust(pass);
  const int32_t reach = pass.band + kVoteReach;
  uint8_t closeness[kMostReach + 1][kMostReach + 1];
  for (int32_t y = 0; y <= reach; ++y) {
    for (int32_t x = 0; x <= reach; ++x) {
      closeness[y][x] =
          static_cast<uint8_t>(kFullCloseness * kFallOff / (kFallOff + x * x + y * y));
    }
  }
  ForBand(memory, tile, [&](int32_t x, int32_t y, size_t at) {
    const int32_t middle = memory.middle[at];
    const uint8_t* own = picture.Pixel(x, y);
    // Weights of farther and nearer samples: at most 18^2 samples of 16 * 16 * 1444.
    int32_t sums[2] = {0, 0}, farther = 0;
    const int32_t left = Max(x - reach, x & 1), right = Min(x + reach, memory.width - 1);
    const int32_t first = left + ((left ^ (x - reach)) & 1);
    for (int32_t row = y - reach; row <= Min(y + reach, memory.height - 1); row += 2) {
      if (row < 0) continue;
      const uint8_t* close = closeness[Abs(row - y)];
      for (int32_t column = first; column <= right; column += 2) {
        const size_t other = memory.At(column, row);
        const int32_t trusted = trust.of[Abs(memory.distance[other])];
        if (trusted == 0) continue;
        const int32_t weight = trusted * close[Abs(column - x)];
        const bool near = map[other] > middle;
        if (!near) farther += weight;
        sums[near ? 1 : 0] += weight * SimilarityOf(own, picture.Pixel(column, row));
      }
    }
    sums[1] += kUnknownNear * Min(farther, kFullyFar) / kFullyFar;
    sums[memory.distance[at] > 0 ? 1 : 0] += kGivenSide;
    memory.vote[at] =
        static_cast<int8_t>(2 * kSure * int64_t{sums[1]} / (int64_t{sums[0]} + sums[1]) - kSure);
  });
}

void ShiftOutlines(const OutlineMemory& memory, const OutlinePass& pass, const Rect& tile) {
  // bins[k] is the sum of the votes k - kZero pixels from the outline, rounded.
  constexpr int32_t kZero = kMostBand + 1, kBins = 2 * kZero + 1;
  ForBand(memory, tile, [&](int32_t x, int32_t y, size_t own) {
    int32_t bins[kBins] = {}, count = 0, farther = 0;
    ForBand(memory, memory.Widened({x, y, 1, 1}, kShiftRadius), [&](int32_t, int32_t, size_t at) {
      bins[kZero + ((memory.distance[at] + 2) >> 2)] += memory.vote[at];
      farther -= memory.vote[at];
      ++count;
    });
    // The agreement, halved, of an outline at k - kZero - 1/2: its nearer side begins with bin k.
    int32_t nearer = -farther, best = INT32_MIN, best_at = 0, unmoved = 0;
    for (int32_t k = 0; k < kBins; ++k) {
      const int32_t to = k - kZero - 1;
      const int32_t agreement = 2 * nearer;
      if (to == 0) unmoved = agreement;
      if (Abs(to) <= pass.band &&
          (agreement > best || (agreement == best && Abs(to) < Abs(best_at)))) {
        best = agreement;
        best_at = to;
      }
      nearer -= bins[k];
    }
    const int32_t gain = best - unmoved;
    const bool clear = 256 * gain > pass.clear * kSure * count;
    memory.shift[own] = static_cast<int8_t>(clear ? -kDistance * best_at : 0);
    memory.gain[own] = static_cast<uint8_t>(clear ? Min(255, 255 * gain / (kSure * count)) : 0);
  });
}

void SnapToColours(const OutlinePicture& picture, const OutlineMemory& memory, const int16_t* map,
                   const Rect& tile) {
  ForBand(memory, tile, [&](int32_t x, int32_t y, size_t at) {
    const int32_t moved = memory.distance[at] + SmoothShift(memory, x, y);
    const int32_t smooth = Clamp(moved * kSlope / kDistance, -kSure, kSure);
    const int32_t side = SnapWindow(picture, memory, map, x, y).Predict(smooth);
    const int32_t given = memory.distance[at] > 0 ? 1 : -1;
    memory.side[at] = static_cast<int8_t>(side == 0 ? given : side);
  });
}

bool IsNearer(const OutlineMemory& memory, const int16_t* map, int32_t x, int32_t y) {
  static constexpr int32_t kWeights[3] = {1, 2, 1};
  const int32_t middle = memory.middle[memory.At(x, y)];
  int32_t sum = 0;
  for (int32_t row = -1; row <= 1; ++row) {
    for (int32_t column = -1; column <= 1; ++column) {
      const size_t at =
          memory.At(Clamp(x + column, 0, memory.width - 1), Clamp(y + row, 0, memory.height - 1));
      const int32_t outside = map[at] > middle ? kSure : -kSure;
      const int32_t side = memory.distance[at] != 0 ? memory.side[at] : outside;
      sum += kWeights[column + 1] * kWeights[row + 1] * side;
    }
  }
  return sum > 0;
}

int16_t DisparityOfSide(const OutlineMemory& memory, const OutlinePass& pass, const int16_t* map,
                        int32_t x, int32_t y) {
  const size_t own = memory.At(x, y);
  const int32_t middle = memory.middle[own], end = kDistance * pass.band - 2;
  const int32_t clean = pass.IsHard() ? 0 : Min(pass.ramp / 2 + kBesideRamp, end);
  const bool near = IsNearer(memory, map, x, y);
  const auto is_clean = [&](size_t at) {
    const int32_t distance = memory.distance[at];
    if ((map[at] > middle) != near) return false;
    return distance == 0 || (Abs(distance) >= clean && (memory.side[at] > 0) == (distance > 0));
  };
  if (is_clean(own)) return map[own];
  int32_t sum = 0, count = 0, first = 0;
  for (int32_t ring = 1; ring <= 2 * pass.band + 2 && count < kCleanPixels; ++ring) {
    const auto visit = [&](int32_t column, int32_t row) {
      if (column < 0 || row < 0 || column >= memory.width || row >= memory.height) return;
      const size_t at = memory.At(column, row);
      if (!is_clean(at)) return;
      if (count == 0) first = map[at];
      if (Abs(map[at] - first) > kPixel) return;
      sum += map[at];
      ++count;
    };
    for (int32_t k = -ring; k <= ring; ++k) {
      visit(x + k, y - ring);
      visit(x + k, y + ring);
      if (Abs(k) == ring) continue;
      visit(x - ring, y + k);
      visit(x + ring, y + k);
    }
  }
  if (count == 0) return map[own];
  return static_cast<int16_t>((2 * sum + (sum < 0 ? -count : count)) / (2 * count));
}

}  // namespace starfocus
