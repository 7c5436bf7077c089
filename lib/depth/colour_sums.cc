// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/colour_sums.h"

#include <cstring>

#include "lib/base/fixed.h"

namespace starfocus {
namespace {

// Squares are summed in this many bits less.
constexpr int32_t kSquareShift = 2;

}  // namespace

ColourSums::ColourSums(const Rect& rect, ColourSum* sums)
    : rect_(rect), stride_(static_cast<size_t>(rect.width) + 1), sums_(sums) {
  std::memset(static_cast<void*>(sums_), 0, stride_ * sizeof(ColourSum));
}

void ColourSums::AddRow(int32_t y, const uint8_t* colours, const uint8_t* weights) {
  const ColourSum* above = sums_ + static_cast<size_t>(y - rect_.y) * stride_;
  ColourSum* row = sums_ + static_cast<size_t>(y - rect_.y + 1) * stride_;
  row[0] = {};
  ColourSum sum = {};
  for (int32_t x = 0; x < rect_.width; ++x) {
    const uint32_t weight = weights[x];
    if (weight != 0) {
      const uint8_t* colour = colours + 3 * static_cast<size_t>(x);
      const uint32_t r = colour[0], g = colour[1], b = colour[2];
      sum.weight += weight;
      sum.rgb[0] += weight * r;
      sum.rgb[1] += weight * g;
      sum.rgb[2] += weight * b;
      sum.squares += weight * ((r * r + g * g + b * b) >> kSquareShift);
    }
    row[x + 1] = {sum.weight + above[x + 1].weight,
                  {sum.rgb[0] + above[x + 1].rgb[0], sum.rgb[1] + above[x + 1].rgb[1],
                   sum.rgb[2] + above[x + 1].rgb[2]},
                  sum.squares + above[x + 1].squares};
  }
}

ColourSum ColourSums::Window(int32_t x, int32_t y, int32_t radius) const {
  const int32_t left = Max(x - radius - rect_.x, 0), top = Max(y - radius - rect_.y, 0);
  const int32_t right = Min(x + radius + 1 - rect_.x, rect_.width);
  const int32_t bottom = Min(y + radius + 1 - rect_.y, rect_.height);
  const ColourSum* upper = sums_ + static_cast<size_t>(top) * stride_;
  const ColourSum* lower = sums_ + static_cast<size_t>(bottom) * stride_;
  const ColourSum &a = upper[left], &b = upper[right], &c = lower[left], &d = lower[right];
  return {d.weight - c.weight - b.weight + a.weight,
          {d.rgb[0] - c.rgb[0] - b.rgb[0] + a.rgb[0], d.rgb[1] - c.rgb[1] - b.rgb[1] + a.rgb[1],
           d.rgb[2] - c.rgb[2] - b.rgb[2] + a.rgb[2]},
          d.squares - c.squares - b.squares + a.squares};
}

MeanColour ColourSums::MeanAt(int32_t x, int32_t y, const Growth& growth) const {
  int64_t rgb[3] = {}, squares = 0;
  int32_t trust = 0;
  for (int32_t radius = growth.first; radius <= growth.last && trust < kFullTrust; radius *= 2) {
    const ColourSum sum = Window(x, y, radius);
    if (sum.weight == 0) continue;
    const auto weight = static_cast<int64_t>(sum.weight);
    const int64_t share =
        Min(static_cast<int32_t>(Min(static_cast<int32_t>(sum.weight), growth.need) * kFullTrust /
                                 growth.need),
            kFullTrust - trust);
    const int64_t scale = share * (int64_t{1} << kMeanBits);
    for (int k = 0; k < 3; ++k) rgb[k] += sum.rgb[k] * scale / weight;
    squares +=
        static_cast<int64_t>(sum.squares) * share * (1 << (2 * kMeanBits + kSquareShift)) / weight;
    trust += static_cast<int32_t>(share);
  }
  MeanColour mean = {{0, 0, 0}, 0, trust};
  if (trust == 0) return mean;
  int64_t variance = squares / trust;
  for (int k = 0; k < 3; ++k) {
    mean.rgb[k] = static_cast<int32_t>((rgb[k] + trust / 2) / trust);
    variance -= int64_t{mean.rgb[k]} * mean.rgb[k];
  }
  mean.variance = static_cast<int32_t>(variance > 0 ? variance : 0);
  return mean;
}

}  // namespace starfocus
