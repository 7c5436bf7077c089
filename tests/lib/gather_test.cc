// SPDX-License-Identifier: Apache-2.0
// Tests the blur mode against the ideal PSF (4) in double precision. Tests the cells of block mode
// that are blurred by a filter, without rendering views: exactly the smooth cells of a picture.
#include "lib/gather/gather.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/conformance/reference_blur.h"
#include "tests/lib/measured_cells.h"
#include "tests/support/config.h"
#include "tests/support/inside.h"
#include "tests/support/refocused.h"
#include "tests/support/shapes.h"
#include "tests/support/test_scene.h"
#include "tests/support/transfer_curve.h"

namespace gather_test {
namespace {

using namespace starfocus;
using namespace test;

constexpr int kOne = 1 << kDisparityBits;

// Cells of a random map with pieces, slopes and noise.
struct Cells {
  Cells(int width, int height, test::Random* random)
      : disparity(size_t(width) * size_t(height)),
        scale({MakeFocusRange(random->Int(-4 * kOne, 4 * kOne) / double(kOne)),
               int64_t(random->Real(0.2, 1) * double(1 << starfocus::kStepBits))}) {
    const int pieces = random->Int(0, 3), noise = random->Int(0, 40);
    for (int piece = 0; piece <= pieces; ++piece) {
      const int x0 = piece == 0 ? 0 : random->Int(0, width - 1);
      const int y0 = piece == 0 ? 0 : random->Int(0, height - 1);
      const int d = random->Int(-6 * kOne, 6 * kOne);
      const double slope = random->Real(-3, 3);
      for (int y = y0; y < height; ++y) {
        for (int x = x0; x < width; ++x) {
          disparity[size_t(y) * size_t(width) + size_t(x)] =
              int16_t(d + slope * (x + y) + random->Int(0, noise));
        }
      }
    }
    grid = test::MeasureCells(disparity, width, height, scale, &cells);
  }
  Cells(const Cells&) = delete;

  // Returns the largest blur radius of the cell plus half a pixel, rounded up to whole pixels.
  static int Reach(const Cell& cell) {
    return int(std::ceil((cell.r_max + kOne / 2) / double(kOne)));
  }

  // Returns the blur radius of the cell's nearest pixels plus half a pixel, rounded up to whole
  // pixels.
  int NearReach(const Cell& cell) const {
    const double radius = std::ceil(double(scale.step) * std::abs(cell.high - scale.focus.far) /
                                    double(int64_t{1} << starfocus::kStepBits));
    return int(std::ceil((radius + kOne / 2) / double(kOne)));
  }

  // Returns the kind of a cell according to the definition of CellKind, from all cells of the
  // picture.
  CellKind KindOf(int column, int row) const {
    const Cell& own = *grid.At(column, row);
    int low = INT32_MAX, high = INT32_MIN, widest = 0;
    for (int y = 0; y < grid.rows; ++y) {
      for (int x = 0; x < grid.columns; ++x) {
        const Cell& cell = *grid.At(x, y);
        const int between = std::max(std::abs(x - column), std::abs(y - row)) - 1;
        const int nearer = cell.high > own.high ? NearReach(cell) : 0;
        if (between * kCellSize >= std::max(nearer, Reach(own))) continue;
        if (cell.has_edge) return CellKind::kMixed;
        widest = std::max(widest, cell.high - cell.low);
        low = std::min(low, int{cell.low});
        high = std::max(high, int{cell.high});
      }
    }
    const double radius = double(scale.step) / (1 << starfocus::kStepBits);
    const double blur =
        radius * std::max(std::abs(low - scale.focus.far), std::abs(high - scale.focus.far));
    const double of_step = std::max(std::floor(std::floor(blur) / 2) / kOne, 0.125);
    const auto within = [&](int disparities, double most) {
      return double(disparities) / kOne * radius <= most;
    };
    const int range = high - low;
    const bool is_low = within(range, of_step);
    if (within(range, 1.25) && (2 * widest <= range || is_low)) return CellKind::kFlat;
    const bool is_slope = within(widest, 2) && (3 * widest <= 2 * range || is_low);
    return is_slope ? CellKind::kSloped : CellKind::kMixed;
  }

  std::vector<int16_t> disparity;
  std::vector<Cell> cells;
  starfocus::CellGrid grid;
  starfocus::BlurScale scale;
};

TEST_CASE("gather: the kind of each cell (mixed, sloped or flat) matches the definition") {
  test::Random random(61);
  int found[3] = {0, 0, 0};
  for (int round = 0; round < 60; ++round) {
    const Cells cells(random.Int(1, 120), random.Int(1, 100), &random);
    const int around = test::BordersOf(12).cells;
    for (int row = 0; row < cells.grid.rows; ++row) {
      for (int column = 0; column < cells.grid.columns; ++column) {
        const CellKind expected = cells.KindOf(column, row);
        CHECK((test::KindOf(cells.grid, cells.scale, column, row, around) == expected));
        ++found[int(expected)];
      }
    }
  }
  CHECK(found[int(CellKind::kMixed)] > 500);
  CHECK(found[int(CellKind::kSloped)] > 100);
  CHECK(found[int(CellKind::kFlat)] > 500);
}

// Returns the reference of a picture in blur mode. PSFs of pixels behind the focus are rotated by
// 180 degrees.
std::vector<double> BlurredByReference(const test::Scene& scene, const starfocus::Params& params,
                                       int transfer) {
  const reference::ApertureShape opening(params);
  double light[256];
  for (int code = 0; code < 256; ++code) light[code] = test::LightOf(code, transfer);
  const auto rounded = [](double disparity) { return int(std::floor(disparity * kOne + 0.5)); };
  const int far = rounded(params.focus - params.focus_farther);
  const int near = rounded(params.focus + params.focus_nearer);
  std::vector<double> out;
  for (int y = 0; y < scene.height; ++y) {
    for (int x = 0; x < scene.width; ++x) {
      const int disparity = rounded(double(scene.Disparity(x, y)));
      const int distance = disparity - std::clamp(disparity, far, near),
                side = distance < 0 ? -1 : 1;
      const double r =
          reference::NearestRadius(int(std::floor(params.aperture * std::abs(distance))));
      const reference::Psf& kernel = reference::PsfOf(r, opening);
      double sums[3] = {0, 0, 0};
      for (int m = -kernel.size; m <= kernel.size; ++m) {
        for (int n = -kernel.size; n <= kernel.size; ++n) {
          const uint8_t* pixel = scene.Pixel(0, std::clamp(x + n, 0, scene.width - 1),
                                             std::clamp(y + m, 0, scene.height - 1));
          const double weight = kernel.At(side * n, side * m);
          for (int c = 0; c < 3; ++c) sums[c] += weight * light[pixel[c]];
        }
      }
      for (const double sum : sums) out.push_back(test::CodeOf(sum, transfer));
    }
  }
  return out;
}

// Returns a picture of noise, of black and white noise, or of two areas. Steps between black and
// white are the most sensitive test of the shape of a PSF. If `flat` is true, the scene has one
// disparity.
test::Scene AnyScene(bool flat, test::Random* random) {
  const float depth = flat ? 0 : float(random->Real(0, 12)), low = float(random->Real(-6, 1));
  test::Scene scene = test::EmptyScene(random->Int(1, 60), random->Int(1, 45),
                                       1 + 4 * random->Int(0, 1), low, low + depth);
  if (random->Int(0, 1) == 0) {
    test::RandomDisparity(&scene, random);
  } else {
    test::NoisyDisparity(&scene, random);
  }
  const int colours = random->Int(0, 2), edge = random->Int(0, 60);
  for (auto& picture : scene.pictures) {
    for (size_t n = 0; n < picture.size(); ++n) {
      const auto x = int(n / 3) % scene.width, y = int(n / 3) / scene.width;
      picture[n] = colours == 0   ? random->Byte()
                   : colours == 1 ? uint8_t(random->Int(0, 1) * 255)
                                  : uint8_t(x < edge || y > 20 ? 255 : 0);
    }
  }
  return scene;
}

starfocus::Params AnyLens(const test::Scene& scene, bool flat, test::Random* random) {
  const double away = flat ? random->Real(0, 1) * random->Real(0, 24) : random->Real(-8, 8);
  const double aperture = random->Int(0, 1) == 0 ? 1 : random->Real(0.1, 1);
  starfocus::Params lens = test::Params(scene.disparity_min - away, aperture, STARFOCUS_MODE_BLUR);
  const double thetas[] = {lens.theta, STARFOCUS_MIN_THETA, STARFOCUS_MAX_THETA,
                           random->Real(0.1, 0.4) * 3.14159};
  lens.theta = thetas[random->Int(0, 3)];
  if (random->Int(0, 1) == 0) test::RandomShape(&lens, random);
  if (random->Int(0, 3) == 0) lens.focus_nearer = random->Real(0, 4);
  if (random->Int(0, 3) == 0) lens.focus_farther = random->Real(0, 4);
  return lens;
}

TEST_CASE("blur: random pictures and lenses match the reference, with any size of blocks") {
  test::Random random(18);
  for (int round = 0; round < 40; ++round) {
    const bool flat = round % 2 == 0;
    const test::Scene scene = AnyScene(flat, &random);
    const starfocus::Params lens = AnyLens(scene, flat, &random);
    test::Config config = test::ConfigFor(scene, 40);
    config.transfer = random.Int(0, 1) == 0 ? STARFOCUS_TRANSFER_NONE : STARFOCUS_TRANSFER_SRGB;
    test::ReserveFor(lens, &config);
    const std::vector<double> expected = BlurredByReference(scene, lens, config.transfer);
    std::vector<uint8_t> pictures[2];
    for (auto& picture : pictures) {
      config.superblock = 32 << random.Int(0, 3);
      picture = test::OutputOf(config, lens, scene).bytes;
    }
    double largest = 0;
    for (size_t i = 0; i < expected.size(); ++i) {
      largest = std::max(largest, std::abs(pictures[0][i] - std::floor(expected[i] + 0.5)));
    }
    CAPTURES(round, lens.focus, lens.aperture, lens.theta);
    CAPTURE(test::ShapeText(lens));
    CHECK(largest <= 1);
    CHECK(pictures[0] == pictures[1]);
  }
}

}  // namespace
}  // namespace gather_test
