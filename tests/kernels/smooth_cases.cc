// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include "simd/matting.h"
#include "tests/kernels/kernel_cases.h"

namespace test::depth_cases {
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
  std::array<const int32_t*, kMostSmoothRows> rows = {};
  for (size_t k = 0; k < height; ++k) {
    rows[k] = call->Input("row", AnyRow(plane, disparity, colours, draw), kPadding) + first;
  }
  const int32_t* own = rows[height / 2];
  auto* smooth = call->Results<int16_t>("smooth", count);
  call->Runs([=](const DepthKernels& kernels) {
    kernels.SmoothDisparity(own, rows.data(), height, plane, radius, step, tolerance, count,
                            smooth);
  });
  call->is_right = [=](uint64_t, Met* met) {
    return AllRight(count, [&](size_t n) {
      ++(*met)[smooth[n] != own[n] ? "smoothed" : "as it was"];
      return std::abs(smooth[n] - own[n]) <= tolerance;
    });
  };
}

}  // namespace test::depth_cases
