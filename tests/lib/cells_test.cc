// SPDX-License-Identifier: Apache-2.0
// Compares the block analysis with a brute-force search on random disparity maps. No pixel beyond a
// block's border may have a blur that reaches the block or the margin that its layer renders.
// Outside the picture, the edge pixels are repeated.
#include "lib/plan/cells.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "lib/plan/partition.h"
#include "tests/lib/measured_cells.h"
#include "tests/support/inside.h"
#include "tests/support/test_scene.h"

namespace cells_test {
namespace {

using namespace starfocus;

constexpr int kDisparityOne = 1 << starfocus::kDisparityBits;
constexpr int kSizes = 5;  // number of block sizes: 16, 32, ... 256 pixels

// A disparity map in the engine's units, and the lens.
struct Map {
  int width = 1, height = 1;
  std::vector<int16_t> disparity;
  std::vector<double> radius, right_edge, lower_edge;
  BlurScale scale = {{}, int64_t{1} << starfocus::kStepBits};

  int16_t& At(int x, int y) { return disparity[size_t(y) * size_t(width) + size_t(x)]; }
  // Computes the tables of radii from the disparities.
  void Measure() {
    radius.resize(disparity.size());
    right_edge.assign(disparity.size(), -1);
    lower_edge.assign(disparity.size(), -1);
    for (size_t i = 0; i < disparity.size(); ++i) {
      const int distance = std::abs(scale.focus.Distance(disparity[i]));
      radius[i] = std::ldexp(double(scale.step), -starfocus::kStepBits) * distance / kDisparityOne;
    }
    const auto closed = [&](size_t i) { return int{scale.focus.WithoutRange(disparity[i])}; };
    const auto edge = [&](size_t a, size_t b) {
      if (std::abs(closed(a) - closed(b)) <= starfocus::kSurfaceStep) return -1.0;
      return disparity[a] > disparity[b] ? radius[a] : radius[b];
    };
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const size_t i = Index(x, y);
        if (x + 1 < width) right_edge[i] = edge(i, i + 1);
        if (y + 1 < height) lower_edge[i] = edge(i, i + size_t(width));
      }
    }
  }
  // Returns the index of a pixel. Outside the picture, the edges are repeated.
  size_t Index(int x, int y) const {
    const int cx = std::clamp(x, 0, width - 1), cy = std::clamp(y, 0, height - 1);
    return size_t(cy) * size_t(width) + size_t(cx);
  }
  // Returns the blur radius by equation (2), in pixels.
  double Radius(int x, int y) const { return radius[Index(x, y)]; }
  // Returns the radius of the nearer of two neighbouring pixels, or -1 without a depth edge between
  // these pixels. The second pixel is below or to the right of the first pixel.
  double EdgeRadius(int x, int y, bool below) const {
    if (below) return y < 0 || y >= height ? -1 : lower_edge[Index(x, y)];
    return x < 0 || x >= width ? -1 : right_edge[Index(x, y)];
  }
  double LargestRadius() const {
    double largest = 0;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) largest = std::max(largest, Radius(x, y));
    }
    return largest;
  }
};

Map EmptyMap(int width, int height, double focus, double aperture) {
  Map map;
  map.width = width;
  map.height = height;
  map.disparity.assign(size_t(width) * size_t(height), 0);
  map.scale.focus = starfocus::MakeFocusRange(focus);
  map.scale.step = int64_t(std::ldexp(aperture, starfocus::kStepBits));
  return map;
}

int16_t Fixed(double disparity) {
  return int16_t(std::clamp(std::floor(disparity * kDisparityOne + 0.5), -32000.0, 32000.0));
}

// Kinds of disparity maps. All maps have disparities from -amplitude to amplitude.
enum Content { kPieces, kNoise, kSparks, kSlant, kContents };

Map RandomMap(int width, int height, Content content, double amplitude, test::Random* random) {
  Map map = EmptyMap(width, height, random->Real(-amplitude, amplitude),
                     random->Int(0, 1) == 0 ? 1 : random->Real(0.2, 1));
  // Every fourth lens has a range in focus.
  if (random->Int(0, 3) == 0)
    map.scale.focus.near += random->Int(1, int(amplitude * kDisparityOne));
  if (content == kPieces) {
    for (int piece = 0; piece < 3 + width * height / 400; ++piece) {
      const int16_t d = Fixed(random->Real(-amplitude, amplitude));
      const int x0 = piece == 0 ? 0 : random->Int(0, width - 1);
      const int y0 = piece == 0 ? 0 : random->Int(0, height - 1);
      const int x1 = piece == 0 ? width : std::min(width, x0 + random->Int(1, 30));
      const int y1 = piece == 0 ? height : std::min(height, y0 + random->Int(1, 30));
      // Some surfaces slope down from the edge where they begin.
      const double slope = random->Int(0, 2) == 0 ? random->Real(0, 2) * kDisparityOne : 0;
      const bool down = random->Int(0, 1) == 1;
      for (int y = y0; y < y1; ++y) {
        for (int x = x0; x < x1; ++x) {
          const int along = down ? y - y0 : x - x0;
          map.At(x, y) = int16_t(std::max(d - slope * along, -amplitude * kDisparityOne));
        }
      }
    }
    return map;
  }
  const double dx = random->Real(-1, 1) * amplitude / 40, dy = random->Real(-1, 1) * amplitude / 40;
  const double focus = double(map.scale.focus.far) / kDisparityOne;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      double d = 0;
      if (content == kNoise) d = random->Real(-amplitude, amplitude);
      // Single pixels out of focus are so rare that each of them determines a border.
      if (content == kSparks) {
        d = focus + (random->Int(0, 299) == 0 ? random->Real(-amplitude, amplitude) : 0);
      }
      if (content == kSlant) {
        d = std::clamp(dx * (x - width / 2) + dy * (y - height / 2), -amplitude, amplitude);
      }
      map.At(x, y) = Fixed(d);
    }
  }
  return map;
}

// Cells of the stripe at row y and of the rows around the stripe that the engine keeps. Sanitizers
// report accesses beyond the cells.
struct Cells {
  Cells(const Map& map, int y, int side, int around) {
    Input input;
    input.width = map.width;
    input.height = map.height;
    input.disparity = {map.disparity.data(), size_t(map.width), 0, 0};
    grid.columns = (map.width + kCellSize - 1) / kCellSize;
    grid.rows = (map.height + kCellSize - 1) / kCellSize;
    const int end = std::min(y + side, map.height);
    grid.first_row = std::max(0, y / kCellSize - around);
    grid.last_row = std::min(grid.rows, (end - 1) / kCellSize + around + 2);
    cells.resize(size_t(grid.last_row - grid.first_row) * size_t(grid.columns));
    grid.cells = cells.data();
    for (int row = grid.first_row; row < grid.last_row; ++row) {
      starfocus::MeasureCells(starfocus::simd::BestKernels(), input, map.scale, row,
                              {0, grid.columns}, grid.At(0, row));
    }
  }
  CellGrid grid;
  std::vector<Cell> cells;
};

// Returns true if a pixel may reach columns [x0, x1] and rows [y0, y1]. The pixel moves by up to
// `radius` in any direction, rounded to a whole pixel.
bool Reaches(int x, int y, double radius, int x0, int y0, int x1, int y1) {
  const double dx = std::max({0.0, x0 - 0.5 - x, x - (x1 + 0.5)});
  const double dy = std::max({0.0, y0 - 0.5 - y, y - (y1 + 0.5)});
  return dx * dx + dy * dy <= radius * radius;
}

// Exact statistics of the block [x0, x0 + side) x [y0, y0 + side), which bound the results of the
// analysis.
struct Exact {
  Border border[3] = {};
  double inside_min = 1e9, inside_max = 0;  // Radii of the block's pixels in the picture.
  double reaching_max = 0;                  // Largest radius of all pixels that reach the block.
  double around_max = 0;         // Largest radius of all pixels that the analysis may consider.
  bool has_edge = false;         // True if a depth edge concerns the block.
  bool has_edge_around = false;  // True if the analysis may consider any depth edge.
  // Smallest radius of pixels and edges in the block and in the kUpsampleBorder[1] pixels around
  // the block.
  double shown_min = 1e9;
  double ring_min = 1e9;  // Smallest radius in the block and within 8 pixels around the block.
};

Exact Measure(const Map& map, int x0, int y0, int side, double largest) {
  const int x1 = std::min(x0 + side, map.width) - 1, y1 = std::min(y0 + side, map.height) - 1;
  const int sight = int(std::ceil(largest)) + kUpsampleBorder[2] + 2;
  Exact exact;
  for (int y = y0 - sight; y < y0 + side + sight; ++y) {
    for (int x = x0 - sight; x < x0 + side + sight; ++x) {
      const double radius = map.Radius(x, y);
      if (x >= x0 && x <= x1 && y >= y0 && y <= y1) {
        exact.inside_min = std::min(exact.inside_min, radius);
        exact.inside_max = std::max(exact.inside_max, radius);
      }
      for (int layer = 0; layer < 3; ++layer) {
        const int margin = kUpsampleBorder[layer];
        if (!Reaches(x, y, radius, x0 - margin, y0 - margin, x1 + margin, y1 + margin)) continue;
        if (layer == 0) exact.reaching_max = std::max(exact.reaching_max, radius);
        Border& border = exact.border[layer];
        border.left = std::max(border.left, x0 - x);
        border.right = std::max(border.right, x - (x0 + side - 1));
        border.top = std::max(border.top, y0 - y);
        border.bottom = std::max(border.bottom, y - (y0 + side - 1));
      }
    }
  }
  const auto is_around = [&](int x, int y, int pixels) {
    return x >= x0 - pixels && x <= x1 + pixels && y >= y0 - pixels && y <= y1 + pixels;
  };
  for (int y = y0 - sight - 24; y < y0 + side + sight + 24; ++y) {
    for (int x = x0 - sight - 24; x < x0 + side + sight + 24; ++x) {
      exact.around_max = std::max(exact.around_max, map.Radius(x, y));
      if (is_around(x, y, kCellSize)) exact.ring_min = std::min(exact.ring_min, map.Radius(x, y));
      if (is_around(x, y, kUpsampleBorder[1])) {
        exact.shown_min = std::min(exact.shown_min, map.Radius(x, y));
      }
      for (const bool below : {false, true}) {
        const int other_x = x + !below, other_y = y + below;
        const double radius = map.EdgeRadius(x, y, below);
        if (radius < 0) continue;
        exact.has_edge_around = true;
        if (is_around(x, y, kUpsampleBorder[1]) ||
            is_around(other_x, other_y, kUpsampleBorder[1])) {
          exact.shown_min = std::min(exact.shown_min, radius);
        }
        // An edge concerns the block if a pixel on either side of the edge is in the block or
        // reaches the block.
        if (Reaches(x, y, map.Radius(x, y), x0, y0, x1, y1) ||
            Reaches(other_x, other_y, map.Radius(other_x, other_y), x0, y0, x1, y1)) {
          exact.has_edge = true;
        }
      }
    }
  }
  return exact;
}

// For one size and layer: number of blocks, and number of excess pixels on the four sides of all
// borders.
struct Tally {
  int64_t blocks = 0, excess = 0;
};
using Tallies = Tally[kSizes][3];

int SideOf(const Border& border, int side) {
  return side == kLeft    ? border.left
         : side == kRight ? border.right
         : side == kTop   ? border.top
                          : border.bottom;
}
int Sum(const Border& border) { return border.left + border.right + border.top + border.bottom; }

void CheckBlock(const Map& map, int x0, int y0, int level, double largest, const BlockStats& stats,
                Tallies* tallies) {
  const int side = kSmallestBlock << level;
  const Exact exact = Measure(map, x0, y0, side, largest);
  CAPTURES(map.width, map.height, x0, y0, side);
  for (int layer = 0; layer < 3; ++layer) {
    CAPTURE(layer);
    const Border& e = exact.border[layer];
    const Border& g = stats.border[layer];
    Tally& tally = (*tallies)[level][layer];
    tally.blocks += 1;
    tally.excess += Sum(g) - Sum(e);
    REQUIRE((g.left >= e.left && g.right >= e.right && g.top >= e.top && g.bottom >= e.bottom));
  }
  // r_min is rounded down and r_max is rounded up, by at most `unit` each.
  const double r_min = double(stats.r_min) / kDisparityOne, unit = 2.0 / kDisparityOne;
  const double r_max = double(stats.r_max) / kDisparityOne;
  CHECK(r_min <= exact.inside_min);
  CHECK(r_min > exact.inside_min - unit);
  CHECK(r_max >= exact.reaching_max);
  CHECK(r_max <= std::max(exact.inside_max, exact.around_max) + unit);
  if (exact.has_edge) CHECK(stats.has_edge);
  if (!exact.has_edge_around) CHECK_FALSE(stats.has_edge);
  const double r_shown = double(stats.r_shown) / kDisparityOne;
  CHECK(r_shown <= exact.shown_min);
  if (!exact.has_edge_around) CHECK(r_shown > exact.ring_min - unit);
}

// Checks all blocks of a picture in the order of the engine's quadtree.
void CheckMap(Map map, int superblock, Tallies* tallies) {
  map.Measure();
  const double largest = map.LargestRadius();
  const int around = test::BordersOf(largest).cells;
  for (int y = 0; y < map.height; y += superblock) {
    const Cells cells(map, y, superblock, around);
    // stats[level]: blocks of one size in the stripe, row by row; null beyond the picture.
    std::vector<std::vector<BlockStats>> stats;
    for (int level = 0; (kSmallestBlock << level) <= superblock; ++level) {
      const int side = kSmallestBlock << level;
      const int columns = (map.width + side - 1) / side;
      const int rows = (std::min(superblock, map.height - y) + side - 1) / side;
      const int below_columns = (map.width + side / 2 - 1) / (side / 2);
      const int below_rows = (std::min(superblock, map.height - y) + side / 2 - 1) / (side / 2);
      stats.emplace_back();
      for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
          if (level == 0) {
            stats[0].push_back(test::MeasureBlock(cells.grid, map.scale, 2 * column,
                                                  2 * row + y / kCellSize, around));
          } else {
            const BlockStats* children[4];
            for (int child = 0; child < 4; ++child) {
              const int cx = 2 * column + child % 2, cy = 2 * row + child / 2;
              const bool inside = cx < below_columns && cy < below_rows;
              children[child] =
                  inside ? &stats[size_t(level) - 1][size_t(cy * below_columns + cx)] : nullptr;
            }
            stats[size_t(level)].push_back(starfocus::MergeBlocks(children, side / 2));
          }
          CheckBlock(map, column * side, y + row * side, level, largest,
                     stats[size_t(level)].back(), tallies);
        }
      }
    }
  }
}

TEST_CASE(
    "cells: on random disparity maps, no pixel beyond the border of a block reaches the block") {
  test::Random random(11);
  Tallies tallies;
  constexpr int kWidths[] = {1, 7, 8, 9, 15, 16, 17, 23, 40, 64, 71, 90};
  for (int round = 0; round < 300; ++round) {
    const int width = kWidths[random.Int(0, 11)], height = kWidths[random.Int(0, 11)];
    const auto content = Content(round % kContents);
    const double amplitude = std::vector<double>{0.3, 1, 3, 8, 20}[size_t(random.Int(0, 4))];
    const Map map = RandomMap(width, height, content, amplitude, &random);
    CAPTURE(round);
    CheckMap(map, 32 << random.Int(0, 1), &tallies);
  }
  for (const int width : {200, 256, 300, 515}) {
    for (int round = 0; round < kContents; ++round) {
      const int height = random.Int(100, 280);
      CheckMap(RandomMap(width, height, Content(round % kContents), random.Real(2, 9), &random),
               128 << random.Int(0, 1), &tallies);
    }
  }
  for (const auto& level : tallies) {
    for (const Tally& tally : level) {
      REQUIRE(tally.blocks > 0);
      // On average, a border is wider than the exact border by less than a cell on each side.
      CHECK(tally.excess < 4 * kCellSize * tally.blocks);
    }
  }
}

TEST_CASE("cells: a pixel out of focus widens only the borders of blocks that the pixel reaches") {
  // A pixel of radius 5 lies beside the block of 16x16 pixels at (32, 32).
  for (int distance = 1; distance <= 8; ++distance) {
    for (int side = 0; side < 4; ++side) {
      CAPTURES(distance, side);
      const bool across = side == kTop || side == kBottom,
                 after = side == kRight || side == kBottom;
      const int at = after ? 47 + distance : 32 - distance, far = after ? 2 : 6;
      Map map = EmptyMap(96, 96, 0, 1);
      map.At(across ? 40 : at, across ? at : 40) = Fixed(5);
      const Cells cells(map, 0, 96, 3);
      const BlockStats stats = test::MeasureBlock(cells.grid, map.scale, 4, 4, 3);
      // The block on the other side is not reached, so that its r_max ignores the pixel.
      const BlockStats other =
          test::MeasureBlock(cells.grid, map.scale, across ? 4 : far, across ? far : 4, 3);
      for (int of = 0; of < 4; ++of) {
        CHECK(SideOf(stats.border[0], of) >= (of == side && distance <= 5 ? distance : 0));
        CHECK(SideOf(stats.border[0], of) <= (of == side && distance <= 6 ? distance : 1));
        CHECK(SideOf(other.border[0], of) <= 1);
      }
      if (distance <= 5) CHECK(stats.r_max >= 5 * kDisparityOne);
      CHECK(stats.r_min == 0);
      CHECK(other.r_max == 0);
    }
  }
}

}  // namespace
}  // namespace cells_test
