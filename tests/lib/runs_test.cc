// SPDX-License-Identifier: Apache-2.0
// Tests the runs of constant disparity in hand-made and random lines, and the values that they
// derive from the grid of views.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "lib/line_scan/line_scan.h"
#include "tests/lib/find_runs.h"
#include "tests/support/simd_targets.h"
#include "tests/support/test_scene.h"

namespace runs_test {
namespace {

using namespace starfocus;
using test::Depths;

struct Found {
  int begin, surface_end, disparity;
};

bool operator==(const Found& a, const Found& b) {
  return a.begin == b.begin && a.surface_end == b.surface_end && a.disparity == b.disparity;
}

using Runs = std::vector<Found>;

// Makes a lens with n views and the given focus.
ViewGrid MakeGrid(int n, double focus, double aperture = 1, int layer = 0) {
  starfocus::ViewWeights views;
  views.n = views.last = n;
  return starfocus::MakeViewGrid(views, starfocus::MakeFocusRange(focus), aperture, layer);
}

Runs Find(const Depths& line, Direction direction, int spread) {
  Runs found;
  for (const Run& run : test::FindRuns(line, MakeGrid(1, 0, 0.2), spread, direction)) {
    found.push_back({run.begin, run.surface_end, run.disparity});
  }
  return found;
}

TEST_CASE("runs: lines of one pixel, one surface or two surfaces are split into runs") {
  CHECK(Find({7}, Direction::kRightToLeft, 16) == Runs{{0, 1, 7}});
  CHECK(Find({7}, Direction::kLeftToRight, 16) == Runs{{0, 1, 7}});
  CHECK(Find({5, 5, 5, 5}, Direction::kRightToLeft, 0) == Runs{{0, 4, 5}});
  CHECK(Find({1, 1, 1, 200, 200}, Direction::kRightToLeft, 16) == Runs{{3, 5, 200}, {0, 3, 1}});
  CHECK(Find({1, 1, 1, 200, 200}, Direction::kLeftToRight, 16) == Runs{{2, 5, 1}, {0, 2, 200}});
}

TEST_CASE("runs: a run may reach the spread but not exceed it, and its middle is rounded down") {
  CHECK(Find({16, 0}, Direction::kRightToLeft, 16) == Runs{{0, 2, 8}});
  CHECK(Find({17, 0}, Direction::kRightToLeft, 16) == Runs{{1, 2, 0}, {0, 2, 17}});
  CHECK(Find({0, 3}, Direction::kRightToLeft, 16) == Runs{{0, 2, 1}});
  CHECK(Find({0, -3}, Direction::kRightToLeft, 16) == Runs{{0, 2, -2}});
}

TEST_CASE("runs: each run is as long as possible, from the end where the scan starts") {
  const Depths ramp = {0, 2, 4, 6, 8, 10, 12};
  CHECK(Find(ramp, Direction::kRightToLeft, 4) == Runs{{4, 7, 10}, {1, 7, 4}, {0, 7, 0}});
  CHECK(Find(ramp, Direction::kLeftToRight, 4) == Runs{{4, 7, 2}, {1, 7, 8}, {0, 7, 12}});
}

TEST_CASE("runs: a surface ends at a step above the limit, not at the end of a run") {
  const int16_t near = kSurfaceStep, nearer = kSurfaceStep + 1;
  CHECK(Find({0, 0, near, near}, Direction::kRightToLeft, 96) == Runs{{0, 4, near / 2}});
  CHECK(Find({0, 0, near, near}, Direction::kRightToLeft, 16) == Runs{{2, 4, near}, {0, 4, 0}});
  CHECK(Find({0, 0, nearer, nearer}, Direction::kRightToLeft, 96) ==
        Runs{{2, 4, nearer}, {0, 2, 0}});
  CHECK(Find({0, 20, 40, nearer + 40, nearer + 20}, Direction::kRightToLeft, 16) ==
        Runs{{4, 5, nearer + 20}, {3, 5, nearer + 40}, {2, 3, 40}, {1, 3, 20}, {0, 3, 0}});
}

TEST_CASE("runs: alternating extremes give runs of one pixel") {
  Depths line;
  for (int x = 0; x < 100; ++x) line.push_back(x % 2 == 0 ? 32000 : -32000);
  for (const int spread : {0, 96}) {
    const Runs runs = Find(line, Direction::kRightToLeft, spread);
    REQUIRE(runs.size() == 100);
    for (int k = 0; k < 100; ++k) {
      CHECK(runs[size_t(k)] == Found{99 - k, 100 - k, line[size_t(99 - k)]});
    }
  }
}

TEST_CASE("runs: the width of a subaperture is the distance that its run moves from view to view") {
  // The disparities differ from the focus by 2 and 3 pixels. With N = 4, neighbouring views move by
  // 0.5 and 0.75 pixels.
  const ViewGrid grid = MakeGrid(4, 1);
  const std::vector<Run> runs =
      test::FindRuns({-128, -128, 192, 192}, grid, 16, Direction::kRightToLeft);
  REQUIRE(runs.size() == 2);
  CHECK(runs[0].subaperture == 128);
  CHECK(runs[1].subaperture == 192);
}

// Checks the runs of a line whose pixels are in scan order for kRightToLeft.
void CheckLine(const Depths& line, const ViewGrid& grid, int spread, const std::vector<Run>& runs) {
  int end = int(line.size()), surface_end = end;
  for (const Run& run : runs) {
    REQUIRE(run.begin < end);
    const auto range = std::minmax_element(line.begin() + run.begin, line.begin() + end);
    const int low = *range.first, high = *range.second;
    CHECK(high - low <= spread);
    CHECK(run.disparity == (low + high) >> 1);
    if (end < int(line.size()) &&
        std::abs(line[size_t(end)] - line[size_t(end - 1)]) > kSurfaceStep) {
      surface_end = end;
    }
    CHECK(run.surface_end == surface_end);
    CHECK(run.subaperture == std::abs(grid.Shift(grid.Move(1), run.disparity)));
    if (run.begin > 0) {  // with one more pixel, the run would exceed the spread
      const int next = line[size_t(run.begin - 1)];
      CHECK(std::max(high, next) - std::min(low, next) > spread);
    }
    end = run.begin;
  }
  CHECK(end == 0);
}

Depths RandomLine(int length, test::Random* random) {
  Depths line(static_cast<size_t>(length));
  const int amplitude = random->Int(0, 3) == 0 ? 7000 : 60 << random->Int(0, 3);
  int level = random->Int(-amplitude, amplitude);
  for (int16_t& d : line) {
    if (random->Int(0, 3) == 0) level = random->Int(-amplitude, amplitude);
    d = int16_t(level);
  }
  return line;
}

TEST_CASE("runs: random lines are covered by the longest runs that the spread allows") {
  test::Random random(3);
  for (int round = 0; round < 150; ++round) {
    const int length = random.Int(1, 70), count = random.Int(1, 40);
    std::vector<Depths> lines, mirrored;
    for (int k = 0; k < count; ++k) {
      lines.push_back(RandomLine(length, &random));
      mirrored.push_back({lines.back().rbegin(), lines.back().rend()});
    }
    const ViewGrid grid = MakeGrid(random.Int(1, 9), random.Real(-3, 3));
    const int spread = random.Int(0, 96);
    const size_t step = size_t(count + random.Int(0, 5));
    for (const starfocus::simd::LineScanKernels* kernels : test::LineScanTargets()) {
      const auto runs =
          test::FindRuns(*kernels, lines, grid, spread, Direction::kRightToLeft, step);
      const auto left =
          test::FindRuns(*kernels, mirrored, grid, spread, Direction::kLeftToRight, step);
      for (size_t k = 0; k < lines.size(); ++k) {
        CheckLine(lines[k], grid, spread, runs[k]);
        CheckLine(lines[k], grid, spread, left[k]);
      }
    }
  }
}

TEST_CASE("runs: rendered views up to 0.5 from the centre use captured views at half distance") {
  CHECK(HalfViews(MakeGrid(8, 0, 1), 17) == 4);
  CHECK(HalfViews(MakeGrid(7, 0, 1), 17) == 3);
  CHECK(HalfViews(MakeGrid(1, 0, 1), 17) == 0);
  CHECK(HalfViews(MakeGrid(8, 0, 0.5), 17) == 8);
  CHECK(HalfViews(MakeGrid(8, 0, 0.51), 17) == 7);
  CHECK(HalfViews(MakeGrid(10, 0, 0.75), 17) == 6);
  CHECK(HalfViews(MakeGrid(8, 0, 1), 9) == 0);
  CHECK(HalfViews(MakeGrid(0, 0, 1), 17) == 0);
}

// All pixels of a run are shifted equally. The spread of the run's disparities is limited, so that
// each pixel is at most 1/8 of a pixel from its exact position.
TEST_CASE("runs: the spread of a run displaces pixels by at most an eighth of a pixel") {
  for (const double aperture : {1.0, 0.9, 0.5, 0.3, 0.2, 0.01, 1e-7}) {
    for (const int layer : {0, 1, 2}) {
      const ViewGrid grid = MakeGrid(9, 0, aperture, layer);
      CAPTURES(aperture, layer);
      const int range = RunRange(grid);
      const double spread = range / 64.0, u = aperture / (1 << layer);
      CHECK(range >= 1);
      CHECK(range <= kSurfaceStep);
      CHECK(spread / 2 * u <= 0.125 + 1e-6);
      // With a spread of one more unit, a pixel would be displaced by more than 1/8 of a pixel.
      const bool largest = range == kSurfaceStep || (spread + 1.0 / 64) / 2 * u > 0.125 - 1e-6;
      CHECK(largest);
    }
  }
}

}  // namespace
}  // namespace runs_test
