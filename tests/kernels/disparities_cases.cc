// SPDX-License-Identifier: Apache-2.0
// Test and benchmark calls of the kernels in simd/disparities.h.
#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/kernels/kernel_cases.h"

namespace test::kernel_cases {
namespace {

// Returns disparities in [low, high]: the limits, values halfway between steps of 1/64, and
// arbitrary values.
std::vector<float> DisparitiesWithin(size_t count, float low, float high, Draw* draw) {
  return Filled<float>(count, [&] {
    const int kind = draw->Int(0, 4);
    const double exact = draw->Real(low, high), tie = (std::floor(exact * 64) + 0.5) / 64;
    if (kind < 2) return kind == 0 ? low : high;
    return std::clamp(float(kind == 2 ? tie : exact), low, high);
  });
}

}  // namespace

void ConvertDisparity(Draw* draw, KernelCall* call) {
  constexpr float kLimits[] = {500, 7.3f, 0, 511},
                  kInfinity = std::numeric_limits<float>::infinity();
  const size_t count = draw->Length(1, kLongestBytes, kTimedSamples);
  const float high = kLimits[draw->Int(0, 3)], low = draw->Int(0, 1) == 0 ? -high : high / 2;
  std::vector<float> values = DisparitiesWithin(count, low, high, draw);
  const float outside[] = {std::numeric_limits<float>::quiet_NaN(), kInfinity, -kInfinity,
                           std::nextafter(high, kInfinity), std::nextafter(low, -kInfinity)};
  const bool spoilt = draw->Rarely(3);
  if (spoilt) values[size_t(draw->Int(0, int(count) - 1))] = outside[draw->Int(0, 4)];
  const float* disparity = call->Input("disparity", values, kPadding);
  auto* out = call->Results<int16_t>("out", count);
  call->run = [=](const Kernels& kernels) -> uint64_t {
    return kernels.ConvertDisparity(disparity, count, low, high, out);
  };
  call->is_right = [=](uint64_t all_within, Met* met) {
    if (all_within == 0) call->Free(out, count);
    (*met)["refused"] += all_within == 0;
    return all_within == !spoilt;
  };
}

void FindRanges(Draw* draw, KernelCall* call) {
  const size_t count = draw->Length(1, 70, 128), whole = SliceSamples(count);
  const size_t rows = draw->Size(1, 9, kTimedSamples / 128);
  const size_t stride = count + size_t(draw->Int(0, 5));
  const int most = draw->Int(0, 2) == 0 ? 32767 : 90, absent = draw->Int(0, 4);
  const auto in = Filled<int16_t>((rows - 1) * stride + whole, [&] {
    return draw->Int(0, 3) < absent ? kNoSurface : draw->Int(-most, most);
  });
  const int16_t* disparity = call->Input("disparity", in);
  call->IgnoreRows(disparity + count, rows - 1, stride, stride - count);
  call->Ignore(disparity + (rows - 1) * stride + count, whole - count);
  auto* ranges = call->Results<DisparityRange>("ranges", whole / kSliceLanes);
  call->Runs(
      [=](const Kernels& kernels) { kernels.FindRanges(disparity, stride, rows, count, ranges); });
  call->is_right = [=](uint64_t, Met* met) {
    for (size_t k = 0; k < whole / kSliceLanes; ++k) {
      (*met)[ranges[k].low > ranges[k].high ? "no surface" : "a range"] += 1;
    }
    return true;
  };
}

void FindWithin(Draw* draw, KernelCall* call) {
  const size_t rows = draw->Length(1, 9, kTimedSamples / kSliceLanes);
  const size_t stride = draw->Size(16, 40, kSliceLanes);
  const auto in = Filled<int16_t>((rows - 1) * stride + kSliceLanes, [&] {
    return draw->Int(-40, 40) * (draw->Int(0, 3) == 0 ? 819 : 1);
  });
  const int16_t* disparity = call->Input("disparity", in);
  const auto low = int16_t(draw->Int(-45, 35));
  const auto high = int16_t(draw->Int(0, 3) == 0 ? INT16_MAX : draw->Int(low, 45));
  auto* within = call->Results<uint16_t>("within", rows);
  call->Runs([=](const Kernels& kernels) {
    kernels.FindWithin(disparity, stride, rows, {low, high}, within);
  });
  call->is_right = [=](uint64_t, Met*) {
    return AllRight(rows * kSliceLanes, [&](size_t k) {
      const int16_t d = disparity[k / kSliceLanes * stride + k % kSliceLanes];
      const int bit = within[k / kSliceLanes] >> k % kSliceLanes & 1;
      return bit == int(d >= low && d <= high);
    });
  };
}

}  // namespace test::kernel_cases
