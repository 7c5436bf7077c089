// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "simd/match.h"
#include "tests/kernels/kernel_cases.h"

namespace test::depth_cases {
namespace {

constexpr int kTimedPlane = 512, kLongestPlane = 2 * 64 + 3;

}  // namespace

void DeinterleaveRow(Draw* draw, DepthCall* call) {
  const size_t count = draw->Length(0, kLongestPlane, kTimedPlane),
               stride = count + draw->Size(0, 9, 0);
  const uint8_t* rgb = call->Input("rgb", RandomBytes(3 * count, draw));
  uint8_t* plane = call->Output<uint8_t>("planes", 3 * stride);
  call->ResultRows(plane, 3, stride, count);
  call->Runs(
      [=](const DepthKernels& kernels) { kernels.DeinterleaveRow(rgb, count, stride, plane); });
}

void InterpolateRow(Draw* draw, DepthCall* call) {
  const size_t count = draw->Length(1, kLongestPlane, kTimedPlane);
  const int32_t across = draw->Int(0, 2) == 0 ? 0 : draw->Int(0, 127);
  const int32_t down = draw->Int(0, 2) == 0 ? 0 : draw->Int(0, 127);
  const uint8_t* row = call->Input("row", RandomBytes(count + 1, draw), kPadding);
  const uint8_t* next = call->Input("next", RandomBytes(count + 1, draw), kPadding);
  uint8_t* out = call->Results<uint8_t>("out", count, SliceSamples(count) - count);
  call->Runs([=](const DepthKernels& kernels) {
    kernels.InterpolateRow(row, next, across, down, count, out);
  });
  // Each interpolated value must lie between the four surrounding samples.
  call->is_right = [=](uint64_t, Met*) {
    return AllRight(count, [&](size_t n) {
      const auto range = std::minmax({row[n], row[n + 1], next[n], next[n + 1]});
      return out[n] >= range.first && out[n] <= range.second;
    });
  };
}

}  // namespace test::depth_cases
