// SPDX-License-Identifier: Apache-2.0
// Tests the cells of block mode that are blurred by a filter, without rendering views. Exactly the
// smooth cells of a picture must be blurred by the filter. The filter must blur a cell in the same
// way as the blur mode does.
#include "lib/gather/gather.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/lib/measured_cells.h"
#include "tests/support/config.h"
#include "tests/support/inside.h"
#include "tests/support/layered_scene.h"
#include "tests/support/psnr.h"
#include "tests/support/refocused.h"
#include "tests/support/test_scene.h"

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

int LargestDifference(const Refocused& a, const Refocused& b) {
  int largest = 0;
  for (size_t i = 0; i < a.rgb.size(); ++i)
    largest = std::max(largest, std::abs(a.rgb[i] - b.rgb[i]));
  return largest;
}

TEST_CASE("gather: for a flat surface, block mode gives the same picture as blur mode") {
  for (const double radius : {0.6, 1.0, 2.5, 4.0, 7.3, 12.0}) {
    for (const int block : {32, 64, 256}) {
      test::Scene scene = test::RandomScene(70, 45, 5, 0, 0, 62);
      test::Config config = test::ConfigFor(scene, 16);
      config.superblock = block;
      config.transfer = STARFOCUS_TRANSFER_NONE;
      const Refocused gathered =
          RefocusScene(scene, config, test::Params(radius, 1, STARFOCUS_MODE_BLOCK));
      const Refocused blurred =
          RefocusScene(scene, config, test::Params(radius, 1, STARFOCUS_MODE_BLUR));
      CAPTURE(radius);
      CHECK(gathered.rgb == blurred.rgb);
      // With sRGB, light is not an integer code, so both pictures may differ by a level after
      // rounding.
      test::Config light = config;
      light.transfer = STARFOCUS_TRANSFER_SRGB;
      CHECK(LargestDifference(
                RefocusScene(scene, light, test::Params(radius, 1, STARFOCUS_MODE_BLOCK)),
                RefocusScene(scene, light, test::Params(radius, 1, STARFOCUS_MODE_BLUR))) <= 1);
      CHECK(gathered.report.gathered_pixels == 70 * 45);
      CHECK(gathered.report.n == 0);
      CHECK(gathered.report.rendered_samples == 0);
      config.tuning.gather = 0;
      const Refocused views =
          RefocusScene(scene, config, test::Params(radius, 1, STARFOCUS_MODE_BLOCK));
      CHECK(views.report.gathered_pixels == 0);
      CHECK(views.report.n > 0);
    }
  }
}

TEST_CASE(
    "gather: only block mode with slices blurs cells without views, for blurs from 1/16 to 48 "
    "pixels") {
  const test::Scene scene = test::RandomScene(70, 45, 5, 0, 0, 63);
  const test::Config config = test::ConfigFor(scene, 49);
  const auto gathered = [&](double focus, starfocus_mode mode, starfocus_renderer renderer) {
    starfocus::Params params = test::Params(focus, 1, mode, renderer);
    return RefocusScene(scene, config, params).report.gathered_pixels;
  };
  CHECK(gathered(48.1, STARFOCUS_MODE_BLOCK, STARFOCUS_RENDERER_SLICES) == 0);
  CHECK(gathered(48, STARFOCUS_MODE_BLOCK, STARFOCUS_RENDERER_AUTO) == 70 * 45);
  CHECK(gathered(1.0 / 16, STARFOCUS_MODE_BLOCK, STARFOCUS_RENDERER_SLICES) == 70 * 45);
  CHECK(gathered(3.0 / 64, STARFOCUS_MODE_BLOCK, STARFOCUS_RENDERER_SLICES) == 0);
  CHECK(gathered(3, STARFOCUS_MODE_BLOCK, STARFOCUS_RENDERER_LINE_SCAN) == 0);
  CHECK(gathered(3, STARFOCUS_MODE_FRAME, STARFOCUS_RENDERER_SLICES) == 0);
  CHECK(gathered(3, STARFOCUS_MODE_BENCHMARK, STARFOCUS_RENDERER_SLICES) == 0);
}

TEST_CASE("gather: the borders of a layer include all rows that the PSFs read") {
  std::vector<uint16_t> weights(starfocus::BlurWeightCount(false, starfocus::kMaxGather));
  std::vector<starfocus::Psf> kernels(size_t(starfocus::PsfCount(starfocus::kMaxGather)));
  starfocus::MakePsfs(0, int32_t(kernels.size()), {}, nullptr, weights.data(), kernels.data());
  for (int blur = 1; blur <= STARFOCUS_MAX_BLUR * 4; ++blur) {
    const double max_blur = blur / 4.0;
    CAPTURE(max_blur);
    const starfocus::Borders borders = test::BordersOf(max_blur);
    for (int layer = 1; layer < STARFOCUS_LAYERS; ++layer) {
      const double gathered = starfocus::LargestGather(max_blur / (1 << layer));
      const int32_t read = kernels[size_t(starfocus::PsfCount(gathered) - 1)].size;
      CHECK(starfocus::UpsampleBorder(layer) + read <= borders.layer[layer]);
    }
  }
}

TEST_CASE(
    "gather: cells at depth edges use rendered views, and gathering does not reduce the PSNR") {
  for (const uint64_t seed : {64, 65, 66}) {
    const test::Scene scene = test::LayeredScene(180, 130, 9, 6, seed);
    test::Config config = test::ConfigFor(scene, 16);
    const Refocused benchmark =
        RefocusScene(scene, config, test::Params(1, 1, STARFOCUS_MODE_BENCHMARK));
    const Refocused gathered =
        RefocusScene(scene, config, test::Params(1, 1, STARFOCUS_MODE_BLOCK));
    config.tuning.gather = 0;
    const Refocused views = RefocusScene(scene, config, test::Params(1, 1, STARFOCUS_MODE_BLOCK));
    CHECK(gathered.report.gathered_pixels > 0);
    CHECK(gathered.report.gathered_pixels < 180 * 130);
    CHECK(gathered.rgb != views.rgb);
    CAPTURE(seed);
    MESSAGE("PSNR in dB with and without gathering: ", test::Psnr(gathered.rgb, benchmark.rgb), " ",
            test::Psnr(views.rgb, benchmark.rgb), ", gathered ", gathered.report.gathered_pixels);
    // At 52 dB, half of the difference comes from rounding both pictures to bytes.
    CHECK(test::Psnr(gathered.rgb, benchmark.rgb) >
          std::min(test::Psnr(views.rgb, benchmark.rgb) - 0.2, 52.0));
  }
}

}  // namespace
}  // namespace gather_test
