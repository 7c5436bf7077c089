// SPDX-License-Identifier: Apache-2.0
#include "simd/paths.h"
#include "tests/kernels/kernel_cases.h"

namespace test::depth_cases {
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
  const auto costs = Filled<uint8_t>(count * places, [&] { return draw->Int(0, kMostCost); });
  const auto jumps = Filled<int16_t>(count, [&] { return draw->Int(kSlopeCost, kMostJump); });
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
  call->Runs([=](const DepthKernels& kernels) { kernels.AddPaths(row, labels, step, count); });
}

void FindJumps(Draw* draw, DepthCall* call) {
  const size_t count = draw->Length(1, 70, 320), plane = count + draw->Size(0, 9, 0);
  const int least = draw->Int(0, 1) == 0 ? 0 : 240;
  const auto pixels = [&] {
    const auto planes = Filled<uint8_t>(2 * plane + count, [&] { return draw->Int(least, 255); });
    return call->Input("pixels", planes, kPadding);
  };
  const uint8_t* here = pixels();
  const uint8_t* before = pixels();
  auto* jump = call->Results<int16_t>("jump", count);
  call->Runs(
      [=](const DepthKernels& kernels) { kernels.FindJumps(here, before, plane, count, jump); });
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
  call->Runs([=](const DepthKernels& kernels) {
    kernels.ChooseLabels(sum, labels, count, choice, margin);
  });
  call->is_right = [=](uint64_t, Met* met) {
    return AllRight(count, [&](size_t n) {
      const int label = (choice[n] + 32) >> 6;
      ++(*met)[choice[n] % 64 == 0 ? "at a label" : "between labels"];
      if (rates) ++(*met)[margin[n] == 255 ? "sure" : "not sure"];
      return label >= 0 && label < int(labels);
    });
  };
}

}  // namespace test::depth_cases
