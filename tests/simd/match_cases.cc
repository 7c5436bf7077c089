// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "simd/match.h"
#include "tests/simd/depth_cases.h"

namespace test::depth_cases {
namespace {

using starfocus::simd::DepthKernels;
using starfocus::simd::kMostDifference;
using starfocus::simd::kPadding;
using starfocus::simd::kSliceLanes;
using starfocus::simd::MatchRow;
using starfocus::simd::SliceSamples;

constexpr int kTimed = 512, kLongest = 2 * 64 + 3;

// A row of results in whole groups.
uint8_t* RowOf(DepthCall* call, const char* name, size_t count) {
  uint8_t* row = call->Output<uint8_t>(name, SliceSamples(count));
  call->Result(row, count);
  call->Free(row + count, SliceSamples(count) - count);
  return row;
}

std::vector<uint8_t> Differences(size_t count, Draw* draw) {
  std::vector<uint8_t> row(count);
  for (uint8_t& value : row) {
    value = uint8_t(draw->Int(0, 3) == 0 ? kMostDifference : draw->Int(0, kMostDifference));
  }
  return row;
}

std::vector<int16_t> Highest(size_t count, int limit, Draw* draw) {
  std::vector<int16_t> row(count);
  for (int16_t& value : row) {
    const int kind = draw->Int(0, 5);
    value = int16_t(kind == 0 ? INT16_MIN : kind == 1 ? INT16_MAX : limit + draw->Int(-2, 2));
  }
  return row;
}

}  // namespace

void MatchView(Draw* draw, DepthCall* call) {
  const size_t count = draw->Length(1, kLongest, kTimed);
  MatchRow row = {};
  row.view_stride = count + 1 + draw->Size(0, 20, 64);
  row.across = draw->Int(0, 2) == 0 ? 0 : draw->Int(0, 127);
  row.down = draw->Int(0, 2) == 0 ? 0 : draw->Int(0, 127);
  // Alike pictures as well: differences are cut off where others are.
  const int apart = draw->Int(0, 1) == 0 ? 255 : 30;
  for (int c = 0; c < 3; ++c) {
    std::vector<uint8_t> view(row.view_stride + count + 1), centre(count);
    for (uint8_t& value : view) value = uint8_t(draw->Int(255 - apart, 255));
    for (uint8_t& value : centre) value = uint8_t(draw->Int(255 - apart, 255));
    row.view[c] = call->Input("view", view, kPadding);
    call->Ignore(row.view[c] + count + 1, row.view_stride - count - 1);
    row.centre[c] = call->Input("centre", centre, kPadding);
  }
  uint8_t* difference = RowOf(call, "difference", count);
  call->run = [=](const DepthKernels& kernels) -> uint64_t {
    kernels.MatchView(row, count, difference);
    return 0;
  };
  call->is_right = [=](uint64_t, Met* met) {
    for (size_t n = 0; n < count; ++n) {
      ++(*met)[difference[n] == kMostDifference ? "cut off" : "whole"];
      if (difference[n] > kMostDifference) return false;
    }
    return true;
  };
}

void StandIn(Draw* draw, DepthCall* call) {
  const size_t count = draw->Length(1, kLongest, kTimed);
  const auto limit = int16_t(draw->Rarely(5) ? draw->Int(-32000, 32568) : draw->Int(-900, 900));
  const bool seen = draw->Rarely(8);  // all of both views
  const auto highest = [&] {
    return call->Input("highest",
                       seen ? std::vector<int16_t>(count, INT16_MIN) : Highest(count, limit, draw),
                       kPadding);
  };
  const int16_t* highest_a = highest();
  const int16_t* highest_b = highest();
  uint8_t* a = RowOf(call, "a", count);
  uint8_t* b = RowOf(call, "b", count);
  call->run = [=](const DepthKernels& kernels) -> uint64_t {
    kernels.StandIn(highest_a, highest_b, limit, count, a, b);
    return 0;
  };
}

void LimitHidden(Draw* draw, DepthCall* call) {
  const size_t count = draw->Length(1, kLongest, kTimed);
  const size_t views = draw->timed() ? 16 : size_t(4) << draw->Int(0, 2);
  const auto limit = int16_t(draw->Rarely(5) ? draw->Int(-32000, 32568) : draw->Int(-900, 900));
  // Now and then hidden in all views, which by chance is rare with many of them.
  const int least = draw->Rarely(3) ? 1 : -2;
  std::array<const int16_t*, 16> highest = {};
  std::array<uint8_t*, 16> differences = {};
  for (size_t k = 0; k < views; ++k) {
    std::vector<int16_t> row(count);
    for (int16_t& value : row) value = int16_t(limit + draw->Int(least, 3));
    highest[k] = call->Input("highest", row, kPadding);
    differences[k] = RowOf(call, "difference", count);
  }
  call->run = [=](const DepthKernels& kernels) -> uint64_t {
    kernels.LimitHidden(highest.data(), limit, views, count, differences.data());
    return 0;
  };
}

void LeastSide(Draw* draw, DepthCall* call) {
  const size_t count = draw->Length(1, kLongest, kTimed);
  const int set = draw->timed() ? 2 : draw->Int(0, 2);
  const size_t arms = set == 0 ? 4 : 8, rings = set == 2 ? 2 : 1;
  std::array<const uint8_t*, 16> differences = {};
  for (size_t k = 0; k < arms * rings; ++k) {
    differences[k] = call->Input("differences", Differences(count, draw), kPadding);
  }
  uint8_t* cost = RowOf(call, "cost", count);
  call->run = [=](const DepthKernels& kernels) -> uint64_t {
    kernels.LeastSide(differences.data(), arms, rings, count, cost);
    return 0;
  };
  // The views of a ring that differ least, all at the first arms, cost their mean.
  call->is_right = [=](uint64_t, Met*) {
    for (size_t n = 0; n < count; ++n) {
      double sum = 0;
      for (size_t k = 0; k < arms * rings; ++k) sum += differences[k][n];
      if (cost[n] > sum / double(arms * rings) * starfocus::simd::kCostScale + 1) return false;
    }
    return true;
  };
}

void MeanCost(Draw* draw, DepthCall* call) {
  const size_t count = draw->Length(1, kLongest, kTimed);
  const size_t views = draw->timed() ? 16 : size_t(4) << draw->Int(0, 2);
  std::array<const uint8_t*, 16> differences = {};
  for (size_t k = 0; k < views; ++k) {
    differences[k] = call->Input("differences", Differences(count, draw), kPadding);
  }
  uint8_t* cost = RowOf(call, "cost", count);
  call->run = [=](const DepthKernels& kernels) -> uint64_t {
    kernels.MeanCost(differences.data(), views, count, cost);
    return 0;
  };
}

void GatherLabels(Draw* draw, DepthCall* call) {
  const size_t count = draw->Length(1, kLongest, kTimed);
  const size_t row_stride = count + draw->Size(0, 9, 0);
  const size_t pixel_stride = kSliceLanes * draw->Size(1, 3, 4);
  std::vector<uint8_t> values(row_stride * (kSliceLanes - 1) + count);
  for (uint8_t& value : values) value = draw->Byte();
  const uint8_t* rows = call->Input("rows", values, kPadding);
  for (size_t k = 0; k + 1 < kSliceLanes; ++k) {
    call->Ignore(rows + k * row_stride + count, row_stride - count);
  }
  uint8_t* pixels = call->Output<uint8_t>("pixels", pixel_stride * count);
  for (size_t n = 0; n < count; ++n) call->Result(pixels + n * pixel_stride, kSliceLanes);
  call->run = [=](const DepthKernels& kernels) -> uint64_t {
    kernels.GatherLabels(rows, row_stride, count, pixels, pixel_stride);
    return 0;
  };
}

}  // namespace test::depth_cases
