// SPDX-License-Identifier: Apache-2.0
// Tests the positions of captured views, the choice of views that see behind edges on each side,
// and the shifts of pixels from view to view, which are compared with u * (d - d_t) in double
// precision.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>
#include <vector>

#include "lib/optics/view_grid.h"
#include "lib/optics/view_set.h"
#include "starfocus/starfocus.h"
#include "tests/support/config.h"
#include "tests/support/test_scene.h"

namespace view_positions_test {
namespace {

using namespace starfocus;

ViewGrid MakeGrid(int n, double focus, double aperture, int layer = 0) {
  starfocus::ViewWeights views;
  views.n = views.last = n;
  return starfocus::MakeViewGrid(views, starfocus::MakeFocusRange(focus), aperture, layer);
}

TEST_CASE("view grid: the focus is rounded to 1/64, half up") {
  CHECK(MakeGrid(4, 0, 1).focus.far == 0);
  CHECK(MakeGrid(4, 1.5, 1).focus.far == 96);
  CHECK(MakeGrid(4, 1.0 / 128, 1).focus.far == 1);
  CHECK(MakeGrid(4, -1.0 / 128, 1).focus.far == 0);
  CHECK(MakeGrid(4, -3.0 / 128, 1).focus.far == -1);
  CHECK(MakeGrid(4, STARFOCUS_MAX_FOCUS, 1).focus.far == 64000000);
  CHECK(MakeGrid(4, -STARFOCUS_MAX_FOCUS, 1).focus.far == -64000000);
}

TEST_CASE("view grid: shifts grow with the distance from a range in focus, and are 0 inside") {
  ViewGrid grid = MakeGrid(8, 0, 0.7);
  grid.focus = starfocus::MakeFocusRange(0.5, 3, 2);
  const ViewGrid far = MakeGrid(8, -1.5, 0.7), near = MakeGrid(8, 3.5, 0.7);
  for (int disparity = -500 * 64; disparity <= 500 * 64; disparity += 7) {
    const bool behind = disparity<-96, before = disparity> 224;
    if (std::abs(grid.focus.Distance(disparity)) * 0.7 / 64 > STARFOCUS_MAX_BLUR) continue;
    const int expected = behind   ? far.Shift(far.Move(5), disparity)
                         : before ? near.Shift(near.Move(5), disparity)
                                  : 0;
    CHECK(grid.Shift(grid.Move(5), disparity) == expected);
    CHECK(grid.focus.WithoutRange(int16_t(disparity)) ==
          disparity - std::clamp(disparity + 96, 0, 224 + 96));
  }
}

TEST_CASE("view grid: the far end of a range is at least the smallest disparity") {
  CHECK(starfocus::MakeFocusRange(3, 1, 1000).far == -500 * 64);
  CHECK(starfocus::MakeFocusRange(-600, 0, 1000).far == -600 * 64);
  CHECK(starfocus::MakeFocusRange(-600).far == -600 * 64);
}

TEST_CASE("view grid: shifts are u (d - d_t), to 1/256 of a pixel, within the blur radius") {
  test::Random random(5);
  for (int round = 0; round < 20000; ++round) {
    const double aperture = random.Int(0, 9) == 0 ? 1e-7 : random.Real(0.01, 1);
    const int layer = random.Int(0, 2);
    const double radius = random.Real(0, std::min(STARFOCUS_MAX_BLUR, 1000 * aperture));
    const double disparity = random.Int(-500 * 64, 500 * 64) / 64.0;
    const double focus =
        std::floor((disparity + (random.Int(0, 1) == 0 ? 1 : -1) * radius / aperture) * 64 + 0.5) /
        64;
    const int n = random.Int(1, 256), i = random.Int(0, n);
    const ViewGrid grid = MakeGrid(n, focus, aperture, layer);
    CHECK(grid.Move(0) == 0);
    CHECK(grid.Move(n) == grid.step);
    const int shift = grid.Shift(grid.Move(i), int(disparity * 64));
    const double rim = std::max(aperture / (1 << layer), 1.0 / (1 << 24));
    const double exact = rim * i / n * (disparity - focus) * 256;
    // The bound is half a unit of the shift, plus 1.5 units of the view's position (2^-24) times
    // the difference between disparity and focus.
    const double bound = 0.5 + 1.5 * 256 / (1 << 24) * std::fabs(disparity - focus) + 1e-9;
    if (std::fabs(shift - exact) > bound) {
      CAPTURES(aperture, layer, focus, disparity);
      CHECK(std::fabs(shift - exact) <= bound);
    }
    const double blur = aperture * std::fabs(disparity - focus);
    if (std::abs(shift) > std::ceil(blur * 256)) CHECK(std::abs(shift) <= std::ceil(blur * 256));
  }
}

TEST_CASE("view grid: shifts are rounded half up, and pixels in focus do not move") {
  const ViewGrid grid = MakeGrid(4, 2, 1);
  CHECK(grid.Shift(grid.Move(4), 128) == 0);
  CHECK(grid.Shift(grid.Move(4), 129) == 4);
  CHECK(grid.Shift(grid.Move(4), 127) == -4);
  CHECK(grid.Shift(grid.Move(1), 129) == 1);
  const ViewGrid fine = MakeGrid(8, 2, 1);  // halves of 1/256
  CHECK(fine.Shift(fine.Move(1), 129) == 1);
  CHECK(fine.Shift(fine.Move(1), 127) == 0);
  CHECK(fine.Shift(fine.Move(3), 129) == 2);
  CHECK(fine.Shift(fine.Move(3), 127) == -1);
}

test::Config Config(const std::vector<starfocus_position>& positions) {
  test::Config config;
  config.views = 0;
  for (const starfocus_position& position : positions) config.positions[config.views++] = position;
  return config;
}

test::Config Star(int views) {
  test::Config config;
  config.views = views;
  return config;
}

starfocus_status Check(const test::Config& config) {
  ViewSet set;
  return starfocus::FindViews(config.views, config.positions, nullptr, &set);
}

// Returns the indices of the views that see behind edges to the right, left, bottom and top.
using Sides = std::vector<std::vector<int>>;
Sides LooksOf(const test::Config& config) {
  ViewSet set;
  REQUIRE(starfocus::FindViews(config.views, config.positions, nullptr, &set) == STARFOCUS_OK);
  const OcclusionViews occlusion_views = starfocus::ChooseOcclusionViews(set);
  Sides sides(kSideCount);
  for (int side = 0; side < kSideCount; ++side) {
    for (const starfocus::OcclusionView& look : occlusion_views.on[side]) {
      if (look.view == 0) continue;
      sides[size_t(side)].push_back(look.view);
      CHECK(look.at.u == set.at[look.view].u);
      CHECK(look.at.v == set.at[look.view].v);
    }
    if (sides[size_t(side)].empty()) continue;
    CHECK(occlusion_views.Last(side).view == sides[size_t(side)].back());
  }
  return sides;
}

TEST_CASE("views: in a star set, the farther views on the axes see behind edges first") {
  CHECK(LooksOf(Star(1)) == Sides{{}, {}, {}, {}});
  for (const int views : {5, 9}) CHECK(LooksOf(Star(views)) == Sides{{1}, {2}, {3}, {4}});
  CHECK(LooksOf(Star(17)) == Sides{{1, 9}, {2, 10}, {3, 11}, {4, 12}});
}

const struct {
  std::vector<starfocus_position> positions;
  Sides sides;
} kLooks[] = {
    // A pair sees behind edges on one side, an L on two sides, and a row on the left and right.
    {{{0, 0}, {1, 0}}, {{1}, {}, {}, {}}},
    {{{0, 0}, {0, -0.3}}, {{}, {}, {}, {1}}},
    {{{0, 0}, {0, 1}, {-1, 0}}, {{}, {2}, {1}, {}}},
    {{{0, 0}, {-1, 0}, {-0.5, 0}, {0.5, 0}, {1, 0}}, {{4, 3}, {1, 2}, {}, {}}},
    // A view nearer to another side is used if a side has no other view.
    {{{0, 0}, {1, 1}}, {{1}, {}, {1}, {}}},
    {{{0, 0}, {1, 1}, {0.5, 0}}, {{2}, {}, {1}, {}}},
    // A view sees behind edges if its distance from the axis is less than eight times its distance
    // along the axis.
    {{{0, 0}, {0.13, 1}}, {{1}, {}, {1}, {}}},
    {{{0, 0}, {0.125, 1}}, {{}, {}, {1}, {}}},
    // If several views see behind edges on one side, the two that lie farthest along the axis are
    // chosen.
    {{{0, 0}, {0.4, 0}, {1, 0.1}, {0.9, -0.8}, {0.8, 0}}, {{2, 4}, {}, {}, {3}}},
};

TEST_CASE("views: the views that see behind edges on each side follow from the positions") {
  for (const auto& row : kLooks) {
    CAPTURE(&row - kLooks);
    CHECK(LooksOf(Config(row.positions)) == row.sides);
  }
}

TEST_CASE("views: the choice of occlusion views does not depend on the order of the views") {
  std::vector<starfocus_position> positions = {{0, 0}, {1, 0.5}, {1, -0.5}, {0.75, 0}, {-0.2, 0.6}};
  const auto chosen = [&] {
    const Sides sides = LooksOf(Config(positions));
    std::vector<std::pair<double, double>> found;
    for (const auto& side : sides) {
      for (const int view : side) {
        found.emplace_back(positions[size_t(view)].u, positions[size_t(view)].v);
      }
    }
    return found;
  };
  const auto before = chosen();
  CHECK(before == std::vector<std::pair<double, double>>{
                      {0.75, 0}, {1, -0.5}, {-0.2, 0.6}, {-0.2, 0.6}, {1, -0.5}});
  for (int turn = 0; turn < 4; ++turn) {
    std::swap(positions[1], positions[size_t(2 + turn % 3)]);
    CHECK(chosen() == before);
  }
}

TEST_CASE("views: the star is recognised by the order and values of its positions") {
  for (const int views : {1, 5, 9, 17}) {
    CHECK(starfocus::HasStar(Star(views)));
    test::Config config = Star(views);
    for (int k = 0; k < views; ++k) {
      starfocus_view_position(k, &config.positions[k].u, &config.positions[k].v, nullptr);
    }
    CHECK(starfocus::HasStar(config));
    if (views == 1) continue;
    std::swap(config.positions[1], config.positions[2]);
    CHECK(Check(config) == STARFOCUS_OK);
    CHECK_FALSE(starfocus::HasStar(config));
  }
  CHECK_FALSE(starfocus::HasStar(Config({{0, 0}, {1, 0}})));
}

TEST_CASE("views: invalid sets of views are rejected") {
  for (const int views : {-1, 0, 2, 3, 4, 16, 18})
    CHECK(Check(Star(views)) == STARFOCUS_ERROR_RANGE);
  CHECK(Check(Config({{0, 0}, {1, -1}})) == STARFOCUS_OK);
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = HUGE_VAL;
  for (const double bad : {nan, infinite, -infinite, 1.0001, -1.0001}) {
    CHECK(Check(Config({{0, 0}, {bad, 0}})) == STARFOCUS_ERROR_RANGE);
    CHECK(Check(Config({{0, 0}, {1, 0}, {0, bad}})) == STARFOCUS_ERROR_RANGE);
  }
  CHECK(Check(Config({{1, 0}, {0, 0}})) == STARFOCUS_ERROR_RANGE);
  CHECK(Check(Config({{0, 0}, {0.5, 0}, {0.5, 0}})) == STARFOCUS_ERROR_RANGE);
  CHECK(Check(Config({{0, 0}, {1, 0}, {0, 0}})) == STARFOCUS_ERROR_RANGE);
  CHECK(Check(Config({{0, 0}, {0.5, 0}, {0.5 + 1.0 / 16384, 0}})) == STARFOCUS_OK);
  // Positions beyond the number of views are ignored.
  test::Config config = Config({{0, 0}, {1, 0}});
  config.positions[2] = {nan, 7};
  CHECK(Check(config) == STARFOCUS_OK);
}

}  // namespace
}  // namespace view_positions_test
