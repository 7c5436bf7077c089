// SPDX-License-Identifier: Apache-2.0
// Test and benchmark calls of the kernels that match views (simd/match.h), choose labels
// (simd/paths.h), and follow the pixels of videos (simd/motion.h).
#include <algorithm>
#include <vector>

#include "simd/match.h"
#include "simd/paths.h"
#include "tests/kernels/kernel_cases.h"

namespace test::depth_cases {
namespace {

constexpr int kTimedPlane = 512, kLongestPlane = 2 * 64 + 3;
constexpr int kMostLabels = 40, kTimedLabels = 44, kLongest = 70, kTimed = 320;
// Largest shift of a view at any label, in pixels.
constexpr int kReach = 5;

}  // namespace

void DeinterleaveRow(Draw* draw, DepthCall* call) {
  const size_t count = draw->Length(0, kLongestPlane, kTimedPlane),
               stride = count + draw->Size(0, 9, 0);
  const uint8_t* rgb = call->Input("rgb", RandomBytes(3 * count, draw));
  auto* plane = call->OutputRows<uint8_t>("planes", 3, stride, count);
  call->Calls(&DepthKernels::DeinterleaveRow, rgb, count, stride, plane);
}

void InterpolateRow(Draw* draw, DepthCall* call) {
  const size_t count = draw->Length(1, kLongestPlane, kTimedPlane);
  const int32_t across = draw->Int(0, 2) == 0 ? 0 : draw->Int(0, 127);
  const int32_t down = draw->Int(0, 2) == 0 ? 0 : draw->Int(0, 127);
  const uint8_t* row = call->Input("row", RandomBytes(count + 1, draw), kPadding);
  const uint8_t* next = call->Input("next", RandomBytes(count + 1, draw), kPadding);
  uint8_t* out = call->Results<uint8_t>("out", count, SliceSamples(count) - count);
  call->Calls(&DepthKernels::InterpolateRow, row, next, across, down, count, out);
}

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
  const auto planes = Ints<uint8_t>(3 * (views + 1) * row.plane, least, 255, draw);
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
  auto* cost = call->OutputRows<uint8_t>("cost", count, places, row.labels,
                                         SliceSamples(row.labels) - row.labels);
  call->Calls(&DepthKernels::CostLabels, row, count, places, cost);
  call->is_right = [=](uint64_t, Met* met) {
    return AllRight(count * places, [&](size_t n) {
      if (n % places >= row.labels) return true;
      ++(*met)[cost[n] == kMostDifference * kCostScale ? "cut off" : "whole"];
      return cost[n] <= kMostDifference * kCostScale;
    });
  };
}

namespace {

constexpr int kMostPathLabels = 70, kTimedPathLabels = 55, kMostCost = 240, kMostJump = 1000;

// Fills a path with random costs as AddPaths stores costs, and returns the smallest cost of the
// path.
int16_t FillPath(size_t labels, Draw* draw, int16_t* path) {
  const int least = draw->Int(0, 240);
  for (size_t l = 0; l < PathLabels(labels); ++l) {
    path[l] = l < labels ? int16_t(least + draw->Int(0, kMostJump + kMostCost)) : kNoLabel;
  }
  path[draw->Int(0, int(labels) - 1)] = int16_t(least);
  return int16_t(least);
}

}  // namespace

void AddPaths(Draw* draw, DepthCall* call) {
  const size_t labels = draw->Length(1, kMostPathLabels, kTimedPathLabels);
  const size_t count = draw->Size(1, 9, 64), places = PathLabels(labels);
  const ptrdiff_t step = draw->Int(0, 1) == 0 ? 1 : -1;
  const size_t first = step > 0 ? 0 : count - 1;  // Index of the first pixel on the path.
  // The path continues from the previous row or from the previous pixel.
  const bool from_row = draw->timed() || draw->Int(0, 1) == 0;
  const auto costs = Ints<uint8_t>(count * places, 0, kMostCost, draw);
  const auto jumps = Ints<int16_t>(count, kSlopeCost, kMostJump, draw);
  std::vector<int16_t> before(1 + count * places, kNoLabel), before_least(count);
  for (size_t k = 0; k < count; ++k) {
    before_least[k] = FillPath(labels, draw, &before[1 + k * places]);
  }
  PathRow row = {};
  row.cost = call->Input("cost", costs, kPadding) + first * places;
  row.jump = call->Input("jump", jumps) + first;
  // `path` has one more pixel on each side, since a path along the row continues from the pixel
  // before the first pixel.
  int16_t* path = call->Output<int16_t>("path", 1 + (count + 2) * places) + 1 + places;
  int16_t* least = call->Output<int16_t>("least", count + 2) + 1;
  auto* sum = call->Results<int16_t>("sum", count * places);
  row.adds = draw->timed() || draw->Int(0, 3) > 0;
  for (size_t k = 0; k < count * places; ++k) {
    sum[k] = k % places < labels ? int16_t(draw->Int(0, 30000)) : kNoLabel;
  }
  for (size_t k = 0; k <= count + 2; ++k)
    path[ptrdiff_t(k * places) - ptrdiff_t(places) - 1] = kNoLabel;
  call->Result(path, count * places);
  call->Result(least, count);
  row.path = path + first * places;
  row.least = least + first;
  row.sum = sum + first * places;
  if (from_row) {
    row.before = call->Input("before", before, kPadding) + 1 + first * places;
    row.before_least = call->Input("before_least", before_least) + first;
  } else {
    int16_t* start = row.path - step * ptrdiff_t(places);
    row.least[-step] = FillPath(labels, draw, start);
    row.before = start;
    row.before_least = row.least - step;
  }
  call->Calls(&DepthKernels::AddPaths, row, labels, step, count);
}

void FindJumps(Draw* draw, DepthCall* call) {
  const size_t count = draw->Length(1, 70, 320), plane = count + draw->Size(0, 9, 0);
  const int least = draw->Int(0, 1) == 0 ? 0 : 240;
  const auto pixels = [&] { return Ints<uint8_t>(2 * plane + count, least, 255, draw); };
  const uint8_t* here = call->Input("here", pixels(), kPadding);
  const uint8_t* before = call->Input("before", pixels(), kPadding);
  auto* jump = call->Results<int16_t>("jump", count);
  call->Calls(&DepthKernels::FindJumps, here, before, plane, count, jump);
  call->is_right = [=](uint64_t, Met* met) {
    return AllRight(count, [&](size_t n) {
      ++(*met)[jump[n] == kLeastJump ? "other colours" : "alike"];
      return jump[n] >= kLeastJump && jump[n] <= kLargestJump;
    });
  };
}

void ChooseLabels(Draw* draw, DepthCall* call) {
  const size_t labels = draw->Length(1, kMostPathLabels, kTimedPathLabels);
  const size_t count = draw->Size(1, 5, 64), places = PathLabels(labels);
  const int most = draw->Int(0, 2) == 0 ? 3 : draw->Int(0, 1) == 0 ? 300 : 12000;
  std::vector<int16_t> sums(count * places);
  for (size_t k = 0; k < sums.size(); ++k) {
    sums[k] = k % places < labels ? int16_t(draw->Int(0, most)) : kNoLabel;
  }
  const int16_t* sum = call->Input("sum", sums, kPadding);
  auto* choice = call->Results<int16_t>("choice", count);
  const bool rates = draw->timed() || draw->Int(0, 3) > 0;
  uint8_t* margin = rates ? call->Results<uint8_t>("margin", count) : nullptr;
  call->Calls(&DepthKernels::ChooseLabels, sum, labels, count, choice, margin);
  call->is_right = [=](uint64_t, Met* met) {
    return AllRight(count, [&](size_t n) {
      const int label = (choice[n] + 32) >> 6;
      ++(*met)[choice[n] % 64 == 0 ? "at a label" : "between labels"];
      if (rates) ++(*met)[margin[n] == 255 ? "sure" : "not sure"];
      return label >= 0 && label < int(labels);
    });
  };
}

namespace {

std::vector<uint8_t> Priors(size_t count, Draw* draw) {
  return Filled<uint8_t>(
      count, [&] { return draw->Int(0, 3) == 0 ? draw->Int(0, kMostPrior) : kMostPrior; });
}

}  // namespace

void PropagatePrior(Draw* draw, DepthCall* call) {
  const size_t places = kSliceLanes * draw->Size(1, 4, 4), count = draw->Length(1, 40, 200);
  const size_t size = places * count;
  const ptrdiff_t step = draw->Int(0, 1) == 0 ? 1 : -1;
  const size_t first = step > 0 ? 0 : size - places;
  auto* prior = call->Results<uint8_t>("prior", size);
  const std::vector<uint8_t> own = Priors(size, draw);
  std::copy(own.begin(), own.end(), prior);
  const uint8_t* before = nullptr;
  if (!draw->Rarely(4)) before = call->Input("before", Priors(size, draw)) + first;
  call->Calls(&DepthKernels::PropagatePrior, prior + first, before, places, step, count);
  // PropagatePrior must not increase the cost of any label.
  call->is_right = [=](uint64_t, Met* met) {
    return AllRight(size, [&](size_t k) {
      ++(*met)[prior[k] < own[k] ? "lessened" : "as it was"];
      return prior[k] <= own[k];
    });
  };
}

void AddPrior(Draw* draw, DepthCall* call) {
  const size_t count = kSliceLanes * draw->Length(1, 9, 64);
  const uint8_t* prior = call->Input("prior", Priors(count, draw));
  auto* cost = call->Results<uint8_t>("cost", count);
  call->Calls(&DepthKernels::AddPrior, prior, count, cost);
}

}  // namespace test::depth_cases

namespace test::video_cases {
namespace {

constexpr size_t kSquareStride = 70;

// Returns two pictures of one size that are noise, or alike.
std::pair<std::vector<uint8_t>, std::vector<uint8_t>> Alike(size_t count, Draw* draw) {
  std::vector<uint8_t> a = RandomBytes(count, draw), b = RandomBytes(count, draw);
  if (draw->Int(0, 2) == 0) return {a, b};
  const int noise = draw->Int(0, 12);
  for (size_t n = 0; n < count; ++n) {
    b[n] = uint8_t(std::clamp(a[n] + draw->Int(-noise, noise), 0, 255));
  }
  return {a, b};
}

}  // namespace

void CompareSquares(Draw* draw, VideoCall* call) {
  const auto [a, b] = Alike(15 * kSquareStride + kCompared, draw);
  const uint8_t *of_a = call->Input("a", a), *of_b = call->Input("b", b);
  call->Calls(&VideoKernels::CompareSquares, of_a, of_b, kSquareStride);
}

void LimitBlock(Draw* draw, VideoCall* call) {
  const auto colours = RandomBytes(9 * kSquareStride + 30, draw);
  const uint8_t* rgb = call->Input("rgb", colours) + kSquareStride + 3;
  auto* limits = call->Results<uint16_t>("limits", kFollowed * kFollowed);
  call->Calls(&VideoKernels::LimitBlock, rgb, kSquareStride, uint16_t(draw->Int(0, 32767)), limits);
}

void FollowBlock(Draw* draw, VideoCall* call) {
  const auto [now, before] = Alike(9 * kSquareStride + 30, draw);
  const size_t stride = draw->Size(8, 20, 8), count = 7 * stride + 8;
  FollowedBlock block = {};
  block.now = call->Input("now", now) + kSquareStride + 3;
  block.before = call->Input("before", before) + kSquareStride + 3;
  block.stride = kSquareStride;
  block.given = call->Input("given", Disparities(count, draw));
  block.known = call->Input("known", Disparities(count, draw));
  block.given_stride = block.known_stride = stride;
  const size_t pixels = kFollowed * kFollowed;
  const uint16_t* limits = call->Input("limits", Ints<uint16_t>(pixels, 0, 7000, draw));
  auto* costs = call->Results<uint16_t>("costs", pixels);
  auto* choices = call->Results<uint16_t>("choices", pixels);
  for (size_t n = 0; n < pixels; ++n) {
    costs[n] = draw->Rarely(3) ? kNoCost : uint16_t(draw->Int(0, 7100));
    choices[n] = uint16_t(draw->Int(0, 8));
  }
  call->Calls(&VideoKernels::FollowBlock, block, limits, uint16_t{9}, costs, choices);
}

}  // namespace test::video_cases
