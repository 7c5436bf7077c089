// SPDX-License-Identifier: Apache-2.0
// Test and benchmark calls of the kernels in simd/matting.h.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <utility>
#include <vector>

#include "simd/matting.h"
#include "tests/kernels/kernel_cases.h"

namespace test::kernel_cases {
namespace {

CoverView DrawView(Draw* draw) {
  const int move = draw->Int(-64, 64);
  return {int16_t(draw->Int(-16384, 16384)), int16_t(move * 32), int16_t(draw->Int(0, 64)),
          int16_t(draw->Int(0, 200))};
}

std::vector<int16_t> Weights(size_t count, Draw* draw) {
  return Filled<int16_t>(count, [&] {
    const int kind = draw->Int(0, 3);
    return kind == 0 ? 0 : kind == 1 ? 256 : draw->Int(0, 256);
  });
}

// Returns disparities of two surfaces, and a few arbitrary disparities.
std::vector<int16_t> TwoSurfaces(size_t count, Draw* draw) {
  return Filled<int16_t>(count, [&] {
    if (draw->Rarely(20)) return draw->Int(-32768, 32767);
    return (draw->Int(0, 1) == 1 ? 640 : -700) + draw->Int(-40, 40);
  });
}

}  // namespace

void FindBeyond(Draw* draw, KernelCall* call) {
  const size_t rows = draw->Size(1, 3, 64), height = rows + 2 * kBeyondRadius;
  const size_t width = kSliceLanes + 2 * kBeyondRadius, stride = width + draw->Size(0, 5, 0);
  // Half of the fields have one surface, so that some pixels have no edge within reach.
  std::vector<int16_t> disparities = TwoSurfaces(height * stride, draw);
  for (int16_t& d : disparities) d = int16_t(draw->Rarely(30) ? d : std::abs(d % 100));
  const int16_t* field = call->Input("field", disparities) + kBeyondRadius * stride + kBeyondRadius;
  call->IgnoreRows(field - kBeyondRadius * stride - kBeyondRadius + width, height, stride,
                   stride - width);
  const auto step = int16_t(draw->Int(0, 400));
  auto* beyond = call->Results<int16_t>("beyond", rows * kSliceLanes);
  auto* square = call->Results<int16_t>("square", rows * kSliceLanes);
  call->RunsEach(rows, [=](const Kernels& kernels, size_t y) {
    const size_t at = y * kSliceLanes;
    kernels.FindBeyond(field + y * stride, ptrdiff_t(stride), step, beyond + at, square + at);
  });
}

void CoverPlaces(Draw* draw, KernelCall* call) {
  const size_t rows = draw->Size(1, 4, 64);
  const int16_t* near = call->Input("near", TwoSurfaces(rows * kSliceLanes, draw));
  const uint8_t* coverage = call->Input("coverage", RandomBytes(rows * kSliceLanes, draw));
  const int16_t* far = call->Input("far", TwoSurfaces(rows * kSliceLanes, draw));
  const CoverView view = DrawView(draw);
  auto* covered = call->Results<int16_t>("covered", rows * kSliceLanes);
  call->RunsEach(rows, [=](const Kernels& kernels, size_t y) {
    const size_t at = y * kSliceLanes;
    std::fill_n(covered + at, kSliceLanes, int16_t{100});
    kernels.CoverPlaces(near + at, coverage + at, far + at, view, covered + at);
  });
}

void SumNear(Draw* draw, KernelCall* call) {
  const size_t rows = draw->Size(1, 3, 16), height = rows + 2 * kNearRadius;
  const size_t width = kSliceLanes + 2 * kNearRadius, stride = width + draw->Size(0, 5, 0);
  const size_t at = kNearRadius * stride + kNearRadius;
  std::array<const int16_t*, 3> lights;
  for (const int16_t*& light : lights) {
    light = call->Input("light", Light(height * stride, draw)) + at;
  }
  const int16_t* disparity = call->Input("disparity", TwoSurfaces(height * stride, draw)) + at;
  const int16_t* weights = call->Input("weight", Weights(height * stride, draw)) + at;
  const auto most_step = int16_t(draw->Int(0, 400));
  for (const int16_t* plane : {lights[0], lights[1], lights[2], disparity, weights}) {
    call->IgnoreRows(plane - at + width, height, stride, stride - width);
  }
  auto* sums = call->Results<int16_t>("sums", rows * 4 * kSliceLanes);
  call->RunsEach(rows, [=](const Kernels& kernels, size_t y) {
    const size_t row = y * stride;
    const int16_t* const light[] = {lights[0] + row, lights[1] + row, lights[2] + row};
    int16_t of_row[4][kSliceLanes];
    kernels.SumNear(light, disparity + row, weights + row, ptrdiff_t(stride), most_step, of_row);
    std::copy_n(of_row[0], 4 * kSliceLanes, sums + y * 4 * kSliceLanes);
  });
}

}  // namespace test::kernel_cases

namespace test::depth_cases {

// Pixels with few or many colours and disparities, so that similar colours are frequent.
void SumVotes(Draw* draw, DepthCall* call) {
  const int reach = draw->Int(0, 17);
  int step = draw->timed() ? 2 : draw->Int(1, 3);
  while (2 * reach / step >= kMostVoteSide) ++step;
  const ptrdiff_t stride = ptrdiff_t(kSliceLanes) + 2 * reach + draw->Int(0, 9);
  const size_t samples = size_t(stride) * size_t(2 * reach + 1);
  const size_t own = size_t(stride) * size_t(reach) + size_t(reach);
  const int spread = draw->Int(0, 383), rarity = draw->timed() ? 1 : draw->Int(1, 9);
  std::array<const int16_t*, 3> colours;
  for (const int16_t*& colour : colours) {
    colour = call->Input("colour", Ints<int16_t>(samples, -spread, spread, draw)) + own;
  }
  const int16_t* surface = call->Input("surface", Ints<int16_t>(samples, -100, 100, draw)) + own;
  std::vector<int16_t> trusts = Ints<int16_t>(samples, 0, kMostTrust, draw);
  for (int16_t& trust : trusts) trust = draw->Int(1, rarity) > 1 ? int16_t{0} : trust;
  const int16_t* trust = call->Input("trust", trusts) + own;
  const int16_t* middle = call->Input("middle", Ints<int16_t>(kSliceLanes, -100, 100, draw));
  const int16_t* closeness = call->Input(
      "closeness",
      Ints<int16_t>(kMostVoteSide * kMostVoteSide, 0, kMostCloseness * kClosenessUnit, draw));
  auto* sums = call->Results<uint16_t>("sums", 4 * kSliceLanes);
  call->Runs([=](const DepthKernels& kernels) {
    VoteSums votes;
    kernels.SumVotes(colours.data(), surface, trust, middle, stride, reach, step, closeness,
                     &votes);
    for (size_t n = 0; n < kSliceLanes; ++n) {
      for (size_t side = 0; side < 2; ++side) {
        sums[2 * side * kSliceLanes + n] = votes.similar[side][n];
        sums[(2 * side + 1) * kSliceLanes + n] = votes.weight[side][n];
      }
    }
  });
  // No sample counts more than with equal colours.
  call->is_right = [=](uint64_t, Met* met) {
    return AllRight(2 * kSliceLanes, [&](size_t k) {
      const size_t at = k / kSliceLanes * 2 * kSliceLanes + k % kSliceLanes;
      ++(*met)[sums[at] == 0 ? "none" : "similar"];
      return 16 * sums[at] <= kMostSimilar * sums[at + kSliceLanes];
    });
  };
}

namespace {

constexpr int kTimedRow = 512, kLongestRow = 2 * 16 + 3;
constexpr int kFarthest = 500 * 64;  // largest disparity

// Returns the four planes of a row: the disparity and three values of the colour. The disparities
// are either near `disparity` or arbitrary.
std::vector<int32_t> AnyRow(size_t plane, int disparity, int colours, Draw* draw) {
  std::vector<int32_t> row(4 * plane);
  for (size_t n = 0; n < plane; ++n) {
    const int nearby = disparity + draw->Int(-200, 200);
    row[n] = draw->Int(0, 3) == 0 ? draw->Int(-kFarthest, kFarthest)
                                  : std::min(kFarthest, std::max(-kFarthest, nearby));
    const int red = draw->Int(0, colours), green = draw->Int(0, colours);
    const int blue = draw->Int(0, colours);
    row[plane + n] = red + green + blue;
    row[2 * plane + n] = red - green;
    row[3 * plane + n] = green - blue;
  }
  return row;
}

}  // namespace

void SmoothDisparity(Draw* draw, DepthCall* call) {
  const size_t count = draw->Length(1, kLongestRow, kTimedRow);
  const int radius = draw->timed() ? 3 : draw->Int(0, 4);
  const int drawn_step = draw->timed() ? 1 : draw->Int(1, 2);
  const int step = radius % drawn_step == 0 ? drawn_step : 1;
  const int tolerance = draw->Int(0, 1023);
  const size_t height = draw->Size(1, int(kMostSmoothRows), int(kMostSmoothRows));
  const size_t first = size_t(radius);
  const size_t plane = count + 2 * first + draw->Size(0, 9, 0);
  const int disparity = draw->Int(-kFarthest, kFarthest), colours = draw->Int(0, 255);
  std::vector<const int32_t*> rows;
  for (size_t k = 0; k < height; ++k) {
    rows.push_back(call->Input("row", AnyRow(plane, disparity, colours, draw), kPadding) + first);
  }
  const int32_t* const* all = call->Input("rows", rows);
  const int32_t* own = rows[height / 2];
  auto* smooth = call->Results<int16_t>("smooth", count);
  call->Calls(&DepthKernels::SmoothDisparity, own, all, height, plane, radius, step, tolerance,
              count, smooth);
  call->is_right = [=](uint64_t, Met* met) {
    return AllRight(count, [&](size_t n) {
      ++(*met)[smooth[n] != own[n] ? "smoothed" : "as it was"];
      return std::abs(smooth[n] - own[n]) <= tolerance;
    });
  };
}

}  // namespace test::depth_cases
