// SPDX-License-Identifier: Apache-2.0
// Tests the positions of captured views, and the choice of views that see behind edges on each
// side.
#include "lib/optics/view_set.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "tests/support/config.h"

namespace view_set_test {
namespace {

using namespace starfocus;

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

TEST_CASE(
    "views: in a star set, the views that see behind edges lie on the axes, and the farther views "
    "come first") {
  CHECK(LooksOf(Star(1)) == Sides{{}, {}, {}, {}});
  for (const int views : {5, 9}) CHECK(LooksOf(Star(views)) == Sides{{1}, {2}, {3}, {4}});
  CHECK(LooksOf(Star(17)) == Sides{{1, 9}, {2, 10}, {3, 11}, {4, 12}});
}

TEST_CASE("views: a pair sees behind edges on one side, an L on two, a row on left and right") {
  CHECK(LooksOf(Config({{0, 0}, {1, 0}})) == Sides{{1}, {}, {}, {}});
  CHECK(LooksOf(Config({{0, 0}, {0, -0.3}})) == Sides{{}, {}, {}, {1}});
  CHECK(LooksOf(Config({{0, 0}, {0, 1}, {-1, 0}})) == Sides{{}, {2}, {1}, {}});
  CHECK(LooksOf(Config({{0, 0}, {-1, 0}, {-0.5, 0}, {0.5, 0}, {1, 0}})) ==
        Sides{{4, 3}, {1, 2}, {}, {}});
}

TEST_CASE("views: a view nearer to another side is used if a side has no other view") {
  CHECK(LooksOf(Config({{0, 0}, {1, 1}})) == Sides{{1}, {}, {1}, {}});
  CHECK(LooksOf(Config({{0, 0}, {1, 1}, {0.5, 0}})) == Sides{{2}, {}, {1}, {}});
  // A view sees behind edges if its distance from the axis is less than eight times its distance
  // along the axis.
  CHECK(LooksOf(Config({{0, 0}, {0.13, 1}})) == Sides{{1}, {}, {1}, {}});
  CHECK(LooksOf(Config({{0, 0}, {0.125, 1}})) == Sides{{}, {}, {1}, {}});
  // If several views see behind edges on one side, the two that lie farthest along the axis are
  // chosen.
  CHECK(LooksOf(Config({{0, 0}, {0.4, 0}, {1, 0.1}, {0.9, -0.8}, {0.8, 0}}))[0] ==
        std::vector<int>{2, 4});
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

TEST_CASE("views: a shift is disparity times position, and symmetric for opposite positions") {
  CHECK(starfocus::ScaledByView(starfocus::kViewOne, 320, 12) == 1280);
  CHECK(starfocus::ScaledByView(-starfocus::kViewOne, 320, 12) == -1280);
  CHECK(starfocus::ScaledByView(starfocus::kViewOne / 2, -321, 12) == -642);
  CHECK(starfocus::ScaledByView(0, 320, 12) == 0);
  for (const int position : {1, 77, 5461, 16383}) {
    CHECK(starfocus::ScaledByView(-position, 999, 13) ==
          -starfocus::ScaledByView(position, 999, 13));
  }
}

}  // namespace
}  // namespace view_set_test
