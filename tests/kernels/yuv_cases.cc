// SPDX-License-Identifier: Apache-2.0
// Test and benchmark calls of the kernels in simd/pixels.h.
#include "simd/pixels.h"
#include "tests/kernels/kernel_cases.h"

namespace test::image_cases {
namespace {

// Longest row in pixels: more than two of the widest vectors.
constexpr int kLongestRow = 2 * 64 + 67;

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
  call->Runs([=](const ImageKernels& kernels) { kernels.YuvToRgb(y, u, v, count, m, rgb); });
}

void RgbToLuma(Draw* draw, ImageCall* call) {
  const size_t count = draw->Length(1, kLongestRow, 1024);
  const YuvMatrix m = AnyMatrix(draw);
  const uint8_t* rgb = call->Input("rgb", RandomBytes(3 * count, draw));
  auto* y = call->Results<uint8_t>("y", count);
  call->Runs([=](const ImageKernels& kernels) { kernels.RgbToLuma(rgb, count, m, y); });
}

void RgbToChroma(Draw* draw, ImageCall* call) {
  const size_t count = draw->Length(1, kLongestRow, 1024), half = (count + 1) / 2;
  const YuvMatrix m = AnyMatrix(draw);
  const uint8_t* upper = call->Input("upper", RandomBytes(3 * count, draw));
  const uint8_t* lower = call->Input("lower", RandomBytes(3 * count, draw));
  auto* u = call->Results<uint8_t>("u", half);
  auto* v = call->Results<uint8_t>("v", half);
  call->Runs(
      [=](const ImageKernels& kernels) { kernels.RgbToChroma(upper, lower, count, m, u, v); });
}

void DeinterleavePairs(Draw* draw, ImageCall* call) {
  const size_t count = draw->Length(1, kLongestRow, 1024);
  const uint8_t* pairs = call->Input("pairs", RandomBytes(2 * count, draw));
  auto* first = call->Results<uint8_t>("first", count);
  auto* second = call->Results<uint8_t>("second", count);
  call->Runs(
      [=](const ImageKernels& kernels) { kernels.DeinterleavePairs(pairs, count, first, second); });
}

void JoinPairs(Draw* draw, ImageCall* call) {
  const size_t count = draw->Length(1, kLongestRow, 1024);
  const uint8_t* first = call->Input("first", RandomBytes(count, draw));
  const uint8_t* second = call->Input("second", RandomBytes(count, draw));
  auto* pairs = call->Results<uint8_t>("pairs", 2 * count);
  call->Runs([=](const ImageKernels& kernels) { kernels.JoinPairs(first, second, count, pairs); });
}

}  // namespace test::image_cases
