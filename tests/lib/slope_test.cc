// SPDX-License-Identifier: Apache-2.0
// Tests the radii of a cell on a slope, and the distance by which its blurred pixels are moved.
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "lib/gather/gather.h"
#include "lib/optics/opening.h"
#include "starfocus/starfocus.hpp"
#include "tests/lib/measured_cells.h"

namespace slope_test {
namespace {

using namespace starfocus;

constexpr double kOne = 1 << kSlopeBits;
constexpr int kSide = 40;

// Cells of a plane with disparity `middle` (pixels) between pixels 19 and 20. The disparity changes
// by `across` and `down` from pixel to pixel, and the lens is focused at 0.
struct Plane {
  Plane(double middle, double across, double down, double aperture = 1)
      : disparity(size_t(kSide * kSide)),
        scale({{}, int64_t(aperture * double(1 << starfocus::kStepBits))}) {
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        const double value = middle + across * (x - 19.5) + down * (y - 19.5);
        disparity[size_t(y * kSide + x)] = int16_t(std::lround(value * (1 << kDisparityBits)));
      }
    }
    grid = test::MeasureCells(disparity, kSide, kSide, scale, &cells);
  }
  Plane(const Plane&) = delete;

  // Returns the slope of the cell that has pixels 16 to 23 of the picture.
  Slope Middle(int layer) const { return Slope(grid, scale, 2, 2, layer); }

  std::vector<int16_t> disparity;
  std::vector<starfocus::Cell> cells;
  starfocus::CellGrid grid;
  starfocus::BlurScale scale;
};

TEST_CASE("slope: the radii along a plane follow from the disparities of its pixels") {
  for (const double middle : {5.0, -5.0}) {
    const Plane plane(middle, 0.1, 0.05);
    const Range range = plane.Middle(0).RangeOf({16, 16, 8, 8});
    CHECK(range.first / kOne == doctest::Approx(5 - 3.5 * 0.15).epsilon(0.01));
    CHECK(range.last / kOne == doctest::Approx(5 + 3.5 * 0.15).epsilon(0.01));
    const Range pixel = plane.Middle(0).RangeOf({23, 16, 1, 1});
    CHECK(pixel.first == pixel.last);
    CHECK(pixel.first / kOne ==
          doctest::Approx(std::fabs(middle + 3.5 * 0.1 - 3.5 * 0.05)).epsilon(0.01));
    // Pixels of layer 1 are twice as large, so radii in pixels are half as large.
    const Range layer = plane.Middle(1).RangeOf({11, 8, 1, 1});
    CHECK(layer.first / kOne ==
          doctest::Approx(std::fabs(middle + 3 * 0.1 - 3 * 0.05) / 2).epsilon(0.01));
  }
}

TEST_CASE("slope: the smallest radius is 0 if the focus is within the cell") {
  const Range range = Plane(0, 0.1, 0).Middle(0).RangeOf({16, 16, 8, 8});
  CHECK(range.first == 0);
  CHECK(range.last / kOne == doctest::Approx(0.35).epsilon(0.05));
}

TEST_CASE("slope: shares interpolate linearly between two squared radii") {
  const Plane plane(5, 0.1, 0);
  constexpr size_t kStride = 26;
  int16_t share[2 * kStride];
  const Range between = {4 << kSlopeBits, 6 << kSlopeBits};
  plane.Middle(0).FindMix(between, {16, 19, 8, 2}, kStride, share);
  for (const int16_t* row : {share, share + kStride}) {
    for (int n = 0; n < 8; ++n) {
      const double radius = 5 + 0.1 * (n - 3.5);
      CHECK(row[3 * n] / 32767.0 == doctest::Approx((radius * radius - 16) / 20).epsilon(0.01));
      CHECK(row[3 * n + 1] == row[3 * n]);
      CHECK(row[3 * n + 2] == row[3 * n]);
    }
  }
  plane.Middle(0).FindMix({5 << kSlopeBits, 5 << kSlopeBits}, {16, 20, 8, 1}, kStride, share);
  CHECK(share[0] == 0);
  plane.Middle(0).FindMix({1 << kSlopeBits, 2 << kSlopeBits}, {16, 20, 8, 1}, kStride, share);
  CHECK(share[0] == 32767);
  plane.Middle(0).FindMix({7 << kSlopeBits, 8 << kSlopeBits}, {16, 20, 8, 1}, kStride, share);
  CHECK(share[0] == 0);
}

// Returns the x coordinate of the centroid of the light of all views, which lie on a grid in the
// unit disc. The view at s shows the point p = -s (r + g p).
double CentreOfViews(double radius, double gradient) {
  double sum = 0, views = 0;
  for (int v = -50; v <= 50; ++v) {
    for (int u = -50; u <= 50; ++u) {
      if (u * u + v * v > 50 * 50) continue;
      const double s = u / 50.0;
      sum += -s * radius / (1 + gradient * s);
      ++views;
    }
  }
  return sum / views;
}

TEST_CASE("slope: blurred cells are shifted to the centroid of the light of all views") {
  starfocus::ApertureShape disc;
  disc.shape = STARFOCUS_SHAPE_DISC;
  const int32_t spread = starfocus::MeanSquare(disc);
  for (const double radius : {3.0, -7.0}) {
    for (const double gradient : {0.05, -0.1}) {
      const Plane plane(radius, gradient, 2 * gradient);
      for (const int layer : {0, 1}) {
        const starfocus::simd::HalfMove move = plane.Middle(layer).Move(spread);
        const double expected = CentreOfViews(radius, gradient) / (1 << layer) / 2 * 32768;
        CHECK(move.across == doctest::Approx(expected).epsilon(0.03));
        CHECK(move.down == doctest::Approx(2 * expected).epsilon(0.03));
      }
    }
  }
}

TEST_CASE("slope: MeanSquare has the expected value for each opening") {
  starfocus::ApertureShape opening;
  const auto mean_square = [&] { return starfocus::MeanSquare(opening) / 16384.0; };
  opening.fall_off = starfocus::ApertureFallOff(0.26 * 3.14159265358979);
  CHECK(mean_square() == doctest::Approx(0.1877).epsilon(0.002));
  opening.shape = STARFOCUS_SHAPE_DISC;
  CHECK(mean_square() == doctest::Approx(0.25));
  opening.shape = STARFOCUS_SHAPE_RING;
  opening.inner = 1 << 13;
  CHECK(mean_square() == doctest::Approx(0.3125));
  starfocus::Params lens = test::Params(0, 1, STARFOCUS_MODE_BLUR);
  lens.shape = STARFOCUS_SHAPE_POLYGON;
  lens.blades = 3;
  opening = starfocus::ShapeOf(lens);
  CHECK(mean_square() == doctest::Approx(0.125).epsilon(0.02));
  lens.blades = 6;
  opening = starfocus::ShapeOf(lens);
  CHECK(mean_square() == doctest::Approx(5.0 / 24).epsilon(0.02));
}

}  // namespace
}  // namespace slope_test
