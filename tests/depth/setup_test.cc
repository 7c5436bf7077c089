// SPDX-License-Identifier: Apache-2.0
// Tests the labels, views and tiles of an estimate.
#include "lib/depth/setup.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <initializer_list>
#include <vector>

#include "tests/depth/depth_scene.h"
#include "tests/support/config.h"

namespace setup_test {
namespace {

using namespace starfocus;

SweepSetup SetupOf(int width, int height, int views, float low, float high,
                   const std::vector<starfocus_position>& positions = {}) {
  test::PlaneField field = {width, height, {}, positions};
  field.views.resize(size_t(views));
  return MakeSetup(test::ConfigOf(field, low, high), false);
}

TEST_CASE("setup: tiles cover the picture, are symmetric, and are neither small nor large") {
  for (int length = 1; length < 3000; length += length < 40 ? 1 : 37) {
    const SweepSetup setup = SetupOf(length, 7, 5, 0, 1);
    CAPTURE(length);
    int32_t end = 0;
    for (int32_t k = 0; k < setup.columns; ++k) {
      const Rect tile = TileOf(setup, k), other = TileOf(setup, setup.columns - 1 - k);
      CHECK(tile.x == end);
      end = tile.x + tile.width;
      CHECK(other.x == length - end);
      CHECK(tile.height == 7);
      CHECK(tile.width < 384);
      CHECK((setup.columns == 1 || tile.width >= 128));
    }
    CHECK(end == length);
  }
}

TEST_CASE("setup: views of a ring lie opposite each other, at the positions of the star set") {
  for (const int views : {5, 9, 17}) {
    const SweepSetup setup = SetupOf(10, 10, views, 0, 1);
    CHECK(setup.side_views == views - 1);
    CHECK(!setup.one_sided());
    for (int32_t k = 0; k < setup.side_views; ++k) {
      double u = 0, v = 0;
      REQUIRE(starfocus_view_position(setup.side[k].index, &u, &v, nullptr) == STARFOCUS_OK);
      CHECK(setup.side[k].at.u == kViewOne * u);
      CHECK(setup.side[k].at.v == kViewOne * v);
      const int32_t ring = k / setup.arms * setup.arms;
      const SideView& other = setup.side[ring + (k + setup.arms / 2) % setup.arms];
      CHECK(other.at.u == -setup.side[k].at.u);
      CHECK(other.at.v == -setup.side[k].at.v);
    }
  }
}

SweepSetup PlanAt(const std::vector<starfocus_position>& positions, float low, float high) {
  return SetupOf(10, 10, int(positions.size()), low, high, positions);
}

TEST_CASE(
    "setup: sides are the largest sets of views within a half plane around one of eight "
    "directions") {
  const auto sides = [](const std::vector<starfocus_position>& positions) {
    const SweepSetup setup = PlanAt(positions, 0, 1);
    return std::vector<uint16_t>(setup.sides, setup.sides + setup.side_count);
  };
  using Masks = std::vector<uint16_t>;
  CHECK(sides({{0, 0}, {1, 0}}) == Masks{1});
  CHECK(sides({{0, 0}, {1, 0}, {0.5, 0}, {0, -1}}) == Masks{7});
  CHECK(sides({{0, 0}, {1, 0}, {-1, 0}}) == Masks{1, 2});
  CHECK(sides({{0, 0}, {1, 0}, {-1, 0}, {0, 1}}) == Masks{5, 6});
  CHECK(PlanAt({{0, 0}, {1, 0}, {0, 1}}, 0, 1).one_sided());
  CHECK(!PlanAt({{0, 0}, {1, 0}, {-1, 0}}, 0, 1).one_sided());
}

TEST_CASE("setup: shifts of views at any position differ by quarter pixels") {
  const SweepSetup setup = PlanAt({{0, 0}, {0.3, -0.7}}, -3.1F, 9);
  const SideView& view = setup.side[0];
  const ViewPhases phases = setup.PhasesOf(view);
  for (int32_t l = 0; l < setup.labels; ++l) {
    const LabelMove move = setup.MoveOf(view, l);
    CAPTURE(l);
    CHECK(std::abs(move.across - MoveAcross(view, setup.Disparity(l))) <= 17);
    CHECK(std::abs(move.down - MoveDown(view, setup.Disparity(l))) <= 17);
    REQUIRE(phases.slot[move.phase] >= 0);
    const LabelMove& same = phases.move[phases.slot[move.phase]];
    CHECK((same.across & 127) == (move.across & 127));
    CHECK((same.down & 127) == (move.down & 127));
  }
  CHECK(SetupOf(10, 10, 17, 0, 20).AllPhases() == 8 * 2 + 8 * 4);
}

TEST_CASE("setup: labels are half a pixel apart, or farther apart in a wide range") {
  const SweepSetup fine = SetupOf(10, 10, 5, -3, 4.25F);
  CHECK(fine.low == -3 * 64);
  CHECK(fine.step == 32);
  CHECK(fine.labels == 16);
  CHECK(fine.reach == 6);
  const SweepSetup single = SetupOf(10, 10, 5, 2, 2);
  CHECK(single.labels == 1);
  const SweepSetup wide = SetupOf(10, 10, 5, -500, 500);
  CHECK(wide.labels <= kMostLabels);
  CHECK(wide.Disparity(wide.labels - 1) >= 500 * 64);
  CHECK(wide.Disparity(wide.labels - 1) + 64 <= INT16_MAX);
}

TEST_CASE("setup: CoarseSetup keeps every other label and the range of the labels") {
  for (int range = 0; range <= 1000; range = range < 70 ? range + 1 : range + 93) {
    const float most = float(range) / 2;
    const SweepSetup setup = SetupOf(10, 10, 1, -most, most), coarse = CoarseSetup(setup);
    CAPTURE(range);
    CHECK(coarse.labels >= 1);
    CHECK(coarse.Disparity(coarse.labels - 1) <= setup.Disparity(setup.labels - 1));
    CHECK(coarse.Disparity(coarse.labels) > setup.Disparity(setup.labels - 1) - setup.step);
  }
}

}  // namespace
}  // namespace setup_test
