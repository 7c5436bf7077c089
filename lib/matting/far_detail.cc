// SPDX-License-Identifier: Apache-2.0
#include "lib/matting/far_detail.h"

#include "lib/base/fixed.h"
#include "lib/matting/far_light.h"

namespace starfocus {
namespace {

// Largest distance, along each axis, from a pixel to the pixels that contribute to the mean light
// of the near surface at the pixel.
constexpr int32_t kNearReach = 3;

// The light of the near surface is known if the weights around a pixel sum to 2^kEnoughBits, as for
// four pixels of coverage 1/2.
constexpr int kEnoughBits = 2;

// Mean light of the near surface around a pixel.
struct NearMean {
  int32_t rgb[3];  // 0 if `weight` is 0
  int32_t weight;  // sum of the weights; kKnown for one pixel that the surface covers
};

class DetailAdder {
 public:
  DetailAdder(const CoverageInput& in, int32_t column, int32_t row)
      : map_(*in.map), left_(column * kCoverageTile), top_(row * kCoverageTile) {
    const Input& input = *in.input;
    const int32_t left = left_ - kNearReach, first = Max(0, left);
    const int32_t end = Min(left + kSide, map_.width);
    for (int32_t k = 0; k < kSide; ++k) {
      const int32_t y = top_ - kNearReach + k;
      if (y < 0 || y >= map_.height) continue;
      input.Light(0, first, y, end - first, light_[k] + 3 * (first - left));
      const uint8_t* const coverage = input.given_coverage.Row(y);
      for (int32_t x = first; x < end; ++x) {
        const int32_t alpha = (coverage[x] * kWhole + 127) / 255;
        weights_[k][x - left] = static_cast<int16_t>(EighthPower(alpha));
      }
    }
  }

  void Add() {
    for (int32_t y = 0; y < Min(kCoverageTile, map_.height - top_); ++y) {
      for (int32_t x = 0; x < Min(kCoverageTile, map_.width - left_); ++x) {
        const int32_t alpha = map_.alpha[map_.At(left_ + x, top_ + y)];
        if (alpha > 0 && alpha < kWhole) AddAt(x, y, alpha);
      }
    }
  }

 private:
  static constexpr int32_t kSide = kCoverageTile + 2 * kNearReach;

  NearMean MeanAround(int32_t x, int32_t y) const {
    NearMean mean = {};
    for (int32_t row = y; row <= y + 2 * kNearReach; ++row) {
      for (int32_t column = x; column <= x + 2 * kNearReach; ++column) {
        const int32_t weight = weights_[row][column];
        mean.weight += weight;
        for (int c = 0; c < 3; ++c) mean.rgb[c] += weight * light_[row][3 * column + c];
      }
    }
    for (int c = 0; c < 3 && mean.weight > 0; ++c) mean.rgb[c] /= mean.weight;
    return mean;
  }

  // Adds detail at pixel (x, y) of the tile. The far surface gets (1 - coverage)^3 of the light
  // that both means do not explain, per part of the pixel that it covers.
  void AddAt(int32_t x, int32_t y, int32_t alpha) const {
    const int16_t* const mixed = light_[y + kNearReach] + 3 * (x + kNearReach);
    int16_t* const far = map_.FarAt(left_ + x, top_ + y).rgb;
    const NearMean near = MeanAround(x, y);
    const int32_t rest = kWhole - alpha, cube = rest * rest * rest >> (2 * kAlphaBits);
    // If the light of the near surface is not known, it is assumed to equal the light of the far
    // surface.
    const int32_t known = Min(near.weight, 1 << kEnoughBits);
    for (int c = 0; c < 3; ++c) {
      const int32_t contrast = known * (near.rgb[c] - far[c]) >> kEnoughBits;
      const int64_t detail = (mixed[c] - far[c]) * kWhole - alpha * contrast;
      const auto light = far[c] + static_cast<int32_t>(RoundShift(detail * cube, 2 * kAlphaBits));
      far[c] = static_cast<int16_t>(Clamp(light, ranges::kUnmixed.low, ranges::kUnmixed.high));
    }
  }

  const CoverageMap& map_;
  const int32_t left_, top_;
  // Light and weights (EighthPower of the given coverage) of the tile and of kNearReach pixels on
  // each side. Pixels beyond the picture have weight 0.
  int16_t light_[kSide][3 * kSide] = {};
  int16_t weights_[kSide][kSide] = {};
};

}  // namespace

void AddFarDetail(const CoverageInput& in, int32_t column, int32_t row) {
  DetailAdder(in, column, row).Add();
}

}  // namespace starfocus
