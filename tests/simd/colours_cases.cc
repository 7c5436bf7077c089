// SPDX-License-Identifier: Apache-2.0
#include "simd/matting.h"
#include "tests/simd/kernel_cases.h"

namespace test::depth_cases {
namespace {

constexpr int kMostCost = 80;  // largest cost in a sample's key, without the cost of colour

// Returns a random level of a primary colour, one of range + 1 levels; with few levels, similar
// colours are frequent.
int Primary(int range, Draw* draw) { return draw->Int(0, range) * 255 / range; }

// Returns a random sample for CompareColours. On average, one of `rarity` samples has a key and
// takes part in the comparison.
ColourSample AnySample(int groups, int colours, int rarity, Draw* draw) {
  const int red = Primary(colours, draw), green = Primary(colours, draw);
  const int blue = Primary(colours, draw);
  ColourSample sample = {};
  sample.sum = int16_t(red + green + blue);
  sample.red_green = int16_t(red - green);
  sample.green_blue = int16_t(green - blue);
  const bool none = draw->Int(1, rarity) > 1;
  sample.key = none ? kNoColourKey : uint16_t(draw->Int(0, (kMostCost << kColourKeyBits) + 63));
  sample.place = uint16_t(kSliceLanes * size_t(draw->Int(0, groups - 1)));
  return sample;
}

}  // namespace

void CompareColours(Draw* draw, DepthCall* call) {
  const size_t groups = draw->Size(1, 9, 6), stride = kColourWindow + draw->Size(0, 9, 28);
  const int colours = draw->Int(1, 255), rarity = draw->timed() ? 1 : draw->Int(0, 1) * 99 + 1;
  const auto samples = Filled<ColourSample>(
      kColourWindow * stride, [&] { return AnySample(int(groups), colours, rarity, draw); });
  const ColourSample* window = call->Input("window", samples);
  auto* least = call->Results<uint16_t>("least", groups * kSliceLanes);
  std::fill_n(least, groups * kSliceLanes, kNoColourKey);
  call->Runs([=](const DepthKernels& kernels) { kernels.CompareColours(window, stride, least); });
  // In `least`, the key of a group must not be lower than the lowest key of the group's samples.
  call->is_right = [=](uint64_t, Met* met) {
    std::vector<uint16_t> lowest(groups, kNoColourKey);
    for (const ColourSample& sample : samples) {
      uint16_t& of_group = lowest[sample.place / kSliceLanes];
      of_group = std::min(of_group, sample.key);
    }
    return AllRight(groups * kSliceLanes, [&](size_t k) {
      ++(*met)[least[k] == kNoColourKey ? "none" : "found"];
      return least[k] >= lowest[k / kSliceLanes];
    });
  };
}

}  // namespace test::depth_cases
