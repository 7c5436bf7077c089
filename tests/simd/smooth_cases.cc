// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "simd/matting.h"
#include "tests/simd/kernel_cases.h"

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
  SmoothRows rows = {};
  rows.radius = draw->timed() ? 3 : draw->Int(0, 4);
  rows.step = draw->timed() ? 1 : draw->Int(1, 2);
  if (rows.radius % rows.step != 0) rows.step = 1;
  rows.tolerance = draw->Int(0, 1023);
  rows.count = draw->Size(1, int(kMostSmoothRows), int(kMostSmoothRows));
  const size_t first = size_t(rows.radius);
  rows.plane = count + 2 * first + draw->Size(0, 9, 0);
  const int disparity = draw->Int(-kFarthest, kFarthest), colours = draw->Int(0, 255);
  for (size_t k = 0; k < rows.count; ++k) {
    rows.rows[k] =
        call->Input("row", AnyRow(rows.plane, disparity, colours, draw), kPadding) + first;
  }
  rows.own = rows.rows[rows.count / 2];
  auto* smooth = call->Results<int16_t>("smooth", count);
  call->Runs([=](const DepthKernels& kernels) { kernels.SmoothDisparity(rows, count, smooth); });
  call->is_right = [=](uint64_t, Met* met) {
    return AllRight(count, [&](size_t n) {
      ++(*met)[smooth[n] != rows.own[n] ? "smoothed" : "as it was"];
      return std::abs(smooth[n] - rows.own[n]) <= rows.tolerance;
    });
  };
}

}  // namespace test::depth_cases
