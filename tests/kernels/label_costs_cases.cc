// SPDX-License-Identifier: Apache-2.0
#include <vector>

#include "simd/match.h"
#include "tests/kernels/kernel_cases.h"

namespace test::depth_cases {
namespace {

constexpr int kMostLabels = 40, kTimedLabels = 44, kLongest = 70, kTimed = 320;
// Largest shift of a view at any label, in pixels.
constexpr int kReach = 5;

}  // namespace

void CostLabels(Draw* draw, DepthCall* call) {
  const size_t count = draw->Length(1, kLongest, kTimed);
  LabelRow row = {};
  row.labels = draw->Size(1, kMostLabels, kTimedLabels);
  const int set = draw->timed() ? 0 : draw->Int(0, 2);
  row.arms = set == 0 ? 4 : 8;
  row.rings = set == 2 ? 2 : 1;
  row.one_side = draw->Int(0, 1) == 0;
  row.limits = draw->timed() || draw->Int(0, 1) == 0;
  row.ends = !draw->timed() && draw->Int(0, 1) == 0;
  // A quarter of the calls have sides of views at any positions. Only small sets have all views.
  static constexpr uint16_t kSides[] = {1, 0x8003, 0xfff0, 0x0ff2};
  row.sides = kSides;
  row.side_count = !draw->timed() && draw->Rarely(4) ? draw->Size(1, 4, 1) : 0;
  row.views = row.side_count == 1 ? draw->Size(1, 16, 1) : row.arms * row.rings;
  if (row.side_count > 1) row.views = kMostMatched;
  const size_t views = row.views;
  // Half of the calls use similar pictures, because the kernel limits large differences.
  const int least = draw->Int(0, 1) == 0 ? 0 : 225;
  row.plane = count + 2 * kReach;
  const auto planes =
      Filled<uint8_t>(3 * (views + 1) * row.plane, [&] { return draw->Int(least, 255); });
  row.pixels = call->Input("planes", planes, kPadding) + kReach;
  // A view does not see a pixel at labels below the value of `hidden`. With many views, random
  // values seldom hide a pixel in all views. Therefore a third of the calls use larger values.
  const int least_hidden = draw->Rarely(3) ? int(row.labels) / 2 : 0;
  const auto hidden = Filled<uint8_t>(views * row.plane, [&] {
    return draw->Int(0, 5) == 0 && row.ends ? kViewEnds : draw->Int(least_hidden, int(row.labels));
  });
  if (!draw->Rarely(4)) row.hidden = call->Input("hidden", hidden, kPadding) + kReach;
  std::vector<ViewMove> moves(row.labels * views);
  for (size_t k = 0; k < moves.size(); ++k) {
    const int by = draw->Int(-kReach, kReach), view = int(k % views), plane = int(row.plane);
    moves[k] = {3 * (view + 1) * plane + by, view * plane + by};
  }
  row.moves = call->Input("moves", moves);
  const size_t places = SliceSamples(row.labels) + 16 * draw->Size(0, 1, 0);
  uint8_t* cost = call->Output<uint8_t>("cost", count * places);
  call->ResultRows(cost, count, places, row.labels, SliceSamples(row.labels) - row.labels);
  call->Runs([=](const DepthKernels& kernels) { kernels.CostLabels(row, count, places, cost); });
  call->is_right = [=](uint64_t, Met* met) {
    return AllRight(count * places, [&](size_t n) {
      if (n % places >= row.labels) return true;
      ++(*met)[cost[n] == kMostDifference * kCostScale ? "cut off" : "whole"];
      return cost[n] <= kMostDifference * kCostScale;
    });
  };
}

}  // namespace test::depth_cases
