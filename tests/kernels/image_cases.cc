// SPDX-License-Identifier: Apache-2.0
// Test and benchmark calls of the kernels that convert pictures (simd/pixels.h) and depth values
// (simd/depth_values.h).
#include <algorithm>
#include <cmath>
#include <limits>

#include "simd/depth_values.h"
#include "simd/pixels.h"
#include "tests/kernels/kernel_cases.h"

namespace test {
namespace {

// Longest row in pixels: more than two of the widest vectors.
constexpr int kLongestRow = 2 * 64 + 67;

}  // namespace
}  // namespace test

namespace test::image_cases {

void PixelsToRgb(Draw* draw, ImageCall* call) {
  const size_t count = draw->Length(1, kLongestRow, 1024);
  const size_t step = draw->Size(3, 4, 3);
  const bool blue_first = draw->Int(0, 1) != 0;
  // The memory of `pixels` ends with the colours of the last pixel, even if pixels have a fourth
  // byte.
  const uint8_t* pixels = call->Input("pixels", RandomBytes(step * (count - 1) + 3, draw));
  auto* rgb = call->Results<uint8_t>("rgb", 3 * count);
  call->Calls(&ImageKernels::PixelsToRgb, pixels, count, step, blue_first, rgb);
}

void RgbToPixels(Draw* draw, ImageCall* call) {
  const size_t count = draw->Length(1, kLongestRow, 1024);
  const size_t step = draw->Size(3, 4, 3);
  const bool blue_first = draw->Int(0, 1) != 0;
  const uint8_t* rgb = call->Input("rgb", RandomBytes(3 * count, draw));
  auto* pixels = call->Results<uint8_t>("pixels", step * count);
  call->Calls(&ImageKernels::RgbToPixels, rgb, count, step, blue_first, pixels);
}

namespace {

// Returns random coefficients. The largest random coefficients slightly exceed the coefficients of
// all formats.
YuvMatrix AnyMatrix(Draw* draw) {
  YuvMatrix m = {};
  m.black = int16_t(16 * draw->Int(0, 1));
  m.y = int16_t(draw->Int(16384, 19100));
  m.rv = int16_t(draw->Int(11000, 15000));
  m.gu = int16_t(draw->Int(-4000, 0));
  m.gv = int16_t(draw->Int(-7000, 0));
  m.bu = int16_t(draw->Int(14000, 17400));
  const int most = m.black == 0 ? 32768 : 30000;  // keeps white at 255 or less
  m.yr = int16_t(draw->Int(6000, 9798));
  m.yb = int16_t(draw->Int(2000, 3735));
  m.yg = int16_t(draw->Int(0, 1) == 0 ? most - m.yr - m.yb : draw->Int(12000, 16000));
  m.ub = int16_t(draw->Int(14000, 16384));
  m.ug = int16_t(-draw->Int(9000, 12000));
  m.ur = int16_t(-m.ub - m.ug);
  m.vr = int16_t(draw->Int(14000, 16384));
  m.vg = int16_t(-draw->Int(11000, 14000));
  m.vb = int16_t(-m.vr - m.vg);
  return m;
}

}  // namespace

void YuvToRgb(Draw* draw, ImageCall* call) {
  const size_t count = draw->Length(1, kLongestRow, 1024), half = (count + 1) / 2;
  const YuvMatrix m = AnyMatrix(draw);
  const uint8_t* y = call->Input("y", RandomBytes(count, draw));
  const uint8_t* u = call->Input("u", RandomBytes(half, draw));
  const uint8_t* v = call->Input("v", RandomBytes(half, draw));
  auto* rgb = call->Results<uint8_t>("rgb", 3 * count);
  call->Calls(&ImageKernels::YuvToRgb, y, u, v, count, m, rgb);
}

void RgbToLuma(Draw* draw, ImageCall* call) {
  const size_t count = draw->Length(1, kLongestRow, 1024);
  const YuvMatrix m = AnyMatrix(draw);
  const uint8_t* rgb = call->Input("rgb", RandomBytes(3 * count, draw));
  auto* y = call->Results<uint8_t>("y", count);
  call->Calls(&ImageKernels::RgbToLuma, rgb, count, m, y);
}

void RgbToChroma(Draw* draw, ImageCall* call) {
  const size_t count = draw->Length(1, kLongestRow, 1024), half = (count + 1) / 2;
  const YuvMatrix m = AnyMatrix(draw);
  const uint8_t* upper = call->Input("upper", RandomBytes(3 * count, draw));
  const uint8_t* lower = call->Input("lower", RandomBytes(3 * count, draw));
  auto* u = call->Results<uint8_t>("u", half);
  auto* v = call->Results<uint8_t>("v", half);
  call->Calls(&ImageKernels::RgbToChroma, upper, lower, count, m, u, v);
}

void DeinterleavePairs(Draw* draw, ImageCall* call) {
  const size_t count = draw->Length(1, kLongestRow, 1024);
  const uint8_t* pairs = call->Input("pairs", RandomBytes(2 * count, draw));
  auto* first = call->Results<uint8_t>("first", count);
  auto* second = call->Results<uint8_t>("second", count);
  call->Calls(&ImageKernels::DeinterleavePairs, pairs, count, first, second);
}

void JoinPairs(Draw* draw, ImageCall* call) {
  const size_t count = draw->Length(1, kLongestRow, 1024);
  const uint8_t* first = call->Input("first", RandomBytes(count, draw));
  const uint8_t* second = call->Input("second", RandomBytes(count, draw));
  auto* pairs = call->Results<uint8_t>("pairs", 2 * count);
  call->Calls(&ImageKernels::JoinPairs, first, second, count, pairs);
}

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
  call->Calls(kernel, values, count, z);
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
  // kernels_bytes_test.cc converts all half floats.
  WidenCase(Words(draw->Length(1, kLongestDepths, 1024), draw), &ImageKernels::HalvesToDepth, call);
}

void DepthToDisparity(Draw* draw, ImageCall* call) {
  const DepthRule rule = AnyRule(draw);
  const std::vector<float> all = Values(draw->Length(1, kLongestDepths, 1024), rule, draw);
  const size_t count = all.size();
  const float* z = call->Input("z", all);
  auto* out = call->Results<int16_t>("out", count);
  call->Calls(&ImageKernels::DepthToDisparity, z, count, rule, out);
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
  call->Calls(&ImageKernels::BlendRows, a, b, count, share, out);
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
  call->Calls(&ImageKernels::UpsampleRow, row, columns, count, first, out);
}

}  // namespace test::image_cases

namespace test::word_cases {

void YuvWordsToRgb(Draw* draw, WordCall* call) {
  const size_t count = draw->Length(1, kLongestRow, 1024), half = (count + 1) / 2;
  const YuvMatrix m = image_cases::AnyMatrix(draw);
  const uint16_t* y = call->Input("y", image_cases::Words(count, draw));
  const uint16_t* uv = call->Input("uv", image_cases::Words(2 * half, draw));
  auto* rgb = call->Results<uint16_t>("rgb", 3 * count);
  call->Calls(&WordKernels::YuvWordsToRgb, y, uv, count, m, rgb);
}

void RgbToLumaWords(Draw* draw, WordCall* call) {
  const size_t count = draw->Length(1, kLongestRow, 1024);
  const YuvMatrix m = image_cases::AnyMatrix(draw);
  const uint16_t* rgb = call->Input("rgb", image_cases::Words(3 * count, draw));
  auto* y = call->Results<uint16_t>("y", count);
  call->Calls(&WordKernels::RgbToLumaWords, rgb, count, m, y);
}

void RgbToChromaWords(Draw* draw, WordCall* call) {
  const size_t count = draw->Length(1, kLongestRow, 1024), half = (count + 1) / 2;
  const YuvMatrix m = image_cases::AnyMatrix(draw);
  const uint16_t* upper = call->Input("upper", image_cases::Words(3 * count, draw));
  const uint16_t* lower = call->Input("lower", image_cases::Words(3 * count, draw));
  auto* uv = call->Results<uint16_t>("uv", 2 * half);
  call->Calls(&WordKernels::RgbToChromaWords, upper, lower, count, m, uv);
}

// Words of rows that are smooth, or have a small step, somewhere between two codes.
void DitherWords(Draw* draw, WordCall* call) {
  const size_t count = draw->Length(1, kLongestRow, 1024);
  const int most = draw->Int(0, 3) == 0 ? 65535 : draw->Int(0, 40);
  int level = draw->Int(0, 65535);
  const uint16_t* rgb = call->Input("rgb", Filled<uint16_t>(3 * count, [&] {
                                      level = std::clamp(level + draw->Int(-most, most), 0, 65535);
                                      return uint16_t(level);
                                    }));
  const uint16_t* more =
      call->Input("more", Filled<uint16_t>(8, [&] { return uint16_t(draw->Int(0, 255)); }));
  auto* out = call->Results<uint8_t>("out", 3 * count);
  call->Calls(&WordKernels::DitherWords, rgb, count, more, out);
}

}  // namespace test::word_cases
