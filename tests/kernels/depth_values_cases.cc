// SPDX-License-Identifier: Apache-2.0
// Test and benchmark calls of the kernels in simd/depth_values.h.
#include <cmath>
#include <limits>

#include "simd/depth_values.h"
#include "tests/kernels/kernel_cases.h"

namespace test::image_cases {
namespace {

constexpr int kLongestDepths = 2 * 32 + 35;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

std::vector<uint16_t> Words(size_t count, Draw* draw) {
  return Filled<uint16_t>(count, [&] { return draw->Next(); });
}

// Returns disparities with 6 fractional bits. The disparities of neighbouring pixels are similar,
// very different, or unknown.
std::vector<int16_t> Row(size_t count, Draw* draw) {
  int value = draw->Int(-2000, 2000);
  return Filled<int16_t>(count, [&] {
    value += draw->Int(0, 3) == 0 ? draw->Int(-4000, 4000) : draw->Int(-kBlendStep, kBlendStep);
    value = std::clamp(value, -32000, 32000);
    return draw->Rarely(12) ? kNoSurface : int16_t(value);
  });
}

DepthRule AnyRule(Draw* draw) {
  DepthRule rule = {};
  rule.reciprocal = draw->Int(0, 1) != 0;
  rule.scale = float(rule.reciprocal ? draw->Real(-30000, 30000) : draw->Real(-0.02, 0.02));
  rule.offset = draw->Int(0, 2) == 0 ? 0 : float(draw->Real(-5, 5));
  rule.invalid = draw->Int(0, 1) == 0 ? kNan : float(1000 * draw->Int(0, 3));
  rule.high = float(draw->Int(0, 1) == 0 ? 500 : 30);
  rule.low = -rule.high;
  return rule;
}

// Returns depth values whose disparities are within the limits of the rule. In a third of the
// calls, some disparities are outside the limits.
std::vector<float> Values(size_t count, const DepthRule& rule, Draw* draw) {
  const float bad[] = {kNan, kInfinity, -kInfinity, 0.0f, -0.0f, 1e-42f, 3e38f, 1e6f};
  const bool spoilt = draw->Rarely(3), invalid = draw->Rarely(2);
  return Filled<float>(count, [&] {
    const float disparity = float(draw->Real(rule.low, rule.high)) - rule.offset;
    const float z = rule.reciprocal ? rule.scale / disparity : disparity / rule.scale;
    if (spoilt && draw->Int(0, 9) == 0) return bad[draw->Int(0, 7)];
    if (invalid && draw->Int(0, 5) == 0) return rule.invalid;
    return std::fabs(z) < 1e30f ? z : 1000;
  });
}

template <class T>
void WidenCase(const std::vector<T>& all, void (*ImageKernels::*kernel)(const T*, size_t, float*),
               ImageCall* call) {
  const size_t count = all.size();
  const T* values = call->Input("values", all);
  auto* z = call->Results<float>("z", count);
  call->Runs([=](const ImageKernels& kernels) { (kernels.*kernel)(values, count, z); });
}

}  // namespace

void BytesToDepth(Draw* draw, ImageCall* call) {
  WidenCase(RandomBytes(draw->Length(1, kLongestDepths, 1024), draw), &ImageKernels::BytesToDepth,
            call);
}

void Depth16ToDepth(Draw* draw, ImageCall* call) {
  std::vector<uint16_t> values = Words(draw->Length(1, kLongestDepths, 1024), draw);
  for (uint16_t& value : values) {  // Unknown distances with any confidence.
    if (draw->Rarely(4)) value &= 0xE000;
  }
  WidenCase(values, &ImageKernels::Depth16ToDepth, call);
}

void WordsToDepth(Draw* draw, ImageCall* call) {
  WidenCase(Words(draw->Length(1, kLongestDepths, 1024), draw), &ImageKernels::WordsToDepth, call);
}

void HalvesToDepth(Draw* draw, ImageCall* call) {
  std::vector<uint16_t> halves = Words(draw->Length(1, kLongestDepths, 1024), draw);
  // Zeros, smallest and largest numbers, infinities and NaN.
  const uint16_t special[] = {0, 0x8000, 1, 0x3FF, 0x400, 0x7BFF, 0x7C00, 0xFC00, 0x7C01, 0xFE00};
  for (uint16_t& half : halves) {
    if (draw->Rarely(4)) half = special[draw->Int(0, 9)];
  }
  WidenCase(halves, &ImageKernels::HalvesToDepth, call);
}

void DepthToDisparity(Draw* draw, ImageCall* call) {
  const DepthRule rule = AnyRule(draw);
  const std::vector<float> all = Values(draw->Length(1, kLongestDepths, 1024), rule, draw);
  const size_t count = all.size();
  const float* z = call->Input("z", all);
  auto* out = call->Results<int16_t>("out", count);
  call->run = [=](const ImageKernels& kernels) -> uint64_t {
    return kernels.DepthToDisparity(z, count, rule, out);
  };
  call->is_right = [=](uint64_t flags, Met* met) {
    ++(*met)[(flags & kUnknownDepth) != 0 ? "unknown" : "all known"];
    ++(*met)[(flags & kDepthOutside) != 0 ? "outside" : "inside"];
    return AllRight(count, [&](size_t n) {
      const float d = (rule.reciprocal ? rule.scale / z[n] : rule.scale * z[n]) + rule.offset;
      const bool known = z[n] != rule.invalid && std::isfinite(d);
      if (known && (d < rule.low || d > rule.high)) {
        call->Free(out + n, 1);
        return (flags & kDepthOutside) != 0;
      }
      return known ? std::fabs(out[n] - 64.0 * double(d)) <= 0.51 : out[n] == kNoSurface;
    });
  };
}

void BlendRows(Draw* draw, ImageCall* call) {
  const size_t count = draw->Length(1, kLongestDepths, 1024);
  const auto share = uint32_t(draw->Int(0, kColumnOne - 1));
  const std::vector<int16_t> first = Row(count, draw);
  std::vector<int16_t> second = first;
  for (int16_t& value : second) {
    if (value != kNoSurface && draw->Int(0, 3) != 0) {
      value =
          int16_t(std::clamp(value + draw->Int(-kBlendStep - 2, kBlendStep + 2), -32000, 32000));
    } else if (draw->Int(0, 1) == 0) {
      value = int16_t(draw->Int(-32000, 32000));
    }
  }
  const int16_t* a = call->Input("a", first);
  const int16_t* b = call->Input("b", second);
  auto* out = call->Results<int16_t>("out", count);
  call->Runs([=](const ImageKernels& kernels) { kernels.BlendRows(a, b, count, share, out); });
  call->is_right = [=](uint64_t, Met* met) {
    return AllRight(count, [&](size_t n) {
      const bool apart = std::abs(a[n] - b[n]) > kBlendStep;
      ++(*met)[apart ? "nearer" : "between"];
      if (apart) return out[n] == (share < kColumnOne / 2 ? a[n] : b[n]);
      return out[n] >= std::min(a[n], b[n]) && out[n] <= std::max(a[n], b[n]);
    });
  };
}

void UpsampleRow(Draw* draw, ImageCall* call) {
  const size_t count = draw->Length(1, kLongestDepths, 1024);
  const auto first = uint32_t(draw->Int(0, 5000));
  const int most = draw->Int(0, 2) == 0 ? int(kColumnOne) : draw->Int(0, int(kColumnOne));
  uint32_t place = first * kColumnOne + uint32_t(draw->Int(0, 3 * kColumnOne));
  const auto places = Filled<uint32_t>(count, [&] {
    const uint32_t here = place;
    place += uint32_t(draw->Int(0, 1) == 0 ? most : draw->Int(0, most));
    return here;
  });
  const size_t used = places.back() / kColumnOne - first + 2;
  const int16_t* row = call->Input("row", Row(used + kUpsampleSpare, draw));
  const uint32_t* columns = call->Input("columns", places);
  auto* out = call->Results<int16_t>("out", count);
  call->Runs(
      [=](const ImageKernels& kernels) { kernels.UpsampleRow(row, columns, count, first, out); });
}

}  // namespace test::image_cases
